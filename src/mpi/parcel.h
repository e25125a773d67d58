/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Points on their way from rank to rank. Internal view; every function is collective. */
#ifndef CREASE_MPI_PARCEL_H
#define CREASE_MPI_PARCEL_H

#include "mpi/team.h"

typedef struct crease_mpi_parcel {
    double point[3];
    uint32_t number;
    uint32_t from; /* place in the list of own points and then those taken */
} crease_mpi_parcel;

/* The points that are a rank's own. */
typedef struct crease_mpi_parcels {
    crease_mpi_parcel *items;
    size_t count;
} crease_mpi_parcels;

/* The whole cloud, on rank 0; elsewhere only its count is known. */
typedef struct crease_mpi_cloud {
    size_t count;
    const double *points;  /* count x 3 */
    const uint32_t *order; /* Morton order, and points then have their index as number; NULL: they
                              are in Morton order, and that is their number */
} crease_mpi_cloud;

/* Number of the first of so many items that a rank gets, when all get nearly as many. Not
 * collective. */
size_t crease_mpi_first_of(const crease_mpi *mpi, size_t count, int rank);
/* Rank 0 hands out its cloud; no share is larger than its own by more than one point. */
crease_status crease_mpi_parcels_take(
    const crease_mpi *mpi, const crease_mpi_cloud *cloud, crease_mpi_parcels *out);
/* Moves the points of all ranks so that each has a run of them along the Morton curve, about as
 * long as the others'. low, high: the box around them. */
crease_status crease_mpi_parcels_sort(
    const crease_mpi *mpi, const double low[3], const double high[3], crease_mpi_parcels *parcels);

#endif
