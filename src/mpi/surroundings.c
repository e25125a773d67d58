/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Neighbours, spacing, noise and normals, each rank of its own points. What is decided from numbers
 * of all points, rank 0 decides. */
#include "mpi/surroundings.h"

#include "base/memory.h"
#include "cloud/cloud.h"
#include "mpi/share.h"
#include "noise/windows.h"
#include "space/neighbours.h"

#include <stdlib.h>

/* A rank's part of the work. */
typedef struct work {
    const crease_mpi *mpi;
    size_t total;
    int k;
    crease_mpi_share share;
    crease_neighbours *neighbours; /* of the piece's points, as points of the piece */
    crease_windows windows;
    crease_noise_scale scale;
    crease_noise *noise; /* of the piece */
    double *values;      /* by point of the piece */
    bool ended;          /* the questions have ended because all ranks know of a failure */
} work;

/* The own points stand together: a piece is in Morton order, and they are a run of it. */
static void find_own(work *run)
{
    size_t begin = 0;
    while (begin < run->share.piece.count && !run->share.own[begin])
        begin++;
    run->windows.begin = begin;
    run->windows.end = begin + run->share.own_count;
}

static crease_status prepare(work *run)
{
    crease_context *const context = run->mpi->context;
    const crease_piece *const piece = &run->share.piece;
    const crease_cloud cloud = {.count = piece->count, .points = run->share.points};
    crease_status status = CREASE_OK;
    if (piece->count > 0)
        status = crease_neighbours_find(context, &cloud, run->k, &run->neighbours);
    else /* more ranks than points */
        run->neighbours = crease_allocate(context, 1, sizeof *run->neighbours);
    if (status == CREASE_OK && !run->neighbours)
        status = CREASE_ERROR_NO_MEMORY;
    if (status != CREASE_OK)
        return status;
    run->neighbours->k = run->k;
    run->windows.points = piece->points;
    run->windows.neighbours = run->neighbours;
    run->windows.unit = run->scale.unit;
    find_own(run);
    run->values = crease_allocate(context, piece->count, sizeof *run->values);
    status = run->values ? crease_noise_create(context, piece->count, &run->noise)
                         : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK)
        status = crease_windows_create(context, &run->windows);
    crease_stage(context, "noise");
    return status == CREASE_OK ? crease_windows_fit(context, &run->windows) : status;
}

/* ---------------------------------------------------------------------------------- deciding -- */

/* Every rank finds its points' numbers; all: on rank 0 room for those of all points. */
static crease_status value(work *run, crease_noise_value which, double *all)
{
    const crease_mpi *const mpi = run->mpi;
    const crease_status status = crease_mpi_agree(
        mpi, crease_windows_values(mpi->context, &run->windows, which, run->values));
    return status == CREASE_OK
        ? crease_mpi_share_gather(mpi, &run->share, run->values, sizeof *run->values, all)
        : status;
}

static crease_status ask(void *user, crease_noise_value which, double *values)
{
    work *const run = user;
    int32_t question = (int32_t)which;
    crease_status status = crease_mpi_tell(run->mpi, &question, sizeof question);
    if (status == CREASE_OK)
        status = value(run, which, values);
    run->ended = status != CREASE_OK;
    return status;
}

static crease_status answer(work *run)
{
    for (;;) {
        int32_t question = CREASE_NO_VALUE;
        crease_status status = crease_mpi_tell(run->mpi, &question, sizeof question);
        if (status != CREASE_OK || question == CREASE_NO_VALUE)
            return status;
        status = value(run, (crease_noise_value)question, NULL);
        if (status != CREASE_OK)
            return status;
    }
}

static crease_status decide(work *run)
{
    const crease_mpi *const mpi = run->mpi;
    crease_status status = CREASE_OK;
    if (mpi->rank > 0) {
        status = answer(run);
    } else {
        const crease_noise_source source = {ask, run};
        int32_t none = CREASE_NO_VALUE;
        status = crease_noise_scale_find(mpi->context, &source, run->total, run->k, &run->scale);
        if (!run->ended)
            crease_mpi_tell(mpi, &none, sizeof none);
    }
    status = crease_mpi_agree(mpi, status);
    return status == CREASE_OK ? crease_mpi_tell(mpi, &run->scale, sizeof run->scale) : status;
}

/* --------------------------------------------------------------------------------- gathering -- */

/* Own points' neighbours as positions in the whole cloud. */
static void number_neighbours(work *run)
{
    const size_t k = (size_t)run->k;
    for (size_t i = run->windows.begin * k; i < run->windows.end * k; i++)
        run->neighbours->indices[i] = run->share.numbers[run->neighbours->indices[i]];
}

static crease_status gather(work *run, const crease_mpi_surroundings *all)
{
    const crease_mpi *const mpi = run->mpi;
    const crease_mpi_share *const share = &run->share;
    const crease_noise *const own = run->noise, *const noise = all ? all->noise : NULL;
    number_neighbours(run);
    crease_status status = crease_mpi_share_gather(mpi, share, run->neighbours->indices,
        (size_t)run->k * sizeof(uint32_t), all ? all->neighbours->indices : NULL);
    if (status == CREASE_OK)
        status = crease_mpi_share_gather(
            mpi, share, own->normals, 3 * sizeof(double), noise ? noise->normals : NULL);
    if (status == CREASE_OK)
        status = crease_mpi_share_gather(
            mpi, share, own->scores, sizeof(float), noise ? noise->scores : NULL);
    if (status == CREASE_OK)
        status = crease_mpi_share_gather(
            mpi, share, own->local_spacing, sizeof(float), noise ? noise->local_spacing : NULL);
    return status;
}

/* ------------------------------------------------------------------------------------ whole -- */

static crease_status describe(
    work *run, const crease_mpi_cloud *cloud, const crease_mpi_surroundings *all)
{
    const crease_mpi *const mpi = run->mpi;
    crease_status status =
        crease_mpi_share_exchange(mpi, &run->share, run->windows.of, sizeof *run->windows.of);
    if (status == CREASE_OK)
        status = crease_mpi_agree(
            mpi, crease_windows_describe(mpi->context, &run->windows, &run->scale, run->noise));
    if (status == CREASE_OK)
        status = gather(run, all);
    if (status == CREASE_OK && all)
        status = crease_noise_judge(mpi->context, cloud->points, &run->scale, all->noise);
    return status;
}

crease_status crease_mpi_surroundings_stage(
    const crease_mpi *mpi, const crease_mpi_cloud *cloud, int k, const crease_mpi_surroundings *all)
{
    work run = {.mpi = mpi, .total = cloud->count, .k = k};
    crease_mpi_parcels parcels = {0};
    crease_status status = CREASE_OK;
    if (all)
        status = crease_noise_measure(mpi->context, cloud->points, cloud->count, &run.scale);
    status = crease_mpi_agree(mpi, status);
    if (status == CREASE_OK)
        status = crease_mpi_tell(mpi, &run.scale, sizeof run.scale);
    if (status == CREASE_OK)
        status = crease_mpi_parcels_take(mpi, cloud, &parcels);
    if (status == CREASE_OK)
        status = crease_mpi_share_create(mpi, &parcels, k, &run.share);
    if (status == CREASE_OK)
        status = crease_mpi_agree(mpi, prepare(&run));
    if (status == CREASE_OK)
        status = decide(&run);
    if (status == CREASE_OK)
        status = describe(&run, cloud, all);
    crease_windows_free(&run.windows);
    crease_neighbours_free(run.neighbours);
    crease_noise_free(run.noise);
    free(run.values);
    free(parcels.items);
    crease_mpi_share_free(&run.share);
    return status;
}
