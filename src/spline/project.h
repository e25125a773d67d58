/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The closest point of a whole surface or curve, borders and creases included. */
#ifndef CREASE_SPLINE_PROJECT_H
#define CREASE_SPLINE_PROJECT_H

#include "base/context.h"

/* The same as crease_surface_project for a curve: uv[0] is the curve's parameter, uv[1] zero, and
 * the distance is not signed. */
crease_status crease_curve_project(crease_context *context, const crease_curve *curve,
    const double *points, size_t count, crease_foot *feet);

#endif
