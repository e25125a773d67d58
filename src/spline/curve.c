/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "spline/curve.h"

#include "base/memory.h"
#include "spline/basis.h"
#include "spline/knots.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static crease_status check_points(crease_context *context, size_t count, const double *points)
{
    if (!points)
        return crease_fail(context, CREASE_ERROR_ARGUMENT, "curve: no control points were given");
    for (size_t i = 0; i < 3 * count; i++)
        if (!isfinite(points[i]))
            return crease_fail(
                context, CREASE_ERROR_ARGUMENT, "curve: control point %zu is not finite", i / 3);
    return CREASE_OK;
}

crease_status crease_curve_create(crease_context *context, int order, size_t count,
    const double *knots, const double *control_points, crease_curve **out)
{
    *out = NULL;
    crease_status status = crease_knots_check(context, "curve", order, count, knots);
    if (status == CREASE_OK)
        status = check_points(context, count, control_points);
    if (status != CREASE_OK)
        return status;
    crease_curve *curve = crease_allocate(context, 1, sizeof *curve);
    if (!curve)
        return CREASE_ERROR_NO_MEMORY;
    curve->order = order;
    curve->count = count;
    curve->knots = crease_duplicate(context, knots, count + (size_t)order, sizeof(double));
    curve->control_points = crease_duplicate(context, control_points, count, 3 * sizeof(double));
    if (!curve->knots || !curve->control_points) {
        crease_curve_free(curve);
        return CREASE_ERROR_NO_MEMORY;
    }
    *out = curve;
    return CREASE_OK;
}

void crease_curve_free(crease_curve *curve)
{
    if (!curve)
        return;
    free(curve->knots);
    free(curve->control_points);
    free(curve);
}

int crease_curve_order(const crease_curve *curve)
{
    return curve->order;
}

size_t crease_curve_count(const crease_curve *curve)
{
    return curve->count;
}

const double *crease_curve_knots(const crease_curve *curve)
{
    return curve->knots;
}

const double *crease_curve_control_points(const crease_curve *curve)
{
    return curve->control_points;
}

void crease_curve_domain(const crease_curve *curve, double domain[2])
{
    domain[0] = curve->knots[curve->order - 1];
    domain[1] = curve->knots[curve->count];
}

void crease_curve_evaluate(
    const crease_curve *curve, double t, crease_side side, int derivatives, double *out)
{
    const int order = curve->order;
    const int most = derivatives < order ? derivatives : order - 1;
    double basis[CREASE_ORDER_MAX * CREASE_ORDER_MAX];
    t = crease_basis_clamp(curve->knots, order, curve->count, t);
    const size_t span = crease_basis_span(curve->knots, order, curve->count, t, side);
    crease_basis_derivatives(curve->knots, order, span, t, most, basis);
    memset(out, 0, ((size_t)derivatives + 1) * 3 * sizeof *out);
    const double *const points = curve->control_points + 3 * (span + 1 - (size_t)order);
    for (int d = 0; d <= most; d++)
        for (int i = 0; i < order; i++)
            for (int c = 0; c < 3; c++)
                out[3 * d + c] += basis[d * order + i] * points[3 * i + c];
}
