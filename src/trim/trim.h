/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Trimmed sheets. Internal view. */
#ifndef CREASE_TRIM_TRIM_H
#define CREASE_TRIM_TRIM_H

#include "base/context.h"
#include "crease/crease_trim.h"
#include "trim/fringe.h"

typedef struct crease_trim_face {
    size_t piece;
    size_t first_loop, loop_count;
} crease_trim_face;

struct crease_trim {
    bool whole;
    size_t vertex_count;
    double *vertices; /* vertex_count x 2 */
    size_t edge_count;
    crease_trim_edge *edges;
    crease_curve **curves; /* of the edges */
    size_t face_count;
    crease_trim_face *faces;
    size_t *first_half; /* of all loops, and the end */
    crease_trim_half *halves;
    size_t piece_count;
    crease_surface **pieces;
    size_t crease_count;
    crease_curve **creases;
};

/* What a trimmed sheet is made from. */
typedef struct crease_trimming {
    crease_context *context;
    const crease_sheet *sheet;
    double scale[2];            /* from u, v to the plane */
    double *places;             /* of the points, in the plane */
    double *knots[2], *cuts[2]; /* at which the surface may be sharp: u or v, and in the plane */
    crease_scatter scatter;
    crease_frontier frontier;
    crease_overlay overlay;
    bool whole;
} crease_trimming;

/* Vertices, edges and their curves, from the overlay. */
crease_status crease_trim_make_edges(crease_trimming *task, crease_trim *trim);
/* The edges along a crease line of the sheet that have two faces, as curves in space; those that
 * go on from each other are one. */
crease_status crease_trim_add_creases(crease_trimming *task, size_t line, crease_trim *trim);

#endif
