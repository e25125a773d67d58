/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The scores of a whole cloud: a cloud of one piece. */
#include "detect/scores.h"

#include "base/memory.h"
#include "detect/scoring.h"

#include <stdlib.h>

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

crease_status crease_scores_compute(crease_context *context, const crease_cloud *cloud,
    const crease_detect_options *options, crease_scores **out)
{
    *out = NULL;
    const crease_detect_options chosen = options ? *options : crease_detect_options_default();
    const crease_piece whole = {
        .count = crease_cloud_count(cloud), .points = crease_cloud_points(cloud)};
    crease_tree *tree = NULL;
    crease_scores *scores = NULL;
    crease_status status = crease_scoring_check(context, whole.count, &chosen);
    if (status != CREASE_OK)
        return status;
    crease_stage(context, "neighbours");
    status = crease_tree_create(context, whole.points, whole.count, &tree);
    if (status == CREASE_OK)
        status = crease_scores_create(context, whole.count, &scores);
    if (status == CREASE_OK) {
        const crease_scoring scoring = {.tree = tree,
            .piece = whole,
            .options = chosen,
            .variance = scores->variance,
            .normals = scores->normals};
        status = compute(context, &scoring, scores->features);
    }
    crease_tree_free(tree);
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
