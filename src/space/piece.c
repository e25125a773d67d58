/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Squared distances of points and of boxes are computed by the same operations, each of which
 * rounds monotonically: no point that is as near as the limit is missed by rounding. */
#include "space/piece.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "base/select.h"
#include "space/nearest.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { GRAIN = 32, MANY = 32 };

/* Squared: a leaf whose reach is more than this many times the usual one is among outliers, or at a
 * gap. */
static const double unusual = 16.0;

/* What a leaf asks for. */
typedef struct demand {
    double limit;  /* squared */
    bool apart;    /* its points ask each for itself */
    size_t begins; /* number of its first reach */
} demand;

struct reaching {
    const crease_tree *tree;
    int k;
    demand *leaves;
    double usual;
    crease_reach *reaches;
};

static const crease_node *leaf_of(const struct reaching *run, size_t leaf)
{
    return run->tree->nodes + run->tree->leaves[leaf];
}

/* Squared distances of the k-th nearest of each point of a leaf; infinite when there are fewer. */
static void find_limits(const struct reaching *run, size_t leaf, double *hint, double *limits)
{
    const size_t k = (size_t)run->k;
    const crease_node *const node = leaf_of(run, leaf);
    uint32_t positions[CREASE_LEAF_POINTS * CREASE_MOST_NEIGHBOURS];
    double distances[CREASE_LEAF_POINTS * CREASE_MOST_NEIGHBOURS];
    if (run->tree->count >= k)
        crease_tree_leaf_nearest(run->tree, leaf, run->k, hint, positions, distances);
    for (uint32_t i = 0; i < node->end - node->begin; i++)
        limits[i] = run->tree->count < k ? INFINITY : distances[i * k + k - 1];
}

static void measure_leaves(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const struct reaching *const run = user;
    double limits[CREASE_LEAF_POINTS], hint = 0;
    for (size_t leaf = begin; leaf < end; leaf++) {
        const crease_node *const node = leaf_of(run, leaf);
        find_limits(run, leaf, &hint, limits);
        run->leaves[leaf].limit = 0;
        for (uint32_t i = 0; i < node->end - node->begin; i++)
            run->leaves[leaf].limit = fmax(run->leaves[leaf].limit, limits[i]);
    }
}

static crease_reach reach_of(const crease_node *node, double limit)
{
    crease_reach reach = {.limit = limit};
    memcpy(reach.low, node->low, sizeof reach.low);
    memcpy(reach.high, node->high, sizeof reach.high);
    return reach;
}

static double outside(double low, double high, double value)
{
    const double below = low - value, above = value - high;
    const double away = below > above ? below : above;
    return away > 0 ? away : 0;
}

/* The leaves of a tree that a reach touches, one after the other. */
typedef struct leaf_walk {
    const crease_reach *reach;
    const crease_tree *tree;
    uint32_t stack[CREASE_TREE_DEPTH];
    int height;
} leaf_walk;

static leaf_walk walk_of(const crease_reach *reach, const crease_tree *tree)
{
    return (leaf_walk){.reach = reach, .tree = tree, .height = tree->count > 0 ? 1 : 0};
}

/* NULL after the last. */
static const crease_node *next_leaf(leaf_walk *walk)
{
    while (walk->height > 0) {
        const crease_node *const node = walk->tree->nodes + walk->stack[--walk->height];
        if (!crease_reach_touches(walk->reach, node->low, node->high))
            continue;
        if (!node->second)
            return node;
        walk->stack[walk->height++] = node->second;
        walk->stack[walk->height++] = (uint32_t)(node + 1 - walk->tree->nodes);
    }
    return NULL;
}

static bool is_within(const crease_reach *reach, const crease_tree *tree, uint32_t position)
{
    const double dx = outside(reach->low[0], reach->high[0], tree->x[position]);
    const double dy = outside(reach->low[1], reach->high[1], tree->y[position]);
    const double dz = outside(reach->low[2], reach->high[2], tree->z[position]);
    return dx * dx + dy * dy + dz * dz <= reach->limit;
}

/* Whether the reach holds more than `most` points of the tree. */
static bool holds_more(const crease_reach *reach, const crease_tree *tree, size_t most)
{
    size_t count = 0;
    leaf_walk walk = walk_of(reach, tree);
    for (const crease_node *leaf; count <= most && (leaf = next_leaf(&walk)) != NULL;)
        for (uint32_t i = leaf->begin; i < leaf->end; i++)
            count += is_within(reach, tree, i);
    return count > most;
}

/* The points of a leaf by themselves never want more than k each. */
static void judge_leaves(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const struct reaching *const run = user;
    for (size_t leaf = begin; leaf < end; leaf++) {
        const double limit = run->leaves[leaf].limit;
        const crease_reach reach = reach_of(leaf_of(run, leaf), limit);
        run->leaves[leaf].apart = !(limit <= unusual * run->usual) ||
            holds_more(&reach, run->tree, (size_t)MANY * (size_t)run->k);
    }
}

static void write_reaches(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const struct reaching *const run = user;
    const crease_tree *const tree = run->tree;
    double limits[CREASE_LEAF_POINTS], hint = 0;
    for (size_t leaf = begin; leaf < end; leaf++) {
        const crease_node *const node = leaf_of(run, leaf);
        crease_reach *const reaches = run->reaches + run->leaves[leaf].begins;
        reaches[0] = reach_of(node, run->leaves[leaf].limit);
        if (!run->leaves[leaf].apart)
            continue;
        find_limits(run, leaf, &hint, limits);
        for (uint32_t i = 0; i < node->end - node->begin; i++) {
            const uint32_t at = node->begin + i;
            const double place[3] = {tree->x[at], tree->y[at], tree->z[at]};
            reaches[i] = (crease_reach){.limit = limits[i], .nearest = (uint64_t)run->k};
            memcpy(reaches[i].low, place, sizeof place);
            memcpy(reaches[i].high, place, sizeof place);
        }
    }
}

/* The median of the leaves' limits. */
static crease_status find_usual(crease_context *context, struct reaching *run)
{
    const size_t count = run->tree->leaf_count;
    double *const limits = crease_allocate(context, count, sizeof *limits);
    if (!limits)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t leaf = 0; leaf < count; leaf++)
        limits[leaf] = run->leaves[leaf].limit;
    run->usual = count > 0 && run->tree->count >= (size_t)run->k
        ? crease_select(limits, count, count / 2)
        : 0.0;
    free(limits);
    return CREASE_OK;
}

static crease_status list_reaches(
    crease_context *context, struct reaching *run, crease_reaches *out)
{
    size_t count = 0;
    for (size_t leaf = 0; leaf < run->tree->leaf_count; leaf++) {
        const crease_node *const node = leaf_of(run, leaf);
        run->leaves[leaf].begins = count;
        count += run->leaves[leaf].apart ? node->end - node->begin : 1;
    }
    out->items = run->reaches = crease_allocate(context, count, sizeof *out->items);
    out->count = count;
    return out->items
        ? crease_parallel_for(context, run->tree->leaf_count, GRAIN, write_reaches, run)
        : CREASE_ERROR_NO_MEMORY;
}

crease_status crease_reaches_find(
    crease_context *context, const crease_tree *tree, int k, crease_reaches *out)
{
    struct reaching run = {.tree = tree, .k = k};
    *out = (crease_reaches){0};
    run.leaves = crease_allocate(context, tree->leaf_count, sizeof *run.leaves);
    crease_status status = run.leaves
        ? crease_parallel_for(context, tree->leaf_count, GRAIN, measure_leaves, &run)
        : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK)
        status = find_usual(context, &run);
    if (status == CREASE_OK)
        status = crease_parallel_for(context, tree->leaf_count, GRAIN, judge_leaves, &run);
    if (status == CREASE_OK)
        status = list_reaches(context, &run, out);
    free(run.leaves);
    if (status != CREASE_OK)
        crease_reaches_free(out);
    return status;
}

void crease_reaches_free(crease_reaches *reaches)
{
    free(reaches->items);
    *reaches = (crease_reaches){0};
}

static double gap(double low, double high, double other_low, double other_high)
{
    const double below = low - other_high, above = other_low - high;
    const double away = below > above ? below : above;
    return away > 0 ? away : 0;
}

bool crease_reach_touches(const crease_reach *reach, const double low[3], const double high[3])
{
    double squared = 0;
    for (int axis = 0; axis < 3; axis++) {
        const double away = gap(reach->low[axis], reach->high[axis], low[axis], high[axis]);
        squared += away * away;
    }
    return squared <= reach->limit;
}

double crease_reach_limit(const crease_reach *reach, const crease_tree *tree)
{
    uint32_t positions[CREASE_MOST_NEIGHBOURS];
    double distances[CREASE_MOST_NEIGHBOURS];
    if (!reach->nearest || tree->count < reach->nearest)
        return reach->limit;
    crease_tree_nearest_place(
        tree, reach->low, CREASE_NO_POSITION, (int)reach->nearest, positions, distances);
    return fmin(reach->limit, distances[reach->nearest - 1]);
}

void crease_reach_mark(const crease_reach *asked, const crease_tree *tree, uint8_t *wanted)
{
    crease_reach reach = *asked;
    reach.limit = crease_reach_limit(asked, tree);
    leaf_walk walk = walk_of(&reach, tree);
    for (const crease_node *leaf; (leaf = next_leaf(&walk)) != NULL;)
        for (uint32_t i = leaf->begin; i < leaf->end; i++)
            if (is_within(&reach, tree, i))
                wanted[tree->index[i]] = 1;
}

size_t crease_tree_boxes(const crease_tree *tree, size_t most, double *boxes)
{
    const size_t leaves = tree->leaf_count, count = leaves < most ? leaves : most;
    for (size_t b = 0; b < count; b++) {
        double *const low = boxes + 6 * b, *const high = low + 3;
        for (size_t leaf = b * leaves / count; leaf < (b + 1) * leaves / count; leaf++) {
            const crease_node *const node = tree->nodes + tree->leaves[leaf];
            const bool first = leaf == b * leaves / count;
            for (int axis = 0; axis < 3; axis++) {
                low[axis] = first ? node->low[axis] : fmin(low[axis], node->low[axis]);
                high[axis] = first ? node->high[axis] : fmax(high[axis], node->high[axis]);
            }
        }
    }
    return count;
}
