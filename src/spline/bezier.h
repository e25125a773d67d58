/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The Bezier patches of a surface, one for each pair of knot spans, made when asked for. */
#ifndef CREASE_SPLINE_BEZIER_H
#define CREASE_SPLINE_BEZIER_H

#include "base/context.h"
#include "spline/basis.h"

/* A span of positive length, and how its Bezier points come from the control points index - order +
 * 1 .. index: order x order weights. */
typedef struct crease_span {
    size_t index;
    double ends[2];
    double extract[CREASE_ORDER_MAX * CREASE_ORDER_MAX];
} crease_span;

typedef struct crease_bezier {
    crease_surface_parts parts; /* not owned */
    crease_span *spans[2];
    size_t span_count[2];
} crease_bezier;

crease_status crease_bezier_prepare(
    crease_context *context, const crease_surface_parts *parts, crease_bezier *out);
void crease_bezier_release(crease_bezier *bezier);
/* The order[0] x order[1] points of the patch on a pair of spans, v fastest, relative to a place.
 */
void crease_bezier_patch(
    const crease_bezier *bezier, const size_t patch[2], const double place[3], double *out);

#endif
