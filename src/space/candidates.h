/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A short list of points among which the nearest points of all places in a box are. */
#ifndef CREASE_SPACE_CANDIDATES_H
#define CREASE_SPACE_CANDIDATES_H

#include "space/kdtree.h"

enum { CREASE_MOST_CANDIDATES = 2048, CREASE_MOST_SELECTED = 512 };

typedef struct crease_candidates {
    const crease_tree *tree;
    double low[3], high[3]; /* the box whose surroundings are searched */
    double
        limit; /* squared: candidates are the points whose squared distance to the box is within */
    size_t count;
    double x[CREASE_MOST_CANDIDATES], y[CREASE_MOST_CANDIDATES], z[CREASE_MOST_CANDIDATES];
    uint32_t position[CREASE_MOST_CANDIDATES];
    double distance[CREASE_MOST_CANDIDATES]; /* squared, to the place in question: scratch */
} crease_candidates;

/* One place in the box. */
typedef struct crease_request {
    size_t self; /* number of the candidate that is the place and comes first */
    int k;
    double guess; /* squared distance of about the k-th */
} crease_request;

/* Adds those points of a run of positions that are within the limit. False when there is no room
 * for the run. */
bool crease_candidates_add(crease_candidates *candidates, uint32_t begin, uint32_t end);

/* The k nearest points, nearest first, ties by index. False when fewer than k are as near as the
 * limit, so that points beyond it might be nearer than some candidates, or when more than
 * CREASE_MOST_SELECTED would have to be sorted. */
bool crease_candidates_nearest(crease_candidates *candidates, const crease_request *request,
    uint32_t *positions, double *squared_distances);

#endif
