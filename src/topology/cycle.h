/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Cycles of vertices at which an edge is missing: number i lacks one of regions i and i + 1. What
 * is missing lies between them. */
#ifndef CREASE_TOPOLOGY_CYCLE_H
#define CREASE_TOPOLOGY_CYCLE_H

#include "topology/graph.h"

enum { CREASE_MOST_SIDES = 6 };

/* A vertex that lacks an edge of exactly two regions. */
typedef struct crease_end {
    int32_t vertex;
    uint32_t regions[2]; /* ascending */
} crease_end;

typedef struct crease_cycle {
    int count;
    const crease_end *ends[CREASE_MOST_SIDES];
    uint32_t regions[CREASE_MOST_SIDES];
} crease_cycle;

/* Looks at a cycle; it may add edges to the graph. */
typedef crease_status crease_cycle_visit(void *user, const crease_cycle *cycle);

/* Calls it for every cycle of 3 to 6 ends, small ones first, whose edges are still missing; some
 * thousands at most. */
crease_status crease_cycles_visit(crease_graph *graph, crease_cycle_visit *visit, void *user);

#endif
