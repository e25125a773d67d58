/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Squared distances of points and of boxes are computed by the same operations, each of which
 * rounds monotonically: no point that is as near as the limit is missed by rounding. */
#include "space/piece.h"

#include "base/parallel.h"

#include <math.h>
#include <string.h>

enum { GRAIN = 32 };

struct reaching {
    const crease_tree *tree;
    int k;
    crease_reach *reaches;
};

static void reach_leaves(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const struct reaching *const run = user;
    const size_t k = (size_t)run->k;
    uint32_t positions[CREASE_LEAF_POINTS * CREASE_MOST_NEIGHBOURS];
    double distances[CREASE_LEAF_POINTS * CREASE_MOST_NEIGHBOURS], hint = 0;
    for (size_t leaf = begin; leaf < end; leaf++) {
        const crease_node *const node = run->tree->nodes + run->tree->leaves[leaf];
        crease_reach *const reach = &run->reaches[leaf];
        memcpy(reach->low, node->low, sizeof reach->low);
        memcpy(reach->high, node->high, sizeof reach->high);
        reach->limit = run->tree->count < k ? INFINITY : 0;
        if (run->tree->count < k)
            continue;
        crease_tree_leaf_nearest(run->tree, leaf, run->k, &hint, positions, distances);
        for (uint32_t i = 0; i < node->end - node->begin; i++)
            reach->limit = fmax(reach->limit, distances[i * k + k - 1]);
    }
}

crease_status crease_reach_find(
    crease_context *context, const crease_tree *tree, int k, crease_reach *reaches)
{
    struct reaching run = {tree, k, reaches};
    return crease_parallel_for(context, tree->leaf_count, GRAIN, reach_leaves, &run);
}

static double outside(double low, double high, double value)
{
    const double below = low - value, above = value - high;
    const double away = below > above ? below : above;
    return away > 0 ? away : 0;
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

static void mark_leaf(
    const crease_reach *reach, const crease_tree *tree, const crease_node *leaf, uint8_t *wanted)
{
    for (uint32_t i = leaf->begin; i < leaf->end; i++) {
        const double dx = outside(reach->low[0], reach->high[0], tree->x[i]);
        const double dy = outside(reach->low[1], reach->high[1], tree->y[i]);
        const double dz = outside(reach->low[2], reach->high[2], tree->z[i]);
        if (dx * dx + dy * dy + dz * dz <= reach->limit)
            wanted[tree->index[i]] = 1;
    }
}

void crease_reach_mark(const crease_reach *reach, const crease_tree *tree, uint8_t *wanted)
{
    uint32_t stack[CREASE_TREE_DEPTH];
    int height = 0;
    if (tree->count > 0)
        stack[height++] = 0;
    while (height > 0) {
        const crease_node *const node = tree->nodes + stack[--height];
        if (!crease_reach_touches(reach, node->low, node->high))
            continue;
        if (node->second) {
            stack[height++] = node->second;
            stack[height++] = (uint32_t)(node + 1 - tree->nodes);
        } else {
            mark_leaf(reach, tree, node, wanted);
        }
    }
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
