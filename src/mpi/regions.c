/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Neighbours and noise are shared out; the regions themselves grow over the whole cloud, on rank 0.
 */
#include "mpi/stages.h"
#include "segment/region.h"

/* What has been made is freed with the regions, also after a failure. */
static crease_status find_surroundings(crease_context *context, void *user, const double *points,
    size_t count, int k, crease_neighbours **neighbours, crease_noise **noise)
{
    crease_mpi *const mpi = user;
    crease_mpi_request request = {.stage = CREASE_MPI_SURROUNDINGS, .count = count, .k = k};
    crease_status status = crease_neighbours_create(context, count, k, neighbours);
    if (status == CREASE_OK)
        status = crease_noise_create(context, count, noise);
    if (status == CREASE_OK)
        status = crease_mpi_tell(mpi, &request, sizeof request);
    const crease_mpi_cloud cloud = {.count = count, .points = points};
    const crease_mpi_surroundings all = {*neighbours, *noise};
    return status == CREASE_OK ? crease_mpi_surroundings_stage(mpi, &cloud, k, &all) : status;
}

crease_status crease_mpi_regions_find(crease_mpi *mpi, const crease_cloud *cloud,
    const crease_regions_options *options, crease_regions **out)
{
    *out = NULL;
    const crease_status status = crease_mpi_check(mpi, crease_cloud_count(cloud));
    return status == CREASE_OK
        ? crease_regions_find_by(mpi->context, cloud, options, find_surroundings, mpi, out)
        : status;
}
