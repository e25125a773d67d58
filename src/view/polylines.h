/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Sampled curves: nodes and the links between them. */
#ifndef CREASE_VIEW_POLYLINES_H
#define CREASE_VIEW_POLYLINES_H

#include "base/context.h"

typedef struct crease_polylines {
    double *nodes; /* node_count x 3 */
    size_t node_count, node_room;
    uint32_t *links; /* link_count x 2: nodes joined by a straight line */
    size_t link_count, link_room;
} crease_polylines;

void crease_polylines_free(crease_polylines *lines);
/* Appends a curve, sampled in every knot span. */
crease_status crease_polylines_add_curve(
    crease_context *context, crease_polylines *lines, const crease_curve *curve);
/* Appends the lines of constant parameter that cut each direction of a surface into `cells` parts,
 * its borders included. */
crease_status crease_polylines_add_surface(
    crease_context *context, crease_polylines *lines, const crease_surface *surface, int cells);
/* Appends the borders of a mesh: the sides of its triangles that no other triangle shares. */
crease_status crease_polylines_add_borders(
    crease_context *context, crease_polylines *lines, const crease_mesh *mesh);
/* Appends the control net of a surface. */
crease_status crease_polylines_add_net(
    crease_context *context, crease_polylines *lines, const crease_surface *surface);

#endif
