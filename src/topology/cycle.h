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

/* All of them, in the order of the vertices; the caller frees the list. */
crease_status crease_ends_list(const crease_graph *graph, crease_end **out, size_t *count);
/* Whether the edge is still missing. */
bool crease_end_is_odd(const crease_graph *graph, const crease_end *end);

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
