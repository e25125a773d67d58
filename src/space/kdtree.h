/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The k-d tree. Internal view.
 *
 * Points are kept in tree order (Morton order), coordinates in three arrays, so that a leaf is a
 * short run of them. A "position" is a place in tree order, an "index" is the original one. */
#ifndef CREASE_SPACE_KDTREE_H
#define CREASE_SPACE_KDTREE_H

#include "base/context.h"

enum { CREASE_LEAF_POINTS = 32, CREASE_MOST_NEIGHBOURS = 256, CREASE_TREE_DEPTH = 128 };

/* A run of positions and the smallest box around its points. The first child follows its parent. */
typedef struct crease_node {
    double low[3], high[3];
    uint32_t begin, end;
    uint32_t second; /* number of the second child; 0: a leaf */
    uint32_t lowest; /* lowest index of the run */
} crease_node;

struct crease_tree {
    size_t count, node_count, leaf_count;
    double *x, *y, *z; /* by position */
    uint32_t *index;   /* original index by position */
    crease_node *nodes;
    uint32_t *leaves; /* numbers of the leaf nodes, in tree order */
};

/* The k nearest points of each point of one leaf, the point itself first, then by distance, equal
 * distances by original index; as positions, not indices. k: 1..CREASE_MOST_NEIGHBOURS, at most the
 * tree's count. The leaf's points are positions nodes[leaves[leaf]].begin .. end - 1;
 * positions and squared_distances hold CREASE_LEAF_POINTS x k elements. Works without allocating,
 * so that a later stage can go through all points leaf by leaf and never store all neighbours:
 * let crease_parallel_for run over tree->leaf_count. *reach: 0 for the first leaf of a run of
 * leaves; afterwards what the call for the leaf before left there. It serves speed alone: the
 * result is the same for any number. */
void crease_tree_leaf_nearest(const crease_tree *tree, size_t leaf, int k, double *reach,
    uint32_t *positions, double *squared_distances);

#endif
