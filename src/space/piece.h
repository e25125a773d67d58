/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A piece of a cloud that is worked on by itself: its own points, and of the others those that are
 * among the nearest of its own. Pieces let several processes share a cloud, or one process work on
 * a cloud that its memory does not hold, without any result depending on how it was cut.
 *
 * The others are found in one exchange. Among its own points alone a piece finds, for each point, k
 * that are near: no farther, therefore, than their k-th are the true nearest ones. Every leaf of
 * its tree asks for what is within the farthest such distance of the box around its points, and
 * whoever has other points hands out those. Where that would be much, since outliers are far from
 * everything, each point of the leaf asks for itself, and for its nearest alone. */
#ifndef CREASE_SPACE_PIECE_H
#define CREASE_SPACE_PIECE_H

#include "space/kdtree.h"

typedef struct crease_piece {
    size_t count;
    const double *points;    /* count x 3 */
    const uint32_t *numbers; /* of the points in the whole cloud, ascending, so that equal distances
                                are ordered as in the whole; NULL: 0, 1, 2, ... */
    const uint8_t *own;      /* 1 for own points, 0 for others'; NULL: all are own */
} crease_piece;

static inline size_t crease_piece_number(const crease_piece *piece, size_t point)
{
    return piece->numbers ? piece->numbers[point] : point;
}

static inline bool crease_piece_owns(const crease_piece *piece, size_t point)
{
    return !piece->own || piece->own[point];
}

/* Asks for points whose squared distance to a box is at most the limit. */
typedef struct crease_reach {
    double low[3], high[3];
    double limit;     /* infinite: all points */
    uint64_t nearest; /* 0: all of them; else the box is a place, and those that are not among so
                         many nearest of it are not needed */
} crease_reach;

typedef struct crease_reaches {
    crease_reach *items;
    size_t count;
} crease_reaches;

/* The k nearest points of a tree's points are among those that these reaches hold, whatever other
 * points there are: one for each leaf, or, where that would hold far too much, one for each of its
 * points. k: at most CREASE_MOST_NEIGHBOURS. Threaded. Errors: NO_MEMORY, CANCELLED. */
crease_status crease_reaches_find(
    crease_context *context, const crease_tree *tree, int k, crease_reaches *out);
void crease_reaches_free(crease_reaches *reaches);
/* Whether any point of the box could be within reach. */
bool crease_reach_touches(const crease_reach *reach, const double low[3], const double high[3]);
/* The squared distance within which a tree has all that the reach wants of it: for a reach of the
 * nearest, the limit or less. */
double crease_reach_limit(const crease_reach *reach, const crease_tree *tree);
/* Sets wanted[index] = 1 for the points of a tree that the reach wants. */
void crease_reach_mark(const crease_reach *reach, const crease_tree *tree, uint8_t *wanted);
/* Covers the points of a tree with at most `most` boxes, low and high: 6 numbers each. Returns how
 * many there are. most: at least 1. */
size_t crease_tree_boxes(const crease_tree *tree, size_t most, double *boxes);

#endif
