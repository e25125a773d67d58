/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "spline/surface.h"

#include "base/memory.h"
#include "spline/basis.h"
#include "spline/knots.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static crease_status check_parts(crease_context *context, const crease_surface_parts *parts)
{
    static const char *const names[2] = {"surface, u", "surface, v"};
    for (int d = 0; d < 2; d++) {
        const crease_status status = crease_knots_check(
            context, names[d], parts->order[d], parts->count[d], parts->knots[d]);
        if (status != CREASE_OK)
            return status;
    }
    size_t total = 0;
    if (__builtin_mul_overflow(parts->count[0], parts->count[1], &total) || total > SIZE_MAX / 64)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "surface: %zu x %zu control points are too many", parts->count[0], parts->count[1]);
    if (!parts->control_points)
        return crease_fail(context, CREASE_ERROR_ARGUMENT, "surface: no control points were given");
    for (size_t i = 0; i < 3 * total; i++)
        if (!isfinite(parts->control_points[i]))
            return crease_fail(context, CREASE_ERROR_ARGUMENT,
                "surface: control point %zu, %zu is not finite", i / 3 / parts->count[1],
                i / 3 % parts->count[1]);
    return CREASE_OK;
}

crease_status crease_surface_create(
    crease_context *context, const crease_surface_parts *parts, crease_surface **out)
{
    *out = NULL;
    const crease_status status = check_parts(context, parts);
    if (status != CREASE_OK)
        return status;
    crease_surface *surface = crease_allocate(context, 1, sizeof *surface);
    if (!surface)
        return CREASE_ERROR_NO_MEMORY;
    for (int d = 0; d < 2; d++) {
        surface->order[d] = parts->order[d];
        surface->count[d] = parts->count[d];
        surface->knots[d] = crease_duplicate(
            context, parts->knots[d], parts->count[d] + (size_t)parts->order[d], sizeof(double));
    }
    surface->control_points = crease_duplicate(
        context, parts->control_points, parts->count[0] * parts->count[1], 3 * sizeof(double));
    if (!surface->knots[0] || !surface->knots[1] || !surface->control_points) {
        crease_surface_free(surface);
        return CREASE_ERROR_NO_MEMORY;
    }
    *out = surface;
    return CREASE_OK;
}

void crease_surface_free(crease_surface *surface)
{
    if (!surface)
        return;
    free(surface->knots[0]);
    free(surface->knots[1]);
    free(surface->control_points);
    free(surface);
}

void crease_surfaces_free(crease_surface **surfaces, size_t count)
{
    if (!surfaces)
        return;
    for (size_t i = 0; i < count; i++)
        crease_surface_free(surfaces[i]);
    free(surfaces);
}

crease_surface_parts crease_surface_parts_of(const crease_surface *surface)
{
    return (crease_surface_parts){.order = {surface->order[0], surface->order[1]},
        .count = {surface->count[0], surface->count[1]},
        .knots = {surface->knots[0], surface->knots[1]},
        .control_points = surface->control_points};
}

void crease_surface_domain(const crease_surface *surface, int direction, double domain[2])
{
    domain[0] = surface->knots[direction][surface->order[direction] - 1];
    domain[1] = surface->knots[direction][surface->count[direction]];
}

size_t crease_surface_breaks(const crease_surface *surface, int direction, double *out)
{
    const double *const knots = surface->knots[direction];
    size_t breaks = 0;
    for (size_t i = (size_t)surface->order[direction] - 1; i <= surface->count[direction]; i++)
        if (!breaks || knots[i] > out[breaks - 1])
            out[breaks++] = knots[i];
    return breaks;
}

int crease_surface_multiplicity(const crease_surface *surface, int direction, double t)
{
    return crease_knots_multiplicity(surface->knots[direction],
        surface->count[direction] + (size_t)surface->order[direction], t);
}

void crease_surface_evaluate(const crease_surface *surface, const double uv[2],
    const crease_side sides[2], int derivatives, double *out)
{
    double basis[2][CREASE_ORDER_MAX * CREASE_ORDER_MAX];
    size_t first[2];
    int most[2];
    for (int d = 0; d < 2; d++) {
        const int order = surface->order[d];
        const double *const knots = surface->knots[d];
        const double t = crease_basis_clamp(knots, order, surface->count[d], uv[d]);
        const size_t span = crease_basis_span(knots, order, surface->count[d], t, sides[d]);
        most[d] = derivatives < order ? derivatives : order - 1;
        crease_basis_derivatives(knots, order, span, t, most[d], basis[d]);
        first[d] = span + 1 - (size_t)order;
    }
    const size_t width = (size_t)derivatives + 1;
    memset(out, 0, width * width * 3 * sizeof *out);
    for (int i = 0; i < surface->order[0]; i++) {
        const double *const row =
            surface->control_points + 3 * ((first[0] + (size_t)i) * surface->count[1] + first[1]);
        for (int b = 0; b <= most[1]; b++) {
            double sum[3] = {0};
            for (int j = 0; j < surface->order[1]; j++)
                for (int c = 0; c < 3; c++)
                    sum[c] += basis[1][b * surface->order[1] + j] * row[3 * j + c];
            for (int a = 0; a <= most[0]; a++)
                for (int c = 0; c < 3; c++)
                    out[3 * ((size_t)a * width + (size_t)b) + (size_t)c] +=
                        basis[0][a * surface->order[0] + i] * sum[c];
        }
    }
}

void crease_surface_point(const crease_surface *surface, const double uv[2], double point[3])
{
    const crease_side sides[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
    crease_surface_evaluate(surface, uv, sides, 0, point);
}
