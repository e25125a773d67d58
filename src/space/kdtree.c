/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Making the tree. The points are sorted in Morton order; a run of them is then split where the
 * highest bit in which its keys differ changes, which halves a cell across one axis without moving
 * a point. Runs of equal keys are split in the middle. Boxes are fitted tightly afterwards.
 *
 * Based on: Bentley. Multidimensional binary search trees used for associative searching. 1975.
 * Based on: Lauterbach et al. Fast BVH construction on GPUs. 2009 (splits from Morton keys). */
#include "space/kdtree.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "space/morton.h"

#include <math.h>
#include <stdlib.h>

enum { GATHER_GRAIN = 16384 };

struct gathering {
    crease_tree *tree;
    const double *points;
};

static void gather(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const struct gathering *gathering = user;
    const crease_tree *tree = gathering->tree;
    for (size_t i = begin; i < end; i++) {
        const double *point = gathering->points + 3 * (size_t)tree->index[i];
        tree->x[i] = point[0];
        tree->y[i] = point[1];
        tree->z[i] = point[2];
    }
}

/* Where the second half of the run begins; begin < end - 1. */
static size_t split(const uint64_t *keys, size_t begin, size_t end)
{
    const uint64_t different = keys[begin] ^ keys[end - 1];
    if (different == 0)
        return begin + (end - begin) / 2;
    const uint64_t bit = (uint64_t)1 << (63 - __builtin_clzll(different));
    size_t low = begin, high = end - 1; /* the bit is 0 at low and 1 at high */
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (keys[middle] & bit)
            high = middle;
        else
            low = middle;
    }
    return high;
}

static size_t count_leaves(const uint64_t *keys, size_t begin, size_t end)
{
    if (end - begin <= CREASE_LEAF_POINTS)
        return 1;
    const size_t middle = split(keys, begin, end);
    return count_leaves(keys, begin, middle) + count_leaves(keys, middle, end);
}

static void bound(const double *values, size_t begin, size_t end, double *low, double *high)
{
    *low = INFINITY;
    *high = -INFINITY;
    for (size_t i = begin; i < end; i++) {
        *low = values[i] < *low ? values[i] : *low;
        *high = values[i] > *high ? values[i] : *high;
    }
}

static void make_leaf(crease_tree *tree, crease_node *node)
{
    bound(tree->x, node->begin, node->end, &node->low[0], &node->high[0]);
    bound(tree->y, node->begin, node->end, &node->low[1], &node->high[1]);
    bound(tree->z, node->begin, node->end, &node->low[2], &node->high[2]);
    node->lowest = UINT32_MAX;
    for (size_t i = node->begin; i < node->end; i++)
        node->lowest = tree->index[i] < node->lowest ? tree->index[i] : node->lowest;
    tree->leaves[tree->leaf_count++] = (uint32_t)(node - tree->nodes);
}

static void unite(crease_node *node, const crease_node *a, const crease_node *b)
{
    for (int axis = 0; axis < 3; axis++) {
        node->low[axis] = a->low[axis] < b->low[axis] ? a->low[axis] : b->low[axis];
        node->high[axis] = a->high[axis] > b->high[axis] ? a->high[axis] : b->high[axis];
    }
    node->lowest = a->lowest < b->lowest ? a->lowest : b->lowest;
}

/* Makes the node of a run and all below it; returns it. */
static const crease_node *make_node(
    crease_tree *tree, const uint64_t *keys, size_t begin, size_t end)
{
    crease_node *node = tree->nodes + tree->node_count++;
    node->begin = (uint32_t)begin;
    node->end = (uint32_t)end;
    if (end - begin <= CREASE_LEAF_POINTS) {
        make_leaf(tree, node);
        return node;
    }
    const size_t middle = split(keys, begin, end);
    const crease_node *first = make_node(tree, keys, begin, middle);
    const crease_node *second = make_node(tree, keys, middle, end);
    node->second = (uint32_t)(second - tree->nodes);
    unite(node, first, second);
    return node;
}

static crease_status build(
    crease_context *context, crease_tree *tree, const double *points, uint64_t *keys)
{
    crease_status status = crease_morton_sort(context, points, tree->count, keys, tree->index);
    if (status != CREASE_OK)
        return status;
    struct gathering gathering = {tree, points};
    status = crease_parallel_for(context, tree->count, GATHER_GRAIN, gather, &gathering);
    if (status != CREASE_OK || tree->count == 0)
        return status;
    const size_t leaves = count_leaves(keys, 0, tree->count);
    tree->leaves = crease_allocate(context, leaves, sizeof *tree->leaves);
    tree->nodes = crease_allocate(context, 2 * leaves - 1, sizeof *tree->nodes);
    if (!tree->leaves || !tree->nodes)
        return CREASE_ERROR_NO_MEMORY;
    make_node(tree, keys, 0, tree->count);
    return CREASE_OK;
}

static crease_status check(crease_context *context, const double *points, size_t count)
{
    if (count > UINT32_MAX)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "tree: %zu points are more than %u; split the cloud", count, UINT32_MAX);
    for (size_t i = 0; i < 3 * count; i++)
        if (!isfinite(points[i]))
            return crease_fail(context, CREASE_ERROR_VALUE,
                "tree: point %zu has a coordinate that is not finite; leave the point out", i / 3);
    return CREASE_OK;
}

crease_status crease_tree_create(
    crease_context *context, const double *points, size_t count, crease_tree **out)
{
    *out = NULL;
    uint64_t *keys = NULL;
    crease_tree *tree = NULL;
    crease_status status = check(context, points, count);
    if (status != CREASE_OK)
        goto done;
    status = CREASE_ERROR_NO_MEMORY;
    tree = crease_allocate(context, 1, sizeof *tree);
    if (!tree)
        goto done;
    tree->count = count;
    tree->x = crease_allocate(context, count, sizeof *tree->x);
    tree->y = crease_allocate(context, count, sizeof *tree->y);
    tree->z = crease_allocate(context, count, sizeof *tree->z);
    tree->index = crease_allocate(context, count, sizeof *tree->index);
    keys = crease_allocate(context, count, sizeof *keys);
    if (tree->x && tree->y && tree->z && tree->index && keys)
        status = build(context, tree, points, keys);
done:
    free(keys);
    if (status == CREASE_OK)
        *out = tree;
    else
        crease_tree_free(tree);
    return status;
}

void crease_tree_free(crease_tree *tree)
{
    if (!tree)
        return;
    free(tree->x);
    free(tree->y);
    free(tree->z);
    free(tree->index);
    free(tree->nodes);
    free(tree->leaves);
    free(tree);
}

size_t crease_tree_count(const crease_tree *tree)
{
    return tree->count;
}
