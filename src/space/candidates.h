/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A short list of points among which the nearest of several places are. */
#ifndef CREASE_SPACE_CANDIDATES_H
#define CREASE_SPACE_CANDIDATES_H

#include "space/kdtree.h"

enum { CREASE_MOST_CANDIDATES = 2048, CREASE_MOST_SELECTED = 512 };

typedef struct crease_candidates {
    size_t count;
    double x[CREASE_MOST_CANDIDATES], y[CREASE_MOST_CANDIDATES], z[CREASE_MOST_CANDIDATES];
    double index[CREASE_MOST_CANDIDATES]; /* original index, to tell equal distances apart */
    uint32_t position[CREASE_MOST_CANDIDATES];
    double distance[CREASE_MOST_CANDIDATES]; /* squared, to the place in question: scratch */
} crease_candidates;

/* One place and what is known about its k nearest points. */
typedef struct crease_request {
    double place[3];
    size_t self; /* number of the candidate that comes first whatever its equals are */
    int k;
    double guess; /* squared distance of about the k-th */
    double bound; /* squared distance within which there are k points, all of them candidates */
} crease_request;

/* Adds the points of a run of positions whose squared distance to the place is within the limit.
 * False when there is no room for the run. */
bool crease_candidates_add(crease_candidates *candidates, const crease_tree *tree, uint32_t begin,
    uint32_t end, const double place[3], double limit);

/* The k nearest candidates, nearest first, ties by index. False when more than
 * CREASE_MOST_SELECTED would have to be sorted, or the bound was wrong. */
bool crease_candidates_nearest(crease_candidates *candidates, const crease_request *request,
    uint32_t *positions, double *squared_distances);

#endif
