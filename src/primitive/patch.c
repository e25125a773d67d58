/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "primitive/patch.h"

#include <math.h>

size_t crease_patch_side(const crease_patch *patch)
{
    return (size_t)patch->spans + 3;
}

static double clamp(double value, double low, double high)
{
    return value < low ? low : value > high ? high : value;
}

/* Powers of the coordinates in units of half the longer side: within -1..1 or so. */
static void powers(const crease_patch *patch, double at, double out[CREASE_PATCH_DEGREE + 1])
{
    out[0] = 1.0;
    for (int i = 1; i <= patch->degree; i++)
        out[i] = out[i - 1] * at / patch->unit[0];
}

void crease_patch_terms(
    const crease_patch *patch, double x, double y, double out[CREASE_PATCH_TERMS])
{
    double px[CREASE_PATCH_DEGREE + 1], py[CREASE_PATCH_DEGREE + 1];
    powers(patch, x, px);
    powers(patch, y, py);
    int n = 0;
    for (int total = 0; total <= patch->degree; total++)
        for (int j = 0; j <= total; j++, n++)
            out[n] = px[total - j] * py[j];
}

static double polynomial_at(const crease_patch *patch, double x, double y, double slope[2])
{
    double px[CREASE_PATCH_DEGREE + 1], py[CREASE_PATCH_DEGREE + 1], value = 0.0;
    powers(patch, x, px);
    powers(patch, y, py);
    slope[0] = slope[1] = 0.0;
    const double *coefficient = patch->coefficients;
    for (int total = 0; total <= patch->degree; total++)
        for (int j = 0; j <= total; j++, coefficient++) {
            const int i = total - j;
            value += *coefficient * px[i] * py[j];
            if (i)
                slope[0] += *coefficient * i * px[i - 1] * py[j];
            if (j)
                slope[1] += *coefficient * j * px[i] * py[j - 1];
        }
    slope[0] /= patch->unit[0];
    slope[1] /= patch->unit[0];
    return value;
}

/* Derivatives of the four uniform cubic B-splines of a span at t = 0..1. */
CREASE_INLINE void cubic_slopes(double t, double unit, double out[4])
{
    const double u = 1.0 - t;
    out[0] = -0.5 * u * u / unit;
    out[1] = 0.5 * (3.0 * t * t - 4.0 * t) / unit;
    out[2] = -0.5 * (3.0 * u * u - 4.0 * u) / unit;
    out[3] = 0.5 * t * t / unit;
}

/* By address: as an argument a vector's place would depend on the instruction set. */
CREASE_INLINE double sum_of(const crease_four *values)
{
    return ((*values)[0] + (*values)[1]) + ((*values)[2] + (*values)[3]);
}

CREASE_VECTORISED static double spline_at(
    const crease_patch *patch, double x, double y, double slope[2])
{
    crease_cell cell;
    double sx[4], sy[4];
    crease_patch_cell(patch, x, y, &cell);
    cubic_slopes(cell.t[0], patch->unit[0], sx);
    cubic_slopes(cell.t[1], patch->unit[1], sy);
    crease_four along = {0.0}, rise = {0.0};
    for (size_t a = 0; a < 4; a++) {
        const crease_four row = *(const crease_four *)(patch->coefficients + cell.first[a]);
        along += cell.x[a] * row;
        rise += sx[a] * row;
    }
    const crease_four values = *(const crease_four *)cell.y, slopes = *(const crease_four *)sy;
    rise *= values;
    slope[0] = sum_of(&rise);
    const crease_four aslant = along * slopes, value = along * values;
    slope[1] = sum_of(&aslant);
    return sum_of(&value);
}

double crease_patch_at(const crease_patch *patch, double x, double y, double slope[2])
{
    if (patch->round)
        x -= patch->high[0] * floor(x / patch->high[0]);
    const double inside[2] = {
        clamp(x, patch->low[0], patch->high[0]), clamp(y, patch->low[1], patch->high[1])};
    const double value = patch->spline ? spline_at(patch, inside[0], inside[1], slope)
                                       : polynomial_at(patch, inside[0], inside[1], slope);
    return value + slope[0] * (x - inside[0]) + slope[1] * (y - inside[1]);
}
