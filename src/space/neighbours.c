/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "space/neighbours.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "space/kdtree.h"

#include <stdlib.h>

enum { LEAF_GRAIN = 32 };

struct filling {
    const crease_tree *tree;
    crease_neighbours *neighbours;
};

static void fill(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const struct filling *filling = user;
    const crease_tree *const tree = filling->tree;
    const size_t k = (size_t)filling->neighbours->k;
    uint32_t positions[CREASE_LEAF_POINTS * CREASE_MOST_NEIGHBOURS];
    double distances[CREASE_LEAF_POINTS * CREASE_MOST_NEIGHBOURS];
    double reach = 0;
    for (size_t leaf = begin; leaf < end; leaf++) {
        const crease_node *const node = tree->nodes + tree->leaves[leaf];
        crease_tree_leaf_nearest(tree, leaf, (int)k, &reach, positions, distances);
        const uint32_t *from = positions;
        for (uint32_t position = node->begin; position < node->end; position++) {
            uint32_t *to = filling->neighbours->indices + tree->index[position] * k;
            for (size_t j = 0; j < k; j++)
                *to++ = tree->index[*from++];
        }
    }
}

crease_status crease_neighbours_create(
    crease_context *context, size_t count, int k, crease_neighbours **out)
{
    crease_neighbours *const neighbours = crease_allocate(context, 1, sizeof *neighbours);
    *out = NULL;
    if (!neighbours)
        return CREASE_ERROR_NO_MEMORY;
    *neighbours = (crease_neighbours){.count = count, .k = k};
    neighbours->indices = crease_allocate(context, count, (size_t)k * sizeof(uint32_t));
    if (!neighbours->indices) {
        crease_neighbours_free(neighbours);
        return CREASE_ERROR_NO_MEMORY;
    }
    *out = neighbours;
    return CREASE_OK;
}

static crease_status check(crease_context *context, size_t count, int k)
{
    if (k < 1 || k > CREASE_MOST_NEIGHBOURS)
        return crease_fail(context, CREASE_ERROR_ARGUMENT, "neighbours: %d asked for; take 1 to %d",
            k, CREASE_MOST_NEIGHBOURS);
    if ((size_t)k > count)
        return crease_fail(context, CREASE_ERROR_TOO_FEW_POINTS,
            "neighbours: the cloud has %zu points, fewer than the %d neighbours asked for; ask for "
            "fewer",
            count, k);
    return CREASE_OK;
}

crease_status crease_neighbours_find(
    crease_context *context, const crease_cloud *cloud, int k, crease_neighbours **out)
{
    *out = NULL;
    const size_t count = crease_cloud_count(cloud);
    crease_tree *tree = NULL;
    crease_neighbours *neighbours = NULL;
    crease_status status = check(context, count, k);
    if (status != CREASE_OK)
        return status;
    crease_stage(context, "neighbours");
    status = crease_tree_create(context, crease_cloud_points(cloud), count, &tree);
    if (status == CREASE_OK)
        status = crease_neighbours_create(context, count, k, &neighbours);
    if (status == CREASE_OK) {
        struct filling filling = {tree, neighbours};
        status = crease_parallel_for(context, tree->leaf_count, LEAF_GRAIN, fill, &filling);
    }
    crease_tree_free(tree);
    if (status == CREASE_OK)
        *out = neighbours;
    else
        crease_neighbours_free(neighbours);
    return status;
}

void crease_neighbours_free(crease_neighbours *neighbours)
{
    if (!neighbours)
        return;
    free(neighbours->indices);
    free(neighbours);
}

size_t crease_neighbours_count(const crease_neighbours *neighbours)
{
    return neighbours->count;
}

int crease_neighbours_k(const crease_neighbours *neighbours)
{
    return neighbours->k;
}

const uint32_t *crease_neighbours_of(const crease_neighbours *neighbours, size_t point)
{
    return neighbours->indices + point * (size_t)neighbours->k;
}
