/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "spline/knots.h"

#include "spline/basis.h"

#include <math.h>
#include <string.h>

static crease_status check_sequence(
    crease_context *context, const char *what, int order, size_t total, const double *knots)
{
    for (size_t i = 0; i < total; i++) {
        if (!isfinite(knots[i]))
            return crease_fail(
                context, CREASE_ERROR_ARGUMENT, "%s: knot %zu is not a finite number", what, i);
        if (i && knots[i] < knots[i - 1])
            return crease_fail(context, CREASE_ERROR_ARGUMENT,
                "%s: knot %zu is below the knot before it; sort the knots", what, i);
        if (i >= (size_t)order && knots[i] == knots[i - (size_t)order])
            return crease_fail(context, CREASE_ERROR_ARGUMENT,
                "%s: knot %zu stands more than %d times; give it at most as often as the order",
                what, i, order);
    }
    return CREASE_OK;
}

crease_status crease_knots_check(
    crease_context *context, const char *what, int order, size_t count, const double *knots)
{
    if (order < 1 || order > CREASE_ORDER_MAX)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "%s: the order is %d; give 1 to %d (4 is cubic)", what, order, CREASE_ORDER_MAX);
    if (count < (size_t)order || count > SIZE_MAX / 64)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "%s: %zu control points; order %d needs at least %d", what, count, order, order);
    if (!knots)
        return crease_fail(context, CREASE_ERROR_ARGUMENT, "%s: no knots were given", what);
    const crease_status status = check_sequence(context, what, order, count + (size_t)order, knots);
    if (status != CREASE_OK)
        return status;
    if (!(knots[order - 1] < knots[count]))
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "%s: the domain is empty; knots %d and %zu must differ", what, order - 1, count);
    return CREASE_OK;
}

/* The knot that lies `step` spans from the beginning of `spans` equal ones; exact at both ends. */
static double equal_knot(double first, double last, double step, double spans)
{
    return step == spans ? last : first + (last - first) * (step / spans);
}

void crease_knots_uniform(int order, size_t count, double first, double last, double *knots)
{
    const size_t degree = (size_t)order - 1;
    const double spans = (double)(count - degree);
    for (size_t i = 0; i < count + (size_t)order; i++)
        knots[i] = equal_knot(first, last, (double)i - (double)degree, spans);
}

void crease_knots_clamped(int order, size_t count, double first, double last, double *knots)
{
    const size_t degree = (size_t)order - 1;
    const double spans = (double)(count - degree);
    for (size_t i = 0; i < count + (size_t)order; i++) {
        const double step = fmin(fmax((double)i - (double)degree, 0.0), spans);
        knots[i] = equal_knot(first, last, step, spans);
    }
}

int crease_knots_multiplicity(const double *knots, size_t total, double t)
{
    int multiplicity = 0;
    for (size_t i = 0; i < total; i++)
        multiplicity += knots[i] == t;
    return multiplicity;
}

void crease_knots_greville(const double *knots, int order, size_t count, double *out)
{
    for (size_t i = 0; i < count; i++) {
        double sum = 0.0;
        for (size_t r = 1; r < (size_t)order; r++)
            sum += knots[i + r];
        out[i] = order > 1 ? sum / (order - 1) : 0.5 * (knots[i] + knots[i + 1]);
    }
}

/* Control point i becomes share * point i + (1 - share) * point i - 1; equal points stay equal. */
static void mix(const crease_rows *points, size_t outer, size_t i, double share)
{
    double *const to = points->values + (outer * points->pitch + i) * points->inner;
    const double *const before = to - points->inner;
    if (share == 0.0) {
        memcpy(to, before, points->inner * sizeof *to);
        return;
    }
    for (size_t c = 0; c < points->inner; c++)
        to[c] = before[c] + share * (to[c] - before[c]);
}

static void insert_points(
    int order, size_t count, const double *knots, size_t span, double t, const crease_rows *points)
{
    const size_t degree = (size_t)order - 1;
    for (size_t outer = 0; outer < points->outer; outer++)
        for (size_t i = count; i + degree > span && i > 0; i--) {
            const bool beyond = i > span || knots[i] == t;
            mix(points, outer, i, beyond ? 0.0 : (t - knots[i]) / (knots[i + degree] - knots[i]));
        }
}

void crease_knots_insert(
    int order, size_t count, double *knots, double t, const crease_rows *points)
{
    const size_t total = count + (size_t)order;
    size_t span = total;
    while (knots[span - 1] > t)
        span--;
    if (points)
        insert_points(order, count, knots, span - 1, t, points);
    memmove(knots + span + 1, knots + span, (total - span) * sizeof *knots);
    knots[span] = t;
}

size_t crease_knots_raise(
    const double *knots, int order, size_t count, double t, int multiplicity, double *out)
{
    memcpy(out, knots, (count + (size_t)order) * sizeof *out);
    const int present = crease_knots_multiplicity(knots, count + (size_t)order, t);
    for (int i = present; i < multiplicity; i++)
        crease_knots_insert(order, count++, out, t, NULL);
    return count;
}

void crease_knots_prolong(int order, const double *knots, size_t count, const double *fine,
    size_t fine_count, size_t *first, double *weights)
{
    for (size_t i = 0; i < fine_count; i++) {
        const size_t span = crease_basis_span(knots, order, count, fine[i], CREASE_SIDE_RIGHT);
        first[i] = span + 1 - (size_t)order;
        crease_basis_blossom(knots, order, span, fine + i + 1, weights + i * (size_t)order);
    }
}
