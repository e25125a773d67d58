/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A rank's share of a cloud: a run of points along the Morton curve, completed by the others that
 * these have among their nearest. Internal view; every function is collective. */
#ifndef CREASE_MPI_SHARE_H
#define CREASE_MPI_SHARE_H

#include "mpi/team.h"
#include "space/piece.h"

/* The whole cloud, on rank 0; elsewhere only its count is known. */
typedef struct crease_mpi_cloud {
    size_t count;
    const double *points;  /* count x 3 */
    const uint32_t *order; /* Morton order, and points then have their index as number; NULL: they
                              are in Morton order, and that is their number */
} crease_mpi_cloud;

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

/* Shares the cloud out. k: how many nearest points of each own point the piece is to hold. */
crease_status crease_mpi_share_create(
    const crease_mpi *mpi, const crease_mpi_cloud *cloud, int k, crease_mpi_share *out);
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
