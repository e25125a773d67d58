/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "net/height.h"

#include "base/memory.h"
#include "base/simd.h"
#include "spline/basis.h"
#include "spline/knots.h"

#include <stdlib.h>
#include <string.h>

enum { CUBIC = 4 };

crease_status crease_height_create(
    crease_context *context, const crease_layout *layout, crease_height *out)
{
    *out = (crease_height){.order = layout->order};
    for (int d = 0; d < 2; d++) {
        out->count[d] = crease_layout_count(layout, d);
        out->knots[d] =
            crease_allocate(context, out->count[d] + (size_t)layout->order, sizeof(double));
        if (out->knots[d])
            crease_layout_knots(layout, d, out->knots[d]);
    }
    out->coefficients = crease_allocate(context, out->count[0] * out->count[1], sizeof(double));
    if (out->knots[0] && out->knots[1] && out->coefficients)
        return CREASE_OK;
    crease_height_free(out);
    return CREASE_ERROR_NO_MEMORY;
}

void crease_height_free(crease_height *height)
{
    free(height->knots[0]);
    free(height->knots[1]);
    free(height->coefficients);
    *height = (crease_height){0};
}

void crease_height_support(const crease_height *height, const double uv[2],
    const crease_side sides[2], int derivatives, crease_support *out)
{
    const int order = height->order;
    for (int d = 0; d < 2; d++) {
        const double *const knots = height->knots[d];
        const double t = crease_basis_clamp(knots, order, height->count[d], uv[d]);
        const size_t span = crease_basis_span(knots, order, height->count[d], t, sides[d]);
        out->first[d] = span + 1 - (size_t)order;
        if (derivatives) {
            double both[2 * CREASE_HEIGHT_ORDER_MAX];
            crease_basis_derivatives(knots, order, span, t, 1, both);
            for (int i = 0; i < order; i++) {
                out->values[d][i] = both[i];
                out->slopes[d][i] = both[order + i];
            }
        } else {
            crease_basis_values(knots, order, span, t, out->values[d]);
        }
    }
}

/* Value, and with derivatives the slopes, of a net of this order. */
CREASE_INLINE void combine(const crease_height *height, const crease_support *s, size_t order,
    bool derivatives, double out[3])
{
    out[0] = 0.0;
    for (size_t d = 1; d < 3 && derivatives; d++)
        out[d] = 0.0;
    for (size_t i = 0; i < order; i++) {
        const double *const c =
            height->coefficients + (s->first[0] + i) * height->count[1] + s->first[1];
        double row = 0.0, slope = 0.0;
        for (size_t j = 0; j < order; j++)
            row += s->values[1][j] * c[j];
        for (size_t j = 0; j < order && derivatives; j++)
            slope += s->slopes[1][j] * c[j];
        out[0] += s->values[0][i] * row;
        if (derivatives) {
            out[1] += s->slopes[0][i] * row;
            out[2] += s->values[0][i] * slope;
        }
    }
}

void crease_height_at(const crease_height *height, const double uv[2], const crease_side sides[2],
    int derivatives, double out[3])
{
    crease_support s;
    crease_height_support(height, uv, sides, derivatives, &s);
    if (height->order != CUBIC)
        combine(height, &s, (size_t)height->order, derivatives, out);
    else if (derivatives)
        combine(height, &s, CUBIC, true, out);
    else
        combine(height, &s, CUBIC, false, out);
}

crease_status crease_height_surface(crease_context *context, const crease_height *height,
    const crease_frame *frame, crease_surface **out)
{
    const size_t rows = height->count[0], columns = height->count[1];
    double *points = crease_allocate(context, rows * columns, 3 * sizeof *points);
    double *places = crease_allocate(context, rows + columns, sizeof *places);
    crease_status status = points && places ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK) {
        crease_knots_greville(height->knots[0], height->order, rows, places);
        crease_knots_greville(height->knots[1], height->order, columns, places + rows);
        for (size_t i = 0; i < rows * columns; i++) {
            points[3 * i] = places[i / columns];
            points[3 * i + 1] = places[rows + i % columns];
            points[3 * i + 2] = height->coefficients[i];
        }
        crease_frame_leave(frame, points, rows * columns, points);
        const crease_surface_parts parts = {.order = {height->order, height->order},
            .count = {rows, columns},
            .knots = {height->knots[0], height->knots[1]},
            .control_points = points};
        status = crease_surface_create(context, &parts, out);
    }
    free(points);
    free(places);
    return status;
}

/* Where control point i of a direction stands, see crease_knots_greville(). */
static double place_of(const crease_height *height, int direction, size_t i)
{
    const size_t degree = (size_t)height->order - 1;
    double sum = 0.0;
    for (size_t k = 1; k <= degree; k++)
        sum += height->knots[direction][i + k];
    return sum / (double)degree;
}

/* How far t is from the domain. */
static double beyond(const crease_height *height, int direction, double t)
{
    return t -
        crease_basis_clamp(height->knots[direction], height->order, height->count[direction], t);
}

void crease_height_resemble(const crease_height *other, crease_height *height)
{
    const crease_side sides[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
    for (size_t i = 0, k = 0; i < height->count[0]; i++)
        for (size_t j = 0; j < height->count[1]; j++, k++) {
            const double uv[2] = {place_of(height, 0, i), place_of(height, 1, j)};
            double f[3];
            crease_height_at(other, uv, sides, 1, f);
            height->coefficients[k] =
                f[0] + f[1] * beyond(other, 0, uv[0]) + f[2] * beyond(other, 1, uv[1]);
        }
}
