/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Based on: Filip, Magedson, Markot. Surface algorithms using bounds on derivatives. 1986: a
 * triangle over a cell a x b of parameters deviates from the surface by at most
 * (a^2 |S_uu| + 2 a b |S_uv| + b^2 |S_vv|) / 8. The middle term is no more than the sum of a^2
 * |S_uv| and b^2 |S_uv|, so either direction gets half of the tolerance. */
#include "mesh/grid.h"

#include "base/memory.h"
#include "base/vector.h"
#include "spline/bezier.h"
#include "spline/surface.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double MOST_LINES = 1e6;

static double difference(const double *a, const double *b, const double *c, const double *d)
{
    double squared = 0.0;
    for (int k = 0; k < 3; k++) {
        const double x = (a[k] - b[k]) - (c[k] - d[k]);
        squared += x * x;
    }
    return sqrt(squared);
}

/* Bounds of |S_uu|, |S_uv|, |S_vv| of a Bezier patch over the unit square. */
static void bound_derivatives(const int order[2], const double *points, double bounds[3])
{
    const int m = order[0];
    const int n = order[1];
    bounds[0] = bounds[1] = bounds[2] = 0.0;
    for (int i = 0; i < m; i++)
        for (int j = 0; j < n; j++) {
            const double *const p = points + 3 * (i * n + j);
            const double *const u = p + 3 * n;
            const double *const v = p + 3;
            if (i + 2 < m)
                bounds[0] = fmax(bounds[0], difference(u + 3 * n, u, u, p));
            if (i + 1 < m && j + 1 < n)
                bounds[1] = fmax(bounds[1], difference(u + 3, u, v, p));
            if (j + 2 < n)
                bounds[2] = fmax(bounds[2], difference(v + 3, v, v, p));
        }
    bounds[0] *= (m - 1) * (m - 2);
    bounds[1] *= (m - 1) * (n - 1);
    bounds[2] *= (n - 1) * (n - 2);
}

static void divide_for(double bound, double tolerance, double *divisions)
{
    if (bound > 0.0)
        *divisions = fmax(*divisions, ceil(sqrt(bound / (4.0 * tolerance))));
}

static crease_status divide(crease_context *context, crease_grid *grid, double tolerance)
{
    const crease_surface_parts parts = crease_surface_parts_of(grid->surface);
    crease_bezier bezier;
    const crease_status status = crease_bezier_prepare(context, &parts, &bezier);
    if (status != CREASE_OK)
        return status;
    for (size_t i = 0; i < bezier.span_count[0]; i++)
        for (size_t j = 0; j < bezier.span_count[1]; j++) {
            double points[3 * CREASE_ORDER_MAX * CREASE_ORDER_MAX], bounds[3];
            const size_t patch[2] = {i, j};
            crease_bezier_patch(&bezier, patch, parts.control_points, points);
            bound_derivatives(parts.order, points, bounds);
            divide_for(bounds[0] + bounds[1], tolerance, &grid->axes[0].divisions[i]);
            divide_for(bounds[2] + bounds[1], tolerance, &grid->axes[1].divisions[j]);
        }
    crease_bezier_release(&bezier);
    return CREASE_OK;
}

/* Whether the normals on either side of a break differ by more than a degree anywhere. */
static bool normals_jump(const crease_grid *grid, int direction, double t)
{
    static const double COSINE = 0.99985;
    const crease_axis *const along = &grid->axes[1 - direction];
    for (size_t i = 0; i < 2 * along->span_count; i++) {
        const double *const ends = along->breaks + i / 2;
        double uv[2], normals[2][3];
        uv[direction] = t;
        uv[1 - direction] = i % 2 ? 0.5 * (ends[0] + ends[1]) : 0.75 * ends[0] + 0.25 * ends[1];
        for (int side = 0; side < 2; side++) {
            crease_side sides[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
            sides[direction] = side ? CREASE_SIDE_LEFT : CREASE_SIDE_RIGHT;
            crease_surface_normal(grid->surface, uv, sides, normals[side]);
        }
        if (crease_vector_dot(normals[0], normals[1]) < COSINE)
            return true;
    }
    return false;
}

/* A crease needs a knot of multiplicity order - 1, or a derivative that vanishes because control
 * points repeat; this sorts out the breaks that have neither. */
static bool may_be_sharp(const crease_surface *surface, int direction, double t, double span)
{
    const int order = surface->order[direction];
    if (crease_surface_multiplicity(surface, direction, t) >= order - 1)
        return true;
    double across[2], uv[2], out[12];
    crease_surface_domain(surface, 1 - direction, across);
    uv[direction] = t;
    uv[1 - direction] = 0.4 * across[0] + 0.6 * across[1];
    const crease_side sides[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
    crease_surface_evaluate(surface, uv, sides, 1, out);
    const double *const here = out + (direction == 0 ? 6 : 3);
    uv[direction] = t + 0.5 * span;
    double inside[12];
    crease_surface_evaluate(surface, uv, sides, 1, inside);
    const double *const there = inside + (direction == 0 ? 6 : 3);
    return hypot(hypot(here[0], here[1]), here[2]) <=
        1e-6 * hypot(hypot(there[0], there[1]), there[2]);
}

static crease_status make_axis(crease_context *context, crease_grid *grid, int direction)
{
    crease_axis *const axis = &grid->axes[direction];
    const size_t most = grid->surface->count[direction] + 1;
    axis->breaks = crease_allocate(context, most, sizeof *axis->breaks);
    axis->divisions = crease_allocate(context, most, sizeof *axis->divisions);
    axis->sharp = crease_allocate(context, most, sizeof *axis->sharp);
    if (!axis->breaks || !axis->divisions || !axis->sharp)
        return CREASE_ERROR_NO_MEMORY;
    axis->span_count = crease_surface_breaks(grid->surface, direction, axis->breaks) - 1;
    for (size_t i = 0; i < axis->span_count; i++)
        axis->divisions[i] = 1.0;
    return CREASE_OK;
}

static void find_creases(crease_grid *grid, int direction)
{
    crease_axis *const axis = &grid->axes[direction];
    for (size_t i = 1; i < axis->span_count; i++) {
        const double t = axis->breaks[i];
        axis->sharp[i] = may_be_sharp(grid->surface, direction, t, axis->breaks[i + 1] - t) &&
            normals_jump(grid, direction, t);
    }
}

crease_status crease_grid_prepare(
    crease_context *context, const crease_surface *surface, double tolerance, crease_grid *out)
{
    *out = (crease_grid){.surface = NULL};
    crease_status status = crease_surface_clamp(context, surface, &out->surface);
    if (status == CREASE_OK)
        status = make_axis(context, out, 0);
    if (status == CREASE_OK)
        status = make_axis(context, out, 1);
    if (status == CREASE_OK)
        status = divide(context, out, tolerance);
    if (status != CREASE_OK)
        return status;
    find_creases(out, 0);
    find_creases(out, 1);
    return CREASE_OK;
}

static crease_status draw_axis(crease_context *context, crease_axis *axis)
{
    double lines = 1.0;
    for (size_t i = 0; i < axis->span_count; i++)
        lines += axis->divisions[i] + (axis->sharp[i] ? 1.0 : 0.0);
    if (!(lines <= MOST_LINES))
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "mesh: the tolerance asks for too many triangles; give a larger one");
    axis->lines = crease_allocate(context, (size_t)lines, sizeof *axis->lines);
    if (!axis->lines)
        return CREASE_ERROR_NO_MEMORY;
    crease_grid_line *line = axis->lines;
    *line++ = (crease_grid_line){axis->breaks[0], CREASE_SIDE_RIGHT, 0};
    size_t place = 0;
    for (size_t i = 0; i < axis->span_count; i++) {
        const double *const ends = axis->breaks + i;
        for (double k = 1.0; k < axis->divisions[i]; k += 1.0) {
            const double t = ends[0] + (ends[1] - ends[0]) * (k / axis->divisions[i]);
            *line++ = (crease_grid_line){t, CREASE_SIDE_RIGHT, ++place};
        }
        const bool last = i + 1 == axis->span_count;
        const bool doubled = !last && axis->sharp[i + 1];
        const crease_side side = last || doubled ? CREASE_SIDE_LEFT : CREASE_SIDE_RIGHT;
        *line++ = (crease_grid_line){ends[1], side, ++place};
        if (doubled)
            *line++ = (crease_grid_line){ends[1], CREASE_SIDE_RIGHT, place};
    }
    axis->line_count = (size_t)(line - axis->lines);
    axis->place_count = place + 1;
    return CREASE_OK;
}

crease_status crease_grid_draw(crease_context *context, crease_grid *grid)
{
    const crease_status status = draw_axis(context, &grid->axes[0]);
    return status == CREASE_OK ? draw_axis(context, &grid->axes[1]) : status;
}

void crease_grid_release(crease_grid *grid)
{
    crease_surface_free(grid->surface);
    for (int d = 0; d < 2; d++) {
        free(grid->axes[d].breaks);
        free(grid->axes[d].divisions);
        free(grid->axes[d].sharp);
        free(grid->axes[d].lines);
    }
}
