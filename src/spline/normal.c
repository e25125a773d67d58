/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The unit normal of a surface, also where a partial derivative vanishes: rows of control points
 * that repeat (the paper's creases) make the derivative across them zero, and at a pole the
 * derivative along the collapsed border is zero. There the normal is the limit from inside the side
 * asked for: the first non-vanishing term of the power series of S_u x S_v along the diagonal. */
#include "base/vector.h"
#include "spline/basis.h"
#include "spline/surface.h"

#include <math.h>

enum { WIDTH = CREASE_ORDER_MAX + 1, MOST_TERMS = 2 * CREASE_ORDER_MAX };

/* Adds a x b. */
static void add_cross(const double a[3], const double b[3], double out[3])
{
    for (int c = 0; c < 3; c++) {
        const int d = (c + 1) % 3;
        const int e = (c + 2) % 3;
        out[c] += a[d] * b[e] - a[e] * b[d];
    }
}

/* Longest step between neighbouring control points of the span, along either direction: bounds the
 * derivatives, so that "vanishes" has a measure. */
static void measure_steps(const crease_surface *surface, const size_t span[2], double longest[2])
{
    const size_t n = surface->count[1];
    longest[0] = longest[1] = 0.0;
    for (size_t i = span[0] + 1 - (size_t)surface->order[0]; i <= span[0]; i++)
        for (size_t j = span[1] + 1 - (size_t)surface->order[1]; j <= span[1]; j++) {
            const double *const at = surface->control_points + 3 * (i * n + j);
            for (int d = 0; d < 2; d++) {
                if ((d == 0 ? i : j) == span[d])
                    continue;
                const double *const next = at + 3 * (d == 0 ? n : 1);
                const double step[3] = {next[0] - at[0], next[1] - at[1], next[2] - at[2]};
                longest[d] = fmax(longest[d], crease_vector_length(step));
            }
        }
}

/* Coefficient number n of the power series, in h, of the derivative in direction d at the place
 * reached by the steps h * way: sum over a + b = n of way^a way^b / (a! b!) of the mixed
 * derivatives. */
static void series_term(
    double (*const derivatives)[WIDTH][3], const double way[2], int d, int n, double out[3])
{
    out[0] = out[1] = out[2] = 0.0;
    double share = 1.0;
    for (int i = 1; i <= n; i++)
        share *= way[1] / i;
    for (int a = 0; a <= n; a++) {
        const int in_u = a + (d == 0);
        const int in_v = n - a + (d == 1);
        if (in_u < WIDTH && in_v < WIDTH)
            for (int c = 0; c < 3; c++)
                out[c] += share * derivatives[in_u][in_v][c];
        share *= way[0] / way[1] * (n - a) / (a + 1);
    }
}

/* The first term of the series of S_u x S_v that is longer than `least`; zeros when there is none.
 */
static void limit_normal(double (*const derivatives)[WIDTH][3], const double way[2], int terms,
    double least, double normal[3])
{
    double along[2][MOST_TERMS][3];
    for (int n = 0; n < terms; n++) {
        series_term(derivatives, way, 0, n, along[0][n]);
        series_term(derivatives, way, 1, n, along[1][n]);
        normal[0] = normal[1] = normal[2] = 0.0;
        for (int a = 0; a <= n; a++)
            add_cross(along[0][a], along[1][n - a], normal);
        if (crease_vector_length(normal) > least)
            return;
    }
    normal[0] = normal[1] = normal[2] = 0.0;
}

/* All derivatives at a place, each knot span taken as the unit of its direction. The net is moved
 * to the first control point of the span, so that equal control points cancel exactly. */
static void scaled_derivatives(const crease_surface *surface, const size_t span[2],
    const double uv[2], double (*const out)[WIDTH][3])
{
    double basis[2][WIDTH * CREASE_ORDER_MAX];
    const size_t order[2] = {(size_t)surface->order[0], (size_t)surface->order[1]};
    for (int d = 0; d < 2; d++) {
        const double *const knots = surface->knots[d];
        const double unit = knots[span[d] + 1] - knots[span[d]];
        double power = 1.0;
        crease_basis_derivatives(
            knots, surface->order[d], span[d], uv[d], surface->order[d], basis[d]);
        for (size_t a = 0; a <= order[d]; a++, power *= unit)
            for (size_t i = 0; i < order[d]; i++)
                basis[d][a * order[d] + i] *= power;
    }
    const double *const origin = surface->control_points +
        3 * ((span[0] + 1 - order[0]) * surface->count[1] + span[1] + 1 - order[1]);
    for (size_t i = 0; i < order[0] * order[1]; i++) {
        const size_t row = i / order[1];
        const size_t column = i % order[1];
        const double *const point = origin + 3 * (row * surface->count[1] + column);
        for (size_t a = 0; a <= order[0]; a++)
            for (size_t b = 0; b <= order[1]; b++)
                for (int c = 0; c < 3; c++)
                    out[a][b][c] += basis[0][a * order[0] + row] * basis[1][b * order[1] + column] *
                        (point[c] - origin[c]);
    }
}

void crease_surface_normal(
    const crease_surface *surface, const double uv[2], const crease_side sides[2], double normal[3])
{
    size_t span[2];
    double at[2], longest[2], way[2], first[2][2][3];
    for (int d = 0; d < 2; d++) {
        const double *const knots = surface->knots[d];
        const int order = surface->order[d];
        at[d] = crease_basis_clamp(knots, order, surface->count[d], uv[d]);
        span[d] = crease_basis_span(knots, order, surface->count[d], at[d], sides[d]);
        way[d] = knots[span[d] + 1] - at[d] >= at[d] - knots[span[d]] ? 1.0 : -1.0;
    }
    measure_steps(surface, span, longest);
    crease_surface_evaluate(surface, at, sides, 1, &first[0][0][0]);
    normal[0] = normal[1] = normal[2] = 0.0;
    add_cross(first[1][0], first[0][1], normal);
    const double scale = longest[0] * longest[1];
    const double area = (surface->knots[0][span[0] + 1] - surface->knots[0][span[0]]) *
        (surface->knots[1][span[1] + 1] - surface->knots[1][span[1]]);
    if (crease_vector_length(normal) * area <= 1e-4 * scale) {
        double derivatives[WIDTH][WIDTH][3] = {{{0}}};
        scaled_derivatives(surface, span, at, derivatives);
        limit_normal(
            derivatives, way, surface->order[0] + surface->order[1] - 1, 1e-11 * scale, normal);
    }
    crease_vector_normalise(normal);
}
