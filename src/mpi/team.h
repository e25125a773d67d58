/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The processes of a communicator, and how they talk. Internal view.
 *
 * Every function here that is not said to be otherwise is collective. What waits for others also
 * looks after cancellation, and does not take a processor away from those it waits for; after
 * CANCELLED nothing is known about the state of the others, and only MPI_Abort is left. */
#ifndef CREASE_MPI_TEAM_H
#define CREASE_MPI_TEAM_H

#include "base/context.h"
#include "crease/crease_mpi.h"

struct crease_mpi {
    crease_context *context;
    MPI_Comm communicator;
    MPI_Comm crew; /* of all ranks but 0; on rank 0 MPI_COMM_NULL */
    int rank, size;
};

/* The team of all ranks but 0, for what they do among themselves. Of any of them; not collective.
 */
static inline crease_mpi crease_mpi_crew(const crease_mpi *mpi)
{
    return (crease_mpi){.context = mpi->context,
        .communicator = mpi->crew,
        .crew = MPI_COMM_NULL,
        .rank = mpi->rank - 1,
        .size = mpi->size - 1};
}

/* How many items go to and come from every rank. Each list has one number for each rank. */
typedef struct crease_mpi_counts {
    int *give, *give_at; /* items, and where the first one is */
    int *take, *take_at;
    size_t given, taken; /* in all */
} crease_mpi_counts;

/* Waits for one operation. Not collective. */
crease_status crease_mpi_wait(const crease_mpi *mpi, MPI_Request *request);
/* Every rank gets the status of the lowest rank that failed, and its sentence. */
crease_status crease_mpi_agree(const crease_mpi *mpi, crease_status status);
/* Rank 0's bytes for all; any number of them. */
crease_status crease_mpi_tell(const crease_mpi *mpi, void *bytes, size_t size);
/* The sums of all ranks' numbers, for all. */
crease_status crease_mpi_add(const crease_mpi *mpi, uint64_t *numbers, size_t count);
/* The box around all ranks' boxes, for all. */
crease_status crease_mpi_enclose(const crease_mpi *mpi, double low[3], double high[3]);
/* Items from one rank to another; called by these two. */
crease_status crease_mpi_send(
    const crease_mpi *mpi, int to, const void *items, size_t count, size_t size);
crease_status crease_mpi_receive(
    const crease_mpi *mpi, int from, void *items, size_t count, size_t size);

/* Makes room for the numbers of every rank. Not collective. */
crease_status crease_mpi_counts_create(const crease_mpi *mpi, crease_mpi_counts *out);
void crease_mpi_counts_free(crease_mpi_counts *counts);
/* From `give` to all others. Errors: NO_MEMORY when there are too many. */
crease_status crease_mpi_counts_settle(const crease_mpi *mpi, crease_mpi_counts *counts);
/* Items of `size` bytes. */
crease_status crease_mpi_exchange(const crease_mpi *mpi, const crease_mpi_counts *counts,
    const void *give, void *take, size_t size);

#endif
