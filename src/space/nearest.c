/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The search goes to the nearer child first and leaves out what cannot hold a nearer point. The
 * squared distance to a box is computed by the same operations as that to a point, and each of them
 * rounds monotonically: the box is never farther than a point in it, so the result is exact.
 *
 * Based on: Friedman, Bentley, Finkel. An algorithm for finding best matches in logarithmic
 * expected time. 1977. */
#include "space/nearest.h"

#include "base/memory.h"
#include "base/parallel.h"

#include <math.h>

struct search {
    const crease_tree *tree;
    const double *place;
    uint32_t self;
    int k, found;
    uint32_t *positions;
    double *distances; /* squared, ascending; ties by index */
};

struct visit {
    uint32_t node;
    double distance;
};

static double outside(double low, double high, double value)
{
    const double below = low - value, above = value - high;
    const double away = below > above ? below : above;
    return away > 0 ? away : 0;
}

static double box_distance(const crease_node *node, const double place[3])
{
    const double dx = outside(node->low[0], node->high[0], place[0]);
    const double dy = outside(node->low[1], node->high[1], place[1]);
    const double dz = outside(node->low[2], node->high[2], place[2]);
    return dx * dx + dy * dy + dz * dz;
}

/* Whether a point of this squared distance and index comes before the last of those found. */
static bool wanted(const struct search *search, double distance, uint32_t index)
{
    if (search->found < search->k)
        return true;
    const int last = search->k - 1;
    return distance < search->distances[last] ||
        (distance == search->distances[last] &&
            index < search->tree->index[search->positions[last]]);
}

static void insert(struct search *search, double distance, uint32_t position)
{
    const uint32_t *const indices = search->tree->index;
    int place = search->found < search->k ? search->found++ : search->k - 1;
    for (; place > 0; place--) {
        const double before = search->distances[place - 1];
        const uint32_t other = search->positions[place - 1];
        if (before < distance || (before == distance && indices[other] < indices[position]))
            break;
        search->distances[place] = before;
        search->positions[place] = other;
    }
    search->distances[place] = distance;
    search->positions[place] = position;
}

static void search_leaf(struct search *search, const crease_node *leaf)
{
    const crease_tree *const tree = search->tree;
    const double *const place = search->place;
    const uint32_t count = leaf->end - leaf->begin;
    double distances[CREASE_LEAF_POINTS];
    for (uint32_t i = 0; i < count; i++) {
        const double dx = tree->x[leaf->begin + i] - place[0];
        const double dy = tree->y[leaf->begin + i] - place[1];
        const double dz = tree->z[leaf->begin + i] - place[2];
        distances[i] = dx * dx + dy * dy + dz * dz;
    }
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t position = leaf->begin + i;
        if (wanted(search, distances[i], tree->index[position]) && position != search->self)
            insert(search, distances[i], position);
    }
}

/* Goes down to the nearest leaf; the children passed by wait on the stack. */
static void descend(
    struct search *search, struct visit *stack, int *height, const crease_node *node)
{
    const crease_node *const nodes = search->tree->nodes;
    while (node->second) {
        const crease_node *near = node + 1, *far = nodes + node->second;
        double near_distance = box_distance(near, search->place);
        double far_distance = box_distance(far, search->place);
        if (far_distance < near_distance) {
            const crease_node *const other = near;
            const double distance = near_distance;
            near = far, far = other;
            near_distance = far_distance, far_distance = distance;
        }
        if (wanted(search, far_distance, far->lowest))
            stack[(*height)++] = (struct visit){(uint32_t)(far - nodes), far_distance};
        node = near;
    }
    search_leaf(search, node);
}

void crease_tree_nearest_place(const crease_tree *tree, const double place[3], uint32_t self, int k,
    uint32_t *positions, double *squared_distances)
{
    struct search search = {.tree = tree, .place = place, .self = self, .k = k};
    search.positions = positions;
    search.distances = squared_distances;
    if (self != CREASE_NO_POSITION)
        insert(&search, -1.0, self); /* before all others */
    struct visit stack[CREASE_TREE_DEPTH];
    int height = 0;
    stack[height++] = (struct visit){0, box_distance(tree->nodes, place)};
    while (height > 0) {
        const struct visit next = stack[--height];
        const crease_node *const node = tree->nodes + next.node;
        if (wanted(&search, next.distance, node->lowest))
            descend(&search, stack, &height, node);
    }
    if (self != CREASE_NO_POSITION)
        squared_distances[0] = 0;
}

struct queries {
    const crease_tree *tree;
    const double *places;
    int k;
    uint32_t *indices;
    double *distances;
};

static void answer(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const struct queries *queries = user;
    const int k = queries->k;
    uint32_t positions[CREASE_MOST_NEIGHBOURS];
    double distances[CREASE_MOST_NEIGHBOURS];
    for (size_t i = begin; i < end; i++) {
        crease_tree_nearest_place(
            queries->tree, queries->places + 3 * i, CREASE_NO_POSITION, k, positions, distances);
        for (int j = 0; j < k; j++)
            queries->indices[i * (size_t)k + (size_t)j] = queries->tree->index[positions[j]];
        for (int j = 0; j < k && queries->distances; j++)
            queries->distances[i * (size_t)k + (size_t)j] = distances[j];
    }
}

crease_status crease_tree_nearest(crease_context *context, const crease_tree *tree,
    const double *places, size_t query_count, int k, uint32_t *indices, double *squared_distances)
{
    enum { GRAIN = 256 };
    if (k < 1 || k > CREASE_MOST_NEIGHBOURS || (size_t)k > tree->count)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "tree: %d nearest points asked for; take 1 to %d, at most the %zu points there are", k,
            CREASE_MOST_NEIGHBOURS, tree->count);
    for (size_t i = 0; i < 3 * query_count; i++)
        if (!isfinite(places[i]))
            return crease_fail(context, CREASE_ERROR_VALUE,
                "tree: query %zu has a coordinate that is not finite; leave it out", i / 3);
    struct queries queries = {tree, places, k, indices, squared_distances};
    return crease_parallel_for(context, query_count, GRAIN, answer, &queries);
}
