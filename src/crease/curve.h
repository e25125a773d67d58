/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* One cubic B-spline curve through a chain. */
#ifndef CREASE_CREASE_CURVE_H
#define CREASE_CREASE_CURVE_H

#include "base/context.h"

/* Fits a cubic curve with as few equal spans as keep it within the tolerance of the points, or, if
 * no number does, with one for every two points. Open: it begins at the first and ends at the last
 * point exactly. Closed: the first point follows the last, it is twice differentiable all around,
 * and its first and last control point are the same. The parameter is nearly the length. count:
 * at least 2, closed 4. Errors: NUMERIC (all points equal), NO_MEMORY. */
crease_status crease_curve_fit(crease_context *context, const double *points, size_t count,
    bool closed, double tolerance, crease_curve **out);

#endif
