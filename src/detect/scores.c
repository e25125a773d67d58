/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The scores of a whole cloud: a cloud of one piece. */
#include "detect/scores.h"

#include "base/memory.h"
#include "base/store.h"
#include "detect/scoring.h"

#include <stdlib.h>
#include <string.h>

crease_detect_options crease_detect_options_default(void)
{
    return (crease_detect_options){
        .neighbours = 16, .resamples = 100, .false_discovery_rate = 0.05};
}

crease_status crease_scores_create(crease_context *context, size_t count, crease_scores **out)
{
    *out = NULL;
    crease_scores *const scores = crease_allocate(context, 1, sizeof *scores);
    if (!scores)
        return CREASE_ERROR_NO_MEMORY;
    scores->count = count;
    scores->variance = crease_allocate(context, count, sizeof *scores->variance);
    scores->normals = crease_allocate(context, count, 3 * sizeof *scores->normals);
    scores->features = crease_allocate(context, count, sizeof *scores->features);
    if (!scores->variance || !scores->normals || !scores->features) {
        crease_scores_free(scores);
        return CREASE_ERROR_NO_MEMORY;
    }
    *out = scores;
    return CREASE_OK;
}

static uint64_t key_of(const crease_context *context, const double *points, size_t count,
    const crease_detect_options *options)
{
    const uint64_t numbers[] = {context->options.seed, (uint64_t)options->neighbours,
        (uint64_t)options->resamples, (uint64_t)options->detector};
    uint64_t key = crease_store_key(0, crease_version(), strlen(crease_version()));
    key = crease_store_key(key, numbers, sizeof numbers);
    key =
        crease_store_key(key, &options->false_discovery_rate, sizeof options->false_discovery_rate);
    return crease_store_key(key, points, 3 * count * sizeof *points);
}

static void list_arrays(const crease_scores *scores, crease_stored arrays[3])
{
    arrays[0] = (crease_stored){scores->variance, scores->count * sizeof *scores->variance};
    arrays[1] = (crease_stored){scores->normals, 3 * scores->count * sizeof *scores->normals};
    arrays[2] = (crease_stored){scores->features, scores->count};
}

bool crease_scores_load(crease_context *context, const double *points,
    const crease_detect_options *options, crease_scores *scores)
{
    crease_stored arrays[3];
    list_arrays(scores, arrays);
    return context->kept &&
        crease_store_load(
            context, "scores", key_of(context, points, scores->count, options), arrays, 3);
}

void crease_scores_save(crease_context *context, const double *points,
    const crease_detect_options *options, const crease_scores *scores)
{
    crease_stored arrays[3];
    list_arrays(scores, arrays);
    if (context->kept)
        crease_store_save(
            context, "scores", key_of(context, points, scores->count, options), arrays, 3);
}

static crease_status compute(
    crease_context *context, const crease_scoring *scoring, uint8_t *features)
{
    double threshold = 0;
    crease_scoring_counts *const counts = crease_allocate(context, 1, sizeof *counts);
    crease_status status = counts ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK)
        status = crease_scoring_compute(context, scoring, counts);
    if (status == CREASE_OK)
        status = crease_scoring_decide(context, counts, &scoring->options, &threshold);
    free(counts);
    return status == CREASE_OK
        ? crease_scoring_mark(context, scoring, scoring->piece.count, threshold, features)
        : status;
}

static crease_status score(crease_context *context, const crease_piece *whole,
    const crease_detect_options *options, crease_scores *scores)
{
    crease_tree *tree = NULL;
    crease_stage(context, "neighbours");
    crease_status status = crease_tree_create(context, whole->points, whole->count, &tree);
    if (status == CREASE_OK) {
        const crease_scoring scoring = {.tree = tree,
            .piece = *whole,
            .options = *options,
            .variance = scores->variance,
            .normals = scores->normals};
        status = compute(context, &scoring, scores->features);
    }
    crease_tree_free(tree);
    return status;
}

crease_status crease_scores_compute(crease_context *context, const crease_cloud *cloud,
    const crease_detect_options *options, crease_scores **out)
{
    *out = NULL;
    const crease_detect_options chosen = options ? *options : crease_detect_options_default();
    const crease_piece whole = {
        .count = crease_cloud_count(cloud), .points = crease_cloud_points(cloud)};
    crease_scores *scores = NULL;
    crease_status status = crease_scoring_check(context, whole.count, &chosen);
    if (status == CREASE_OK)
        status = crease_scores_create(context, whole.count, &scores);
    if (status == CREASE_OK && !crease_scores_load(context, whole.points, &chosen, scores)) {
        status = score(context, &whole, &chosen, scores);
        if (status == CREASE_OK)
            crease_scores_save(context, whole.points, &chosen, scores);
    }
    if (status == CREASE_OK)
        *out = scores;
    else
        crease_scores_free(scores);
    return status;
}

void crease_scores_free(crease_scores *scores)
{
    if (!scores)
        return;
    free(scores->variance);
    free(scores->normals);
    free(scores->features);
    free(scores);
}

size_t crease_scores_count(const crease_scores *scores)
{
    return scores->count;
}

const double *crease_scores_variance(const crease_scores *scores)
{
    return scores->variance;
}

const double *crease_scores_normals(const crease_scores *scores)
{
    return scores->normals;
}

const uint8_t *crease_scores_features(const crease_scores *scores)
{
    return scores->features;
}
