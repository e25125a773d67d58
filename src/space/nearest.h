/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The k nearest points of one place, found from the root of the tree downwards. */
#ifndef CREASE_SPACE_NEAREST_H
#define CREASE_SPACE_NEAREST_H

#include "space/kdtree.h"

#define CREASE_NO_POSITION UINT32_MAX

/* self: the position of a point that is to come first whatever its equals are, with the place being
 * its own, or CREASE_NO_POSITION. Results: k elements each, nearest first, ties by index. */
void crease_tree_nearest_place(const crease_tree *tree, const double place[3], uint32_t self, int k,
    uint32_t *positions, double *squared_distances);

#endif
