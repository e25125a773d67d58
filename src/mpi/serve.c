/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "mpi/stages.h"

#include <limits.h>
#include <stdlib.h>

static crease_status serve(const crease_mpi *mpi, const crease_mpi_request *request)
{
    const crease_mpi_cloud cloud = {.count = request->count};
    if (request->stage == CREASE_MPI_SURROUNDINGS)
        return crease_mpi_surroundings_stage(mpi, &cloud, (int)request->k, NULL);
    mpi->context->options.seed = request->seed;
    if (request->stage == CREASE_MPI_STREAM)
        return crease_mpi_stream_stage(mpi);
    if (request->stage == CREASE_MPI_FIT)
        return crease_mpi_fit_stage(mpi);
    return crease_mpi_scores_stage(mpi, &cloud, &request->detect, NULL);
}

crease_status crease_mpi_serve(crease_mpi *mpi)
{
    for (;;) {
        crease_mpi_request request = {.stage = CREASE_MPI_END};
        crease_status status = crease_mpi_tell(mpi, &request, sizeof request);
        if (status != CREASE_OK || request.stage == CREASE_MPI_END)
            return status;
        status = serve(mpi, &request);
        if (status == CREASE_ERROR_CANCELLED)
            return status;
    }
}

void crease_mpi_free(crease_mpi *mpi)
{
    if (!mpi)
        return;
    crease_mpi_request request = {.stage = CREASE_MPI_END};
    if (mpi->rank == 0)
        crease_mpi_tell(mpi, &request, sizeof request);
    if (mpi->crew != MPI_COMM_NULL)
        MPI_Comm_free(&mpi->crew);
    MPI_Comm_free(&mpi->communicator);
    free(mpi);
}

crease_status crease_mpi_check(const crease_mpi *mpi, size_t count)
{
    return count <= INT_MAX
        ? CREASE_OK
        : crease_fail(mpi->context, CREASE_ERROR_ARGUMENT,
              "cloud: %zu points are more than the %d that can be shared out; split it", count,
              INT_MAX);
}
