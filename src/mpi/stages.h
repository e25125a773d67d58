/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What rank 0 asks the others for, and what all then do together. Internal view. */
#ifndef CREASE_MPI_STAGES_H
#define CREASE_MPI_STAGES_H

#include "mpi/intake.h"
#include "mpi/surroundings.h"

enum {
    CREASE_MPI_END,
    CREASE_MPI_SCORES,
    CREASE_MPI_SURROUNDINGS,
    CREASE_MPI_STREAM,
    CREASE_MPI_FIT
};

typedef struct crease_mpi_request {
    int64_t stage;
    uint64_t seed, count;
    int64_t k; /* neighbours of the surroundings */
    crease_detect_options detect;
} crease_mpi_request;

/* Collective. scores: on rank 0, with room; elsewhere NULL. */
crease_status crease_mpi_scores_stage(const crease_mpi *mpi, const crease_mpi_cloud *cloud,
    const crease_detect_options *options, crease_scores *scores);
/* Collective, but not for rank 0, which tells what is to be done; see crease_mpi_detect_stream().
 */
crease_status crease_mpi_stream_stage(const crease_mpi *mpi);
/* The same, for a pass over the file; see crease_mpi_sheet_fit_stream(). */
crease_status crease_mpi_fit_stage(const crease_mpi *mpi);

/* Rank 0: whether so many points can be shared out. */
crease_status crease_mpi_check(const crease_mpi *mpi, size_t count);

#endif
