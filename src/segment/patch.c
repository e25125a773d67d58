/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "segment/patch.h"

#include <math.h>

static double clamp(double value, double low, double high)
{
    return value < low ? low : value > high ? high : value;
}

/* x^i y^j for i + j = 0, 1, ... degree, in units of half the longer side: within -1..1 or so. */
static void polynomial_basis(const crease_patch *patch, double x, double y, crease_basis_at *out)
{
    double px[CREASE_PATCH_DEGREE + 1] = {1.0}, py[CREASE_PATCH_DEGREE + 1] = {1.0};
    const double unit = patch->unit[0];
    for (int i = 1; i <= patch->degree; i++) {
        px[i] = px[i - 1] * x / unit;
        py[i] = py[i - 1] * y / unit;
    }
    int n = 0;
    for (int total = 0; total <= patch->degree; total++)
        for (int j = 0; j <= total; j++, n++) {
            const int i = total - j;
            out->index[n] = (size_t)n;
            out->value[n] = px[i] * py[j];
            out->dx[n] = i ? i * px[i - 1] * py[j] / unit : 0.0;
            out->dy[n] = j ? j * px[i] * py[j - 1] / unit : 0.0;
        }
    out->count = n;
}

/* The four uniform cubic B-splines of a span at t = 0..1, and their derivatives. */
static void cubic(double t, double value[4], double slope[4])
{
    const double u = 1.0 - t;
    value[0] = u * u * u / 6.0;
    value[1] = (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0;
    value[2] = (3.0 * u * u * u - 6.0 * u * u + 4.0) / 6.0;
    value[3] = t * t * t / 6.0;
    slope[0] = -0.5 * u * u;
    slope[1] = 0.5 * (3.0 * t * t - 4.0 * t);
    slope[2] = -0.5 * (3.0 * u * u - 4.0 * u);
    slope[3] = 0.5 * t * t;
}

size_t crease_patch_side(const crease_patch *patch)
{
    return (size_t)patch->spans + 3;
}

static void spline_basis(const crease_patch *patch, double x, double y, crease_basis_at *out)
{
    double vx[4], sx[4], vy[4], sy[4];
    const double u = (x - patch->low[0]) / patch->unit[0];
    const double v = (y - patch->low[1]) / patch->unit[1];
    const double i = clamp(floor(u), 0.0, patch->spans - 1);
    const double j = clamp(floor(v), 0.0, patch->spans - 1);
    cubic(u - i, vx, sx);
    cubic(v - j, vy, sy);
    out->count = 0;
    for (size_t a = 0; a < 4; a++)
        for (size_t b = 0; b < 4; b++) {
            const int n = out->count++;
            const size_t row = (size_t)i + a, rows = (size_t)patch->spans;
            out->index[n] =
                (patch->round ? row % rows : row) * crease_patch_side(patch) + (size_t)j + b;
            out->value[n] = vx[a] * vy[b];
            out->dx[n] = sx[a] * vy[b] / patch->unit[0];
            out->dy[n] = vx[a] * sy[b] / patch->unit[1];
        }
}

void crease_patch_basis(const crease_patch *patch, double x, double y, crease_basis_at *out)
{
    if (patch->spline)
        spline_basis(patch, x, y, out);
    else
        polynomial_basis(patch, x, y, out);
}

double crease_patch_at(const crease_patch *patch, double x, double y, double slope[2])
{
    if (patch->round)
        x -= patch->high[0] * floor(x / patch->high[0]);
    const double inside[2] = {
        clamp(x, patch->low[0], patch->high[0]), clamp(y, patch->low[1], patch->high[1])};
    crease_basis_at basis;
    crease_patch_basis(patch, inside[0], inside[1], &basis);
    double value = 0.0;
    slope[0] = slope[1] = 0.0;
    for (int n = 0; n < basis.count; n++) {
        const double coefficient = patch->coefficients[basis.index[n]];
        value += coefficient * basis.value[n];
        slope[0] += coefficient * basis.dx[n];
        slope[1] += coefficient * basis.dy[n];
    }
    return value + slope[0] * (x - inside[0]) + slope[1] * (y - inside[1]);
}
