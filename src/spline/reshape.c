/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The same surface in another form: more knots, clamped ends, two pieces, u and v exchanged; and
 * the curves of constant parameter in it. Declared in crease.h and spline/surface.h. */
#include "base/memory.h"
#include "spline/basis.h"
#include "spline/curve.h"
#include "spline/knots.h"
#include "spline/surface.h"

#include <stdlib.h>
#include <string.h>

/* A surface of the same orders with room for a given net; its numbers are still to be set. */
static crease_surface *allocate(crease_context *context, const int order[2], const size_t count[2])
{
    crease_surface *surface = crease_allocate(context, 1, sizeof *surface);
    if (!surface)
        return NULL;
    for (int d = 0; d < 2; d++) {
        surface->order[d] = order[d];
        surface->count[d] = count[d];
        surface->knots[d] = crease_allocate(context, count[d] + (size_t)order[d], sizeof(double));
    }
    surface->control_points = crease_allocate(context, count[0] * count[1], 3 * sizeof(double));
    if (surface->knots[0] && surface->knots[1] && surface->control_points)
        return surface;
    crease_surface_free(surface);
    return NULL;
}

/* A copy with room for `more` control points along a direction; its count is that of the room. */
static crease_surface *widen(
    crease_context *context, const crease_surface *surface, int direction, size_t more)
{
    size_t count[2] = {surface->count[0], surface->count[1]};
    count[direction] += more;
    crease_surface *wide = allocate(context, surface->order, count);
    if (!wide)
        return NULL;
    for (int d = 0; d < 2; d++)
        memcpy(wide->knots[d], surface->knots[d],
            (surface->count[d] + (size_t)surface->order[d]) * sizeof(double));
    for (size_t i = 0; i < surface->count[0]; i++)
        memcpy(wide->control_points + 3 * i * count[1],
            surface->control_points + 3 * i * surface->count[1],
            3 * surface->count[1] * sizeof(double));
    return wide;
}

static crease_rows rows_along(const crease_surface *surface, int direction)
{
    return direction == 0
        ? (crease_rows){1, surface->count[0], 3 * surface->count[1], surface->control_points}
        : (crease_rows){surface->count[0], surface->count[1], 3, surface->control_points};
}

static crease_status insert(crease_context *context, const crease_surface *surface, int direction,
    double t, size_t times, crease_surface **out)
{
    crease_surface *fine = widen(context, surface, direction, times);
    if (!fine)
        return CREASE_ERROR_NO_MEMORY;
    const crease_rows rows = rows_along(fine, direction);
    for (size_t i = 0; i < times; i++)
        crease_knots_insert(fine->order[direction], surface->count[direction] + i,
            fine->knots[direction], t, &rows);
    *out = fine;
    return CREASE_OK;
}

static bool inside(const crease_surface *surface, int direction, double t, bool border)
{
    double domain[2];
    crease_surface_domain(surface, direction, domain);
    return (t > domain[0] && t < domain[1]) || (border && (t == domain[0] || t == domain[1]));
}

crease_status crease_surface_insert_knot(crease_context *context, const crease_surface *surface,
    int direction, double t, int times, crease_surface **out)
{
    *out = NULL;
    if (direction != 0 && direction != 1)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "knot insertion: direction %d; give 0 (u) or 1 (v)", direction);
    if (!inside(surface, direction, t, true))
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "knot insertion: %g is outside the domain; give a parameter within it", t);
    const int most = surface->order[direction] - crease_surface_multiplicity(surface, direction, t);
    if (times < 0 || times > most)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "knot insertion: %d times at %g; the order leaves room for %d", times, t, most);
    return insert(context, surface, direction, t, (size_t)times, out);
}

/* Every control point of `to` as the weighted sum of `order` ones of `from`. */
static void combine(const crease_rows *from, const crease_rows *to, size_t order,
    const size_t *first, const double *weights)
{
    for (size_t i = 0; i < to->outer * to->pitch; i++) {
        const size_t outer = i / to->pitch;
        const size_t row = i % to->pitch;
        const double *const source =
            from->values + (outer * from->pitch + first[row]) * from->inner;
        for (size_t r = 0; r < order; r++)
            for (size_t c = 0; c < to->inner; c++)
                to->values[i * to->inner + c] +=
                    weights[row * order + r] * source[r * from->inner + c];
    }
}

crease_status crease_surface_refine(crease_context *context, const crease_surface *surface,
    int direction, const double *knots, size_t count, crease_surface **out)
{
    *out = NULL;
    const int other = 1 - direction;
    const size_t order = (size_t)surface->order[direction];
    size_t counts[2] = {surface->count[0], surface->count[1]};
    counts[direction] = count;
    crease_surface *fine = allocate(context, surface->order, counts);
    size_t *first = crease_allocate(context, count, sizeof *first);
    double *weights = crease_allocate(context, count * order, sizeof *weights);
    if (fine && first && weights) {
        memcpy(fine->knots[direction], knots, (count + order) * sizeof(double));
        memcpy(fine->knots[other], surface->knots[other],
            (counts[other] + (size_t)surface->order[other]) * sizeof(double));
        crease_knots_prolong(surface->order[direction], surface->knots[direction],
            surface->count[direction], knots, count, first, weights);
        const crease_rows from = rows_along(surface, direction);
        const crease_rows to = rows_along(fine, direction);
        combine(&from, &to, order, first, weights);
        *out = fine;
    } else {
        crease_surface_free(fine);
    }
    free(first);
    free(weights);
    return *out ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
}

/* The surface with t often enough among the knots that the row there is a border of both sides. */
static crease_status sharpen(crease_context *context, const crease_surface *surface, int direction,
    double t, crease_surface **out)
{
    const int present = crease_surface_multiplicity(surface, direction, t);
    const int wanted = surface->order[direction] > 1 ? surface->order[direction] - 1 : 1;
    return insert(
        context, surface, direction, t, present < wanted ? (size_t)(wanted - present) : 0, out);
}

/* One past the last control point of what lies below t, for a surface sharpened there: the last one
 * is that whose order - 1 inner knots are the first ones equal to t. */
static size_t end_below(const crease_surface *surface, int direction, double t)
{
    size_t i = 0;
    while (surface->knots[direction][i] < t)
        i++;
    return i;
}

/* The first control point of what lies above t: its inner knots are the last ones equal to t. */
static size_t begin_above(const crease_surface *surface, int direction, double t)
{
    return end_below(surface, direction, t) +
        (size_t)crease_surface_multiplicity(surface, direction, t) -
        (size_t)surface->order[direction];
}

/* Control points begin..end - 1 along a direction with the knots that go with them, the outermost
 * ones moved onto their neighbours so that the piece is clamped. */
static crease_status cut(crease_context *context, const crease_surface *surface, int direction,
    size_t begin, size_t end, crease_surface **out)
{
    size_t counts[2] = {surface->count[0], surface->count[1]};
    counts[direction] = end - begin;
    crease_surface *piece = allocate(context, surface->order, counts);
    if (!piece)
        return CREASE_ERROR_NO_MEMORY;
    const int other = 1 - direction;
    const size_t total = counts[direction] + (size_t)surface->order[direction];
    double *const knots = piece->knots[direction];
    memcpy(knots, surface->knots[direction] + begin, total * sizeof(double));
    if (surface->order[direction] > 1) {
        knots[0] = knots[1];
        knots[total - 1] = knots[total - 2];
    }
    memcpy(piece->knots[other], surface->knots[other],
        (counts[other] + (size_t)surface->order[other]) * sizeof(double));
    const crease_rows from = rows_along(surface, direction);
    const crease_rows to = rows_along(piece, direction);
    for (size_t outer = 0; outer < to.outer; outer++)
        memcpy(to.values + outer * to.pitch * to.inner,
            from.values + (outer * from.pitch + begin) * from.inner,
            to.pitch * to.inner * sizeof(double));
    *out = piece;
    return CREASE_OK;
}

static crease_status clamp_direction(
    crease_context *context, const crease_surface *surface, int direction, crease_surface **out)
{
    double domain[2];
    crease_surface_domain(surface, direction, domain);
    crease_surface *below = NULL;
    crease_surface *both = NULL;
    crease_status status = sharpen(context, surface, direction, domain[0], &below);
    if (status == CREASE_OK)
        status = sharpen(context, below, direction, domain[1], &both);
    if (status == CREASE_OK)
        status = cut(context, both, direction, begin_above(both, direction, domain[0]),
            end_below(both, direction, domain[1]), out);
    crease_surface_free(below);
    crease_surface_free(both);
    return status;
}

crease_status crease_surface_clamp(
    crease_context *context, const crease_surface *surface, crease_surface **out)
{
    *out = NULL;
    crease_surface *half = NULL;
    crease_status status = clamp_direction(context, surface, 0, &half);
    if (status == CREASE_OK)
        status = clamp_direction(context, half, 1, out);
    crease_surface_free(half);
    return status;
}

crease_status crease_surface_split(crease_context *context, const crease_surface *surface,
    int direction, double t, crease_surface **lower, crease_surface **upper)
{
    *lower = *upper = NULL;
    if (direction != 0 && direction != 1)
        return crease_fail(
            context, CREASE_ERROR_ARGUMENT, "split: direction %d; give 0 (u) or 1 (v)", direction);
    if (!inside(surface, direction, t, false))
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "split: %g is not inside the domain; give a parameter between its borders", t);
    crease_surface *clamped = NULL;
    crease_surface *sharp = NULL;
    crease_status status = crease_surface_clamp(context, surface, &clamped);
    if (status == CREASE_OK)
        status = sharpen(context, clamped, direction, t, &sharp);
    if (status == CREASE_OK)
        status = cut(context, sharp, direction, 0, end_below(sharp, direction, t), lower);
    if (status == CREASE_OK)
        status = cut(context, sharp, direction, begin_above(sharp, direction, t),
            sharp->count[direction], upper);
    if (status != CREASE_OK) {
        crease_surface_free(*lower);
        *lower = NULL;
    }
    crease_surface_free(clamped);
    crease_surface_free(sharp);
    return status;
}

crease_status crease_surface_transpose(
    crease_context *context, const crease_surface *surface, crease_surface **out)
{
    *out = NULL;
    const int order[2] = {surface->order[1], surface->order[0]};
    const size_t count[2] = {surface->count[1], surface->count[0]};
    crease_surface *turned = allocate(context, order, count);
    if (!turned)
        return CREASE_ERROR_NO_MEMORY;
    for (int d = 0; d < 2; d++)
        memcpy(turned->knots[d], surface->knots[1 - d],
            (count[d] + (size_t)order[d]) * sizeof(double));
    for (size_t i = 0; i < count[0]; i++)
        for (size_t j = 0; j < count[1]; j++)
            memcpy(turned->control_points + 3 * (i * count[1] + j),
                surface->control_points + 3 * (j * count[0] + i), 3 * sizeof(double));
    *out = turned;
    return CREASE_OK;
}

crease_status crease_surface_isocurve(crease_context *context, const crease_surface *surface,
    int direction, double t, crease_side side, crease_curve **out)
{
    *out = NULL;
    const int order = surface->order[direction];
    const double *const knots = surface->knots[direction];
    double weights[CREASE_ORDER_MAX];
    t = crease_basis_clamp(knots, order, surface->count[direction], t);
    const size_t span = crease_basis_span(knots, order, surface->count[direction], t, side);
    crease_basis_values(knots, order, span, t, weights);
    const int other = 1 - direction;
    const size_t count = surface->count[other];
    double *points = crease_allocate(context, count, 3 * sizeof *points);
    if (!points)
        return CREASE_ERROR_NO_MEMORY;
    const size_t step = direction == 0 ? 3 * surface->count[1] : 3;
    const size_t along = direction == 0 ? 3 : 3 * surface->count[1];
    const double *const from = surface->control_points + (span + 1 - (size_t)order) * step;
    for (size_t j = 0; j < count; j++)
        for (size_t r = 0; r < (size_t)order; r++)
            for (size_t c = 0; c < 3; c++)
                points[3 * j + c] += weights[r] * from[j * along + r * step + c];
    const crease_status status = crease_curve_create(
        context, surface->order[other], count, surface->knots[other], points, out);
    free(points);
    return status;
}
