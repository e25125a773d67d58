/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#ifndef CREASE_SPLINE_SURFACE_H
#define CREASE_SPLINE_SURFACE_H

#include "base/context.h"

struct crease_surface {
    int order[2];
    size_t count[2];
    double *knots[2];       /* count + order each */
    double *control_points; /* count[0] x count[1] x 3 */
};

/* The same surface over knots that hold all of its own along a direction. */
crease_status crease_surface_refine(crease_context *context, const crease_surface *surface,
    int direction, const double *knots, size_t count, crease_surface **out);
/* The curve in the surface where the parameter of a direction is t (0: u = t, so it runs along v);
 * clamped as the surface is. */
crease_status crease_surface_isocurve(crease_context *context, const crease_surface *surface,
    int direction, double t, crease_side side, crease_curve **out);
/* The distinct knots of the domain along a direction, in order: at least two. Returns their number;
 * out has room for count[direction] + 1. */
size_t crease_surface_breaks(const crease_surface *surface, int direction, double *out);

#endif
