/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Where the points of regions end, though no edge of theirs is there. */
#ifndef CREASE_TOPOLOGY_REST_H
#define CREASE_TOPOLOGY_REST_H

#include "topology/graph.h"

enum { CREASE_MOST_RESTS = 16 };

typedef struct crease_rests crease_rests;

/* A stretch of a plane region along a unit direction. */
typedef struct crease_rest_side {
    uint32_t region;
    double along[3], low, high;
} crease_rest_side;

crease_status crease_rests_create(const crease_graph *graph, crease_rests **out);
void crease_rests_free(crease_rests *rests);
/* Whether, across their stretches, the points of regions end where their place along the normal is
 * *at or a little beside: returns how long the stretches are of those that do, and moves *at to
 * where that ends which has most points beside it. 0 where the points of a region go on, or fewer
 * than two regions end there in different directions. count: at most CREASE_MOST_RESTS. */
double crease_rests_end(const crease_rests *rests, const crease_rest_side *sides, int count,
    const double normal[3], double *at);

#endif
