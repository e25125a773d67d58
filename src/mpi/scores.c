/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Scores and features, each rank of its own points. */
#include "detect/scores.h"
#include "base/memory.h"
#include "cloud/cloud.h"
#include "detect/scoring.h"
#include "mpi/share.h"
#include "mpi/stages.h"
#include "space/morton.h"

#include <stdlib.h>

/* What a rank finds for the points of its piece. */
typedef struct found {
    crease_tree *tree;
    double *variance, *normals;
    uint8_t *features;
    crease_scoring_counts *counts;
} found;

static crease_status prepare(crease_context *context, const crease_piece *piece, found *out)
{
    const size_t count = piece->count;
    out->variance = crease_allocate(context, count, sizeof *out->variance);
    out->normals = crease_allocate(context, count, 3 * sizeof *out->normals);
    out->features = crease_allocate(context, count, sizeof *out->features);
    out->counts = crease_allocate(context, 1, sizeof *out->counts);
    return out->variance && out->normals && out->features && out->counts
        ? crease_tree_create(context, piece->points, count, &out->tree)
        : CREASE_ERROR_NO_MEMORY;
}

static void free_found(found *all)
{
    crease_tree_free(all->tree);
    free(all->variance);
    free(all->normals);
    free(all->features);
    free(all->counts);
}

static crease_status gather(
    const crease_mpi *mpi, const crease_mpi_share *share, const found *own, crease_scores *scores)
{
    crease_status status = crease_mpi_share_gather(
        mpi, share, own->variance, sizeof(double), scores ? scores->variance : NULL);
    if (status == CREASE_OK)
        status = crease_mpi_share_gather(
            mpi, share, own->normals, 3 * sizeof(double), scores ? scores->normals : NULL);
    if (status == CREASE_OK)
        status =
            crease_mpi_share_gather(mpi, share, own->features, 1, scores ? scores->features : NULL);
    return status;
}

static crease_status score(const crease_mpi *mpi, const crease_mpi_share *share, size_t count,
    const crease_detect_options *options, found *own)
{
    crease_context *const context = mpi->context;
    double threshold = 0;
    crease_status status = crease_mpi_agree(mpi, prepare(context, &share->piece, own));
    if (status != CREASE_OK)
        return status;
    const crease_scoring scoring = {.tree = own->tree,
        .piece = share->piece,
        .options = *options,
        .variance = own->variance,
        .normals = own->normals};
    status = crease_mpi_agree(mpi, crease_scoring_compute(context, &scoring, own->counts));
    if (status == CREASE_OK)
        status =
            crease_mpi_add(mpi, (uint64_t *)own->counts, sizeof *own->counts / sizeof(uint64_t));
    if (status == CREASE_OK) /* the same on all ranks */
        status = crease_scoring_decide(context, own->counts, options, &threshold);
    if (status == CREASE_OK)
        status = crease_mpi_share_exchange(mpi, share, own->variance, sizeof *own->variance);
    return status == CREASE_OK
        ? crease_mpi_agree(
              mpi, crease_scoring_mark(context, &scoring, count, threshold, own->features))
        : status;
}

crease_status crease_mpi_scores_stage(const crease_mpi *mpi, const crease_mpi_cloud *cloud,
    const crease_detect_options *options, crease_scores *scores)
{
    crease_mpi_share share = {0};
    found own = {0};
    crease_stage(mpi->context, "neighbours");
    crease_mpi_parcels own_points = {0};
    crease_status status = crease_mpi_parcels_take(mpi, cloud, &own_points);
    if (status == CREASE_OK)
        status = crease_mpi_share_create(
            mpi, &own_points, crease_scoring_reach(cloud->count, options), &share);
    if (status == CREASE_OK)
        status = score(mpi, &share, cloud->count, options, &own);
    if (status == CREASE_OK)
        status = gather(mpi, &share, &own, scores);
    free(own_points.items);
    free_found(&own);
    crease_mpi_share_free(&share);
    return status;
}

static crease_status lead(crease_mpi *mpi, const crease_mpi_cloud *cloud,
    const crease_detect_options *options, crease_scores *scores)
{
    crease_mpi_request request = {.stage = CREASE_MPI_SCORES,
        .seed = crease_context_seed(mpi->context),
        .count = cloud->count,
        .detect = *options};
    const crease_status status = crease_mpi_tell(mpi, &request, sizeof request);
    return status == CREASE_OK ? crease_mpi_scores_stage(mpi, cloud, options, scores) : status;
}

/* The points in Morton order, then the stage. */
static crease_status compute(crease_mpi *mpi, const double *points,
    const crease_detect_options *options, crease_scores *scores)
{
    crease_context *const context = mpi->context;
    const size_t count = scores->count;
    crease_stage(context, "neighbours");
    uint64_t *const keys = crease_allocate(context, count, sizeof *keys);
    uint32_t *const order = crease_allocate(context, count, sizeof *order);
    crease_status status = keys && order ? crease_morton_sort(context, points, count, keys, order)
                                         : CREASE_ERROR_NO_MEMORY;
    free(keys);
    const crease_mpi_cloud cloud = {.count = count, .points = points, .order = order};
    if (status == CREASE_OK)
        status = lead(mpi, &cloud, options, scores);
    free(order);
    return status;
}

crease_status crease_mpi_scores_compute(crease_mpi *mpi, const crease_cloud *cloud,
    const crease_detect_options *options, crease_scores **out)
{
    *out = NULL;
    crease_context *const context = mpi->context;
    const crease_detect_options chosen = options ? *options : crease_detect_options_default();
    const double *const points = crease_cloud_points(cloud);
    crease_scores *scores = NULL;
    crease_status status = crease_mpi_check(mpi, crease_cloud_count(cloud));
    if (status == CREASE_OK)
        status = crease_scoring_check(context, crease_cloud_count(cloud), &chosen);
    if (status == CREASE_OK)
        status = crease_scores_create(context, crease_cloud_count(cloud), &scores);
    if (status == CREASE_OK && !crease_scores_load(context, points, &chosen, scores)) {
        status = compute(mpi, points, &chosen, scores);
        if (status == CREASE_OK)
            crease_scores_save(context, points, &chosen, scores);
    }
    if (status == CREASE_OK)
        *out = scores;
    else
        crease_scores_free(scores);
    return status;
}
