/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The nearest points of all points of a leaf at once. */
#include "space/kdtree.h"

#include "space/nearest.h"

void crease_tree_leaf_nearest(
    const crease_tree *tree, size_t leaf, int k, uint32_t *positions, double *squared_distances)
{
    const crease_node *const node = tree->nodes + tree->leaves[leaf];
    for (uint32_t self = node->begin; self < node->end; self++) {
        const double place[3] = {tree->x[self], tree->y[self], tree->z[self]};
        crease_tree_nearest_place(tree, place, self, k, positions, squared_distances);
        positions += k;
        squared_distances += k;
    }
}
