/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What every point's neighbours tell: the stage before the regions. Internal view. */
#ifndef CREASE_MPI_SURROUNDINGS_H
#define CREASE_MPI_SURROUNDINGS_H

#include "mpi/share.h"
#include "noise/noise.h"

/* Rank 0's room for what is found of all points, which are in Morton order. */
typedef struct crease_mpi_surroundings {
    crease_neighbours *neighbours;
    crease_noise *noise;
} crease_mpi_surroundings;

/* Collective. all: on rank 0, with room; elsewhere NULL. k: neighbours of each point. */
crease_status crease_mpi_surroundings_stage(const crease_mpi *mpi, const crease_mpi_cloud *cloud,
    int k, const crease_mpi_surroundings *all);

#endif
