/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A region of the plane, cut by lines along its axes: the faces that come out, and the edges and
 * nodes that they share. Everything is polygons here, and exact in their sense: what meets has the
 * same node. */
#ifndef CREASE_TRIM_OVERLAY_H
#define CREASE_TRIM_OVERLAY_H

#include "base/context.h"

/* The border of a region: rings of arcs, the region on their left. Arc number a has the places
 * first_place[a] .. first_place[a + 1] - 1, two or more; the last one is the first one of the next
 * arc of its ring, or of itself. Rings neither cross each other nor themselves. */
typedef struct crease_frontier {
    size_t ring_count, arc_count, place_count;
    size_t *first_arc;   /* ring_count + 1 */
    size_t *first_place; /* arc_count + 1 */
    double *places;      /* place_count x 2 */
} crease_frontier;

void crease_frontier_clear(crease_frontier *frontier);
/* Room for that many; everything is 0. */
crease_status crease_frontier_create(crease_context *context, size_t ring_count, size_t arc_count,
    size_t place_count, crease_frontier *out);
/* Whether no ring crosses or touches itself or another. O(n log n) as a rule. */
crease_status crease_frontier_is_simple(
    crease_context *context, const crease_frontier *frontier, bool *simple);

/* What the region is cut along: x = at[0][i], y = at[1][i], ascending. */
typedef struct crease_cuts {
    size_t count[2];
    const double *at[2];
} crease_cuts;

typedef struct crease_overlay_edge {
    int direction; /* 0: x is constant, on a cut; 1: y is; -1: a stretch of an arc */
    size_t first, count;
    uint32_t nodes[2];
    int32_t faces[2]; /* on its left and right; -1: none */
} crease_overlay_edge;

/* An edge as a loop passes it: twice its number, plus 1 when it is passed backwards. */
typedef uint32_t crease_overlay_half;

/* The loops of a face follow each other; the first one goes around it, the others around holes. All
 * have it on their left. */
typedef struct crease_overlay_face {
    size_t cell[2]; /* between cuts number cell[d] - 1 and cell[d] */
    size_t first_loop, loop_count;
} crease_overlay_face;

typedef struct crease_overlay {
    size_t node_count, node_room;
    double *nodes; /* node_count x 2 */
    size_t place_count, place_room;
    double *places; /* of the edges: count of them from number first on */
    size_t edge_count, edge_room;
    crease_overlay_edge *edges;
    size_t half_count;
    crease_overlay_half *halves; /* by loop */
    size_t loop_count;
    size_t *first_half; /* loop_count + 1 */
    size_t face_count;
    crease_overlay_face *faces;
} crease_overlay;

/* Faces narrower than least_width, in the mean, are left out, but between two cuts. *sound: false
 * where the border turns out to be none. Errors: NO_MEMORY. */
crease_status crease_overlay_find(crease_context *context, const crease_frontier *frontier,
    const crease_cuts *cuts, double least_width, crease_overlay *out, bool *sound);
void crease_overlay_clear(crease_overlay *overlay);

#endif
