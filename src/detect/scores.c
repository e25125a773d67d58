/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Step 1 of the paper: the bootstrap variance of every point, or what another detector says. The
 * points are gone through leaf by leaf of the tree, so the neighbours of all points are never
 * stored at once. */
#include "detect/scores.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "detect/gauss_map.h"
#include "detect/jackknife.h"
#include "detect/threshold.h"
#include "space/nearest.h"

#include <stdlib.h>

enum { LEAF_GRAIN = 16, POINT_GRAIN = 1024, LEAST_NEIGHBOURS = 4, MOST_RESAMPLES = 10000 };

typedef struct scoring {
    const crease_tree *tree;
    crease_scores *scores;
    uint64_t seed;
    crease_detect_options options;
    int k;
    double threshold;          /* least score of a feature */
    crease_resamples *workers; /* one for each thread */
    double *memory;
    uint32_t *pending;
    uint8_t *degenerate; /* by point */
} scoring;

crease_detect_options crease_detect_options_default(void)
{
    return (crease_detect_options){
        .neighbours = 16, .resamples = 100, .false_discovery_rate = 0.05};
}

/* False when the neighbours have no normal that a score could be of. */
static bool score_neighbourhood(const scoring *run, const crease_neighbourhood *neighbourhood,
    const crease_principal *principal, uint32_t index, int worker, double *score)
{
    crease_normal_bootstrap bootstrap;
    *score = 0;
    if (principal->degenerate)
        return false;
    switch (run->options.detector) {
    case CREASE_DETECTOR_JACKKNIFE:
        *score = crease_jackknife_variance(neighbourhood, principal);
        return true;
    case CREASE_DETECTOR_VARIATION:
        *score = crease_principal_variation(principal);
        return true;
    case CREASE_DETECTOR_GAUSS_MAP:
        *score = crease_gauss_map_separation(neighbourhood);
        return true;
    case CREASE_DETECTOR_BOOTSTRAP:
        break;
    }
    const bool found = crease_normal_bootstrap_compute(
        neighbourhood, principal, run->seed, index, &run->workers[worker], &bootstrap);
    *score = bootstrap.variance;
    return found;
}

static void score_point(const scoring *run, const uint32_t *positions, int worker)
{
    crease_neighbourhood neighbourhood;
    crease_principal principal;
    const uint32_t index = run->tree->index[positions[0]];
    crease_neighbourhood_fill(run->tree, positions, run->k, &neighbourhood);
    crease_principal_compute(&neighbourhood, &principal);
    run->degenerate[index] = !score_neighbourhood(
        run, &neighbourhood, &principal, index, worker, &run->scores->variance[index]);
    for (size_t axis = 0; axis < 3; axis++)
        run->scores->normals[3 * (size_t)index + axis] = principal.normal[axis];
}

static void score_leaves(void *user, size_t begin, size_t end, int worker)
{
    const scoring *run = user;
    uint32_t positions[CREASE_LEAF_POINTS * CREASE_MOST_NEIGHBOURS];
    double distances[CREASE_LEAF_POINTS * CREASE_MOST_NEIGHBOURS];
    double reach = 0;
    for (size_t leaf = begin; leaf < end; leaf++) {
        const crease_node *const node = run->tree->nodes + run->tree->leaves[leaf];
        crease_tree_leaf_nearest(run->tree, leaf, run->k, &reach, positions, distances);
        for (uint32_t i = 0; i < node->end - node->begin; i++)
            score_point(run, positions + i * (uint32_t)run->k, worker);
    }
}

static crease_status allocate(crease_context *context, scoring *run)
{
    const size_t count = run->tree->count, room = (size_t)run->options.resamples;
    const size_t threads = (size_t)crease_context_threads(context);
    crease_scores *const scores = run->scores;
    scores->variance = crease_allocate(context, count, sizeof *scores->variance);
    scores->normals = crease_allocate(context, count, 3 * sizeof *scores->normals);
    scores->features = crease_allocate(context, count, sizeof *scores->features);
    run->degenerate = crease_allocate(context, count, sizeof *run->degenerate);
    run->workers = crease_allocate(context, threads, sizeof *run->workers);
    run->memory = crease_allocate(context, threads * room, 3 * sizeof *run->memory);
    run->pending = crease_allocate(context, threads * room, sizeof *run->pending);
    if (!scores->variance || !scores->normals || !scores->features || !run->degenerate ||
        !run->workers || !run->memory || !run->pending)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < threads; i++) {
        double *const memory = run->memory + 3 * room * i;
        run->workers[i] = (crease_resamples){
            room, {memory, memory + room, memory + 2 * room}, run->pending + room * i};
    }
    return CREASE_OK;
}

/* Whether the point at a position is at least as sharp as the mean of twice its neighbours: an edge
 * raises the variance of all points whose neighbourhoods reach it, most so on the edge itself. */
static bool stands_out(const scoring *run, uint32_t position)
{
    const crease_tree *const tree = run->tree;
    const double *const variance = run->scores->variance;
    const double place[3] = {tree->x[position], tree->y[position], tree->z[position]};
    uint32_t positions[CREASE_MOST_NEIGHBOURS];
    double distances[CREASE_MOST_NEIGHBOURS];
    int k = 2 * run->k < CREASE_MOST_NEIGHBOURS ? 2 * run->k : CREASE_MOST_NEIGHBOURS;
    k = (size_t)k < tree->count ? k : (int)tree->count;
    crease_tree_nearest_place(tree, place, position, k, positions, distances);
    double sum = 0;
    for (int i = 0; i < k; i++)
        sum += variance[tree->index[positions[i]]];
    return variance[tree->index[position]] * k >= sum;
}

static void mark_features(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const scoring *run = user;
    for (size_t position = begin; position < end; position++) {
        const uint32_t index = run->tree->index[position];
        run->scores->features[index] =
            run->scores->variance[index] >= run->threshold && stands_out(run, (uint32_t)position);
    }
}

/* The least score is that over an edge that the normals turn around by ten degrees, with evenly
 * spread neighbours and no noise: heights |x| t, t = tan 5 degrees, for x uniform in -1..1. */
static crease_threshold_rule rule_of(const scoring *run)
{
    const double squared_tangent = 0.08748866352592401 * 0.08748866352592401;
    crease_threshold_rule rule = {
        .most = 1, .k = run->k, .rate = run->options.false_discovery_rate};
    switch (run->options.detector) {
    case CREASE_DETECTOR_BOOTSTRAP:
    case CREASE_DETECTOR_JACKKNIFE:
        rule.least = 0.3 * squared_tangent / run->k; /* variance of the slope */
        break;
    case CREASE_DETECTOR_VARIATION:
        rule.most = 1.0 / 3;
        rule.least = squared_tangent / 8; /* 1/12, of the heights, over 2/3, of a square */
        break;
    case CREASE_DETECTOR_GAUSS_MAP:
        rule.least = squared_tangent; /* half the squared tangents' distance: many normals lie
                                         between those of the faces */
    }
    return rule;
}

/* Points without a normal tell nothing; a cloud of nothing else is no surface. */
static crease_status decide(crease_context *context, scoring *run)
{
    crease_scores *const scores = run->scores;
    size_t degenerate = 0;
    for (size_t i = 0; i < scores->count; i++)
        degenerate += run->degenerate[i];
    if (degenerate == scores->count)
        return crease_fail(context, CREASE_ERROR_DEGENERATE,
            "scores: the %d nearest points of every point lie on a line or in one point; take more "
            "neighbours or leave out duplicate points",
            run->k);
    const crease_threshold_rule rule = rule_of(run);
    run->threshold = crease_threshold_find(scores->variance, scores->count, &rule);
    return crease_parallel_for(context, scores->count, POINT_GRAIN, mark_features, run);
}

static crease_status compute(crease_context *context, scoring *run)
{
    crease_status status = allocate(context, run);
    if (status == CREASE_OK) {
        crease_stage(context, "scores");
        status = crease_parallel_for(context, run->tree->leaf_count, LEAF_GRAIN, score_leaves, run);
    }
    if (status == CREASE_OK)
        status = decide(context, run);
    free(run->degenerate);
    free(run->workers);
    free(run->memory);
    free(run->pending);
    return status;
}

static crease_status check(
    crease_context *context, size_t count, const crease_detect_options *options)
{
    if ((unsigned)options->detector > CREASE_DETECTOR_GAUSS_MAP)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "scores: there is no detector number %d; take one of crease_detector",
            (int)options->detector);
    if (options->neighbours < LEAST_NEIGHBOURS || options->neighbours > CREASE_MOST_NEIGHBOURS)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "scores: %d neighbours asked for; take %d to %d", options->neighbours, LEAST_NEIGHBOURS,
            CREASE_MOST_NEIGHBOURS);
    if (options->resamples < 2 || options->resamples > MOST_RESAMPLES)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "scores: %d resamples asked for; take 2 to %d", options->resamples, MOST_RESAMPLES);
    if (!(options->false_discovery_rate >= 0 && options->false_discovery_rate <= 1))
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "scores: a false discovery rate of %g is no share; take 0 to 1",
            options->false_discovery_rate);
    if (count < (size_t)options->neighbours)
        return crease_fail(context, CREASE_ERROR_TOO_FEW_POINTS,
            "scores: the cloud has %zu points, fewer than the %d neighbours asked for; ask for "
            "fewer",
            count, options->neighbours);
    return CREASE_OK;
}

crease_status crease_scores_compute(crease_context *context, const crease_cloud *cloud,
    const crease_detect_options *options, crease_scores **out)
{
    *out = NULL;
    const crease_detect_options chosen = options ? *options : crease_detect_options_default();
    const size_t count = crease_cloud_count(cloud);
    crease_tree *tree = NULL;
    crease_scores *scores = NULL;
    crease_status status = check(context, count, &chosen);
    if (status != CREASE_OK)
        return status;
    crease_stage(context, "neighbours");
    status = crease_tree_create(context, crease_cloud_points(cloud), count, &tree);
    if (status != CREASE_OK)
        goto done;
    status = CREASE_ERROR_NO_MEMORY;
    scores = crease_allocate(context, 1, sizeof *scores);
    if (!scores)
        goto done;
    scores->count = count;
    scoring run = {.tree = tree,
        .scores = scores,
        .seed = crease_context_seed(context),
        .options = chosen,
        .k = chosen.neighbours};
    status = compute(context, &run);
done:
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
