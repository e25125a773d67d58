/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Step 1 of the paper: the bootstrap variance of every point, or what another detector says. The
 * points are gone through leaf by leaf of the tree, so the neighbours of all points are never
 * stored at once. */
#include "detect/scoring.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "detect/gauss_map.h"
#include "detect/jackknife.h"
#include "detect/scores.h"
#include "space/nearest.h"

#include <stdlib.h>
#include <string.h>

enum { LEAF_GRAIN = 16, POINT_GRAIN = 1024, LEAST_NEIGHBOURS = 4, MOST_RESAMPLES = 10000 };

/* Scoring in progress. */
typedef struct work {
    const crease_scoring *scoring;
    uint64_t seed;
    crease_resamples *workers; /* one for each thread */
    double *memory;
    uint32_t *pending;
    uint8_t *degenerate; /* by point */
} work;

/* False when the neighbours have no normal that a score could be of. */
static bool score_neighbourhood(const work *run, const crease_neighbourhood *neighbourhood,
    const crease_principal *principal, size_t number, int worker, double *score)
{
    crease_normal_bootstrap bootstrap;
    *score = 0;
    if (principal->degenerate)
        return false;
    switch (run->scoring->options.detector) {
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
        neighbourhood, principal, run->seed, number, &run->workers[worker], &bootstrap);
    *score = bootstrap.variance;
    return found;
}

static void score_point(const work *run, const uint32_t *positions, int worker)
{
    crease_neighbourhood neighbourhood;
    crease_principal principal;
    const crease_scoring *const scoring = run->scoring;
    const size_t index = scoring->tree->index[positions[0]];
    if (!crease_piece_owns(&scoring->piece, index))
        return;
    crease_neighbourhood_fill(
        scoring->tree, positions, scoring->options.neighbours, &neighbourhood);
    crease_principal_compute(&neighbourhood, &principal);
    run->degenerate[index] = !score_neighbourhood(run, &neighbourhood, &principal,
        crease_piece_number(&scoring->piece, index), worker, &scoring->variance[index]);
    if (scoring->normals)
        memcpy(scoring->normals + 3 * index, principal.normal, sizeof principal.normal);
}

static bool has_own(const crease_scoring *scoring, const crease_node *leaf)
{
    bool own = false;
    for (uint32_t i = leaf->begin; i < leaf->end && !own; i++)
        own = crease_piece_owns(&scoring->piece, scoring->tree->index[i]);
    return own;
}

static void score_leaves(void *user, size_t begin, size_t end, int worker)
{
    const work *run = user;
    const crease_tree *const tree = run->scoring->tree;
    const int k = run->scoring->options.neighbours;
    uint32_t positions[CREASE_LEAF_POINTS * CREASE_MOST_NEIGHBOURS];
    double distances[CREASE_LEAF_POINTS * CREASE_MOST_NEIGHBOURS];
    double reach = 0;
    for (size_t leaf = begin; leaf < end; leaf++) {
        const crease_node *const node = tree->nodes + tree->leaves[leaf];
        if (!has_own(run->scoring, node))
            continue;
        crease_tree_leaf_nearest(tree, leaf, k, &reach, positions, distances);
        for (uint32_t i = 0; i < node->end - node->begin; i++)
            score_point(run, positions + i * (uint32_t)k, worker);
    }
}

static crease_status allocate(crease_context *context, work *run)
{
    const size_t room = (size_t)run->scoring->options.resamples;
    const size_t threads = (size_t)crease_context_threads(context);
    run->degenerate = crease_allocate(context, run->scoring->piece.count, sizeof *run->degenerate);
    run->workers = crease_allocate(context, threads, sizeof *run->workers);
    run->memory = crease_allocate(context, threads * room, 3 * sizeof *run->memory);
    run->pending = crease_allocate(context, threads * room, sizeof *run->pending);
    if (!run->degenerate || !run->workers || !run->memory || !run->pending)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < threads; i++) {
        double *const memory = run->memory + 3 * room * i;
        run->workers[i] = (crease_resamples){
            room, {memory, memory + room, memory + 2 * room}, run->pending + room * i};
    }
    return CREASE_OK;
}

/* The least score is that over an edge that the normals turn around by ten degrees, with evenly
 * spread neighbours and no noise: heights |x| t, t = tan 5 degrees, for x uniform in -1..1. */
static crease_threshold_rule rule_of(const crease_detect_options *options)
{
    const double squared_tangent = 0.08748866352592401 * 0.08748866352592401;
    crease_threshold_rule rule = {
        .most = 1, .k = options->neighbours, .rate = options->false_discovery_rate};
    switch (options->detector) {
    case CREASE_DETECTOR_BOOTSTRAP:
    case CREASE_DETECTOR_JACKKNIFE:
        rule.least = 0.3 * squared_tangent / rule.k; /* variance of the slope */
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

static void count_scores(const work *run, crease_scoring_counts *counts)
{
    const crease_scoring *const scoring = run->scoring;
    const crease_threshold_rule rule = rule_of(&scoring->options);
    for (size_t i = 0; i < scoring->piece.count; i++) {
        if (!crease_piece_owns(&scoring->piece, i))
            continue;
        counts->points++;
        counts->degenerate += run->degenerate[i];
        crease_threshold_count(&counts->scores, scoring->variance[i], &rule);
    }
}

crease_status crease_scoring_compute(
    crease_context *context, const crease_scoring *scoring, crease_scoring_counts *counts)
{
    work run = {.scoring = scoring, .seed = crease_context_seed(context)};
    crease_status status = allocate(context, &run);
    if (status == CREASE_OK) {
        crease_stage(context, "scores");
        status =
            crease_parallel_for(context, scoring->tree->leaf_count, LEAF_GRAIN, score_leaves, &run);
    }
    if (status == CREASE_OK)
        count_scores(&run, counts);
    free(run.degenerate);
    free(run.workers);
    free(run.memory);
    free(run.pending);
    return status;
}

/* Points without a normal tell nothing; a cloud of nothing else is no surface. */
crease_status crease_scoring_decide(crease_context *context, const crease_scoring_counts *counts,
    const crease_detect_options *options, double *threshold)
{
    if (counts->degenerate == counts->points)
        return crease_fail(context, CREASE_ERROR_DEGENERATE,
            "scores: the %d nearest points of every point lie on a line or in one point; take more "
            "neighbours or leave out duplicate points",
            options->neighbours);
    const crease_threshold_rule rule = rule_of(options);
    *threshold = crease_threshold_find(&counts->scores, counts->points, &rule);
    return CREASE_OK;
}

/* -------------------------------------------------------------------------------- features -- */

typedef struct marking {
    const crease_scoring *scoring;
    int k; /* neighbours that a feature is held against */
    double threshold;
    uint8_t *features;
} marking;

int crease_scoring_reach(size_t count, const crease_detect_options *options)
{
    const int twice = 2 * options->neighbours;
    const int k = twice < CREASE_MOST_NEIGHBOURS ? twice : CREASE_MOST_NEIGHBOURS;
    return (size_t)k < count ? k : (int)count;
}

/* Whether the point at a position is at least as sharp as the mean of twice its neighbours: an edge
 * raises the variance of all points whose neighbourhoods reach it, most so on the edge itself. */
static bool stands_out(const marking *run, uint32_t position)
{
    const crease_tree *const tree = run->scoring->tree;
    const double *const variance = run->scoring->variance;
    const double place[3] = {tree->x[position], tree->y[position], tree->z[position]};
    uint32_t positions[CREASE_MOST_NEIGHBOURS];
    double distances[CREASE_MOST_NEIGHBOURS];
    crease_tree_nearest_place(tree, place, position, run->k, positions, distances);
    double sum = 0;
    for (int i = 0; i < run->k; i++)
        sum += variance[tree->index[positions[i]]];
    return variance[tree->index[position]] * run->k >= sum;
}

static void mark_features(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const marking *run = user;
    for (size_t position = begin; position < end; position++) {
        const size_t index = run->scoring->tree->index[position];
        if (crease_piece_owns(&run->scoring->piece, index))
            run->features[index] = run->scoring->variance[index] >= run->threshold &&
                stands_out(run, (uint32_t)position);
    }
}

crease_status crease_scoring_mark(crease_context *context, const crease_scoring *scoring,
    size_t count, double threshold, uint8_t *features)
{
    marking run = {.scoring = scoring,
        .k = crease_scoring_reach(count, &scoring->options),
        .threshold = threshold,
        .features = features};
    return crease_parallel_for(context, scoring->piece.count, POINT_GRAIN, mark_features, &run);
}

/* --------------------------------------------------------------------------------- options -- */

crease_status crease_scoring_check(
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
