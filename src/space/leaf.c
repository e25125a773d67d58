/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The nearest points of all points of a leaf at once. One of them, in the middle, is looked up
 * from the root; by the triangle inequality its k-th distance bounds that of all others, and one
 * walk through the tree gathers the candidates for all of them. Where there are too many candidates
 * (heaps of equal points, jumps of density) each point is looked up on its own. */
#include "space/candidates.h"
#include "space/nearest.h"

#include <math.h>

enum { LEAST_POINTS = 4 };

typedef struct leaf_search {
    const crease_tree *tree;
    const crease_node *leaf;
    int k;
    uint32_t middle;         /* position of the point that was looked up */
    double centre[3];        /* its place */
    double reach;            /* its k-th distance */
    double box_limit, limit; /* squared: of candidates from the leaf's box and from the centre */
    crease_candidates *candidates;
} leaf_search;

static void place_of(const crease_tree *tree, uint32_t position, double place[3])
{
    place[0] = tree->x[position];
    place[1] = tree->y[position];
    place[2] = tree->z[position];
}

/* A length a little above, so that no rounding can make a bound too small. */
static double above(double length)
{
    return length * (1 + 1e-9) + 1e-150;
}

static double squared_distance(const crease_tree *tree, uint32_t position, const double place[3])
{
    const double dx = tree->x[position] - place[0];
    const double dy = tree->y[position] - place[1];
    const double dz = tree->z[position] - place[2];
    return dx * dx + dy * dy + dz * dz;
}

static uint32_t find_middle(const crease_tree *tree, const crease_node *leaf)
{
    double middle[3];
    for (int axis = 0; axis < 3; axis++)
        middle[axis] = 0.5 * leaf->low[axis] + 0.5 * leaf->high[axis];
    uint32_t best = leaf->begin;
    double least = INFINITY;
    for (uint32_t i = leaf->begin; i < leaf->end; i++) {
        const double away = squared_distance(tree, i, middle);
        best = away < least ? i : best;
        least = away < least ? away : least;
    }
    return best;
}

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

/* The leaf's own points first: candidate number i is its point i. False when there are too many. */
static bool gather(leaf_search *search)
{
    const crease_tree *const tree = search->tree;
    uint32_t stack[CREASE_TREE_DEPTH];
    int height = 0;
    search->candidates->count = 0;
    crease_candidates_add(
        search->candidates, tree, search->leaf->begin, search->leaf->end, search->centre, INFINITY);
    stack[height++] = 0;
    while (height > 0) {
        const crease_node *const node = tree->nodes + stack[--height];
        if (node == search->leaf || box_gap(node, search->leaf) > search->box_limit)
            continue;
        if (node->second) {
            stack[height++] = node->second;
            stack[height++] = (uint32_t)(node + 1 - tree->nodes);
        } else if (!crease_candidates_add(search->candidates, tree, node->begin, node->end,
                       search->centre, search->limit)) {
            return false;
        }
    }
    return true;
}

/* Looks up the middle point and bounds all others by it. */
static void look_up_middle(leaf_search *search, uint32_t *positions, double *squared_distances)
{
    const crease_tree *const tree = search->tree;
    const size_t k = (size_t)search->k;
    const size_t row = (search->middle - search->leaf->begin) * k;
    place_of(tree, search->middle, search->centre);
    crease_tree_nearest_place(
        tree, search->centre, search->middle, search->k, positions + row, squared_distances + row);
    search->reach = sqrt(squared_distances[row + k - 1]);
    double farthest = 0;
    for (uint32_t i = search->leaf->begin; i < search->leaf->end; i++) {
        const double away = squared_distance(tree, i, search->centre);
        farthest = away > farthest ? away : farthest;
    }
    const double box = above(search->reach + sqrt(farthest));
    const double ball = above(box + sqrt(farthest));
    search->box_limit = box * box;
    search->limit = ball * ball;
}

static bool search_candidates(
    const leaf_search *search, uint32_t position, uint32_t *positions, double *squared_distances)
{
    crease_request request = {.self = position - search->leaf->begin, .k = search->k};
    place_of(search->tree, position, request.place);
    const double away = sqrt(squared_distance(search->tree, position, search->centre));
    const double bound = above(search->reach + away);
    request.bound = bound * bound;
    request.guess = 1.1 * search->reach * search->reach;
    return crease_candidates_nearest(search->candidates, &request, positions, squared_distances);
}

void crease_tree_leaf_nearest(
    const crease_tree *tree, size_t leaf, int k, uint32_t *positions, double *squared_distances)
{
    crease_candidates candidates;
    leaf_search search = {.tree = tree, .leaf = tree->nodes + tree->leaves[leaf], .k = k};
    search.candidates = &candidates;
    search.middle = find_middle(tree, search.leaf);
    look_up_middle(&search, positions, squared_distances);
    const bool together = search.leaf->end - search.leaf->begin >= LEAST_POINTS && gather(&search);
    for (uint32_t i = search.leaf->begin; i < search.leaf->end; i++) {
        double place[3];
        const size_t row = (i - search.leaf->begin) * (size_t)k;
        if (i == search.middle ||
            (together && search_candidates(&search, i, positions + row, squared_distances + row)))
            continue;
        place_of(tree, i, place);
        crease_tree_nearest_place(tree, place, i, k, positions + row, squared_distances + row);
    }
}
