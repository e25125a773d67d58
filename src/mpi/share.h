/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A rank's share of a cloud: a run of points along the Morton curve, completed by the others that
 * these have among their nearest. Internal view; every function is collective. */
#ifndef CREASE_MPI_SHARE_H
#define CREASE_MPI_SHARE_H

#include "mpi/parcel.h"
#include "space/piece.h"

typedef struct crease_mpi_share {
    size_t own_count;
    crease_piece piece;
    double *points; /* of the piece */
    uint32_t *numbers;
    uint8_t *own;
    crease_mpi_counts counts; /* of points given to others, and taken from them */
    uint32_t *give;           /* given points, as points of the piece */
    uint32_t *take;           /* taken points, in the order in which they arrive */
} crease_mpi_share;

/* Completes every rank's own points, which are freed. k: how many nearest points of each own point
 * the piece is to hold. */
crease_status crease_mpi_share_create(
    const crease_mpi *mpi, crease_mpi_parcels *own, int k, crease_mpi_share *out);
void crease_mpi_share_free(crease_mpi_share *share);
/* Sets the values of others' points in a piece to what their owners have. values: `size` bytes for
 * each point of the piece. */
crease_status crease_mpi_share_exchange(
    const crease_mpi *mpi, const crease_mpi_share *share, void *values, size_t size);
/* Brings the values of all own points to rank 0: all, by number, `size` bytes each; elsewhere NULL.
 */
crease_status crease_mpi_share_gather(const crease_mpi *mpi, const crease_mpi_share *share,
    const void *values, size_t size, void *all);

#endif
