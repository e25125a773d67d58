/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The nearest points of all points of a leaf at once. One walk through the tree gathers all points
 * within some reach of the leaf's box. A point whose k-th nearest among them is not beyond that
 * reach has found its nearest points: whatever is nearer to it is nearer to the box, too. The
 * others are looked up from the root, each on its own. The reach is a little more than what the
 * points of the leaf before needed, so that few have to be; for the first leaf, and where there are
 * too many candidates (heaps of equal points, jumps of density), one point is looked up to get it.
 */
#include "space/candidates.h"
#include "space/nearest.h"

#include <math.h>

enum { LEAST_POINTS = 4 };

static const double MARGIN = 1.3; /* reach of a leaf in mean k-th distances of the one before */
static const double MORE = 1.2;   /* squared distances: a guess in those of the point before */

typedef struct leaf_search {
    const crease_tree *tree;
    const crease_node *leaf;
    int k;
    uint32_t *positions;
    double *distances; /* squared */
} leaf_search;

static double box_gap(const crease_node *a, const crease_node *b)
{
    double sum = 0;
    for (int axis = 0; axis < 3; axis++) {
        const double below = a->low[axis] - b->high[axis], over = b->low[axis] - a->high[axis];
        const double gap = below > over ? below : over;
        sum += gap > 0 ? gap * gap : 0;
    }
    return sum;
}

static void begin_at(crease_candidates *candidates, const leaf_search *search, double reach)
{
    candidates->tree = search->tree;
    for (int axis = 0; axis < 3; axis++) {
        candidates->low[axis] = search->leaf->low[axis];
        candidates->high[axis] = search->leaf->high[axis];
    }
    candidates->limit = reach * reach;
    candidates->count = 0;
}

/* The leaf's own points first: candidate number i is its point i. False when there are too many. */
static bool gather(crease_candidates *candidates, const leaf_search *search, double reach)
{
    const crease_tree *const tree = search->tree;
    uint32_t stack[CREASE_TREE_DEPTH];
    int height = 0;
    begin_at(candidates, search, reach);
    crease_candidates_add(candidates, search->leaf->begin, search->leaf->end);
    stack[height++] = 0;
    while (height > 0) {
        const crease_node *const node = tree->nodes + stack[--height];
        if (node == search->leaf || box_gap(node, search->leaf) > candidates->limit)
            continue;
        if (node->second) {
            stack[height++] = node->second;
            stack[height++] = (uint32_t)(node + 1 - tree->nodes);
        } else if (!crease_candidates_add(candidates, node->begin, node->end)) {
            return false;
        }
    }
    return true;
}

/* Finds the nearest points of one point from the root; returns the squared k-th distance. */
static double look_up(const leaf_search *search, uint32_t position)
{
    const crease_tree *const tree = search->tree;
    const size_t row = (position - search->leaf->begin) * (size_t)search->k;
    const double place[3] = {tree->x[position], tree->y[position], tree->z[position]};
    crease_tree_nearest_place(
        tree, place, position, search->k, search->positions + row, search->distances + row);
    return search->distances[row + (size_t)search->k - 1];
}

/* Gathers candidates; false when that is not worth while. */
static bool prepare(crease_candidates *candidates, const leaf_search *search, double reach)
{
    const uint32_t begin = search->leaf->begin, end = search->leaf->end;
    if (end - begin < LEAST_POINTS)
        return false;
    if (reach > 0 && gather(candidates, search, MARGIN * reach))
        return true;
    return gather(candidates, search, MARGIN * sqrt(look_up(search, begin + (end - begin) / 2)));
}

void crease_tree_leaf_nearest(const crease_tree *tree, size_t leaf, int k, double *reach,
    uint32_t *positions, double *squared_distances)
{
    crease_candidates candidates;
    const leaf_search search = {
        tree, tree->nodes + tree->leaves[leaf], k, positions, squared_distances};
    const uint32_t count = search.leaf->end - search.leaf->begin;
    const bool together = prepare(&candidates, &search, *reach);
    double sum = 0, farthest = together ? candidates.limit / (MARGIN * MARGIN) : 0;
    for (uint32_t i = 0; i < count; i++) {
        const size_t row = i * (size_t)k;
        const crease_request request = {.self = i, .k = k, .guess = MORE * farthest};
        if (together &&
            crease_candidates_nearest(
                &candidates, &request, positions + row, squared_distances + row))
            farthest = squared_distances[row + (size_t)k - 1];
        else
            farthest = look_up(&search, search.leaf->begin + i);
        sum += sqrt(farthest);
    }
    *reach = sum / count;
}
