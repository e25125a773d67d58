/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Based on: Cox. The numerical evaluation of B-splines. 1972; de Boor. On calculating with
 * B-splines. 1972; Piegl, Tiller. The NURBS Book. 1997, section 2.5; Ramshaw. Blossoms are polar
 * forms. 1989. */
#include "spline/basis.h"

#include "base/simd.h"

#include <string.h>

enum { CUBIC = 4 };

double crease_basis_clamp(const double *knots, int order, size_t count, double t)
{
    const double first = knots[order - 1];
    const double last = knots[count];
    return t < first ? first : (t > last ? last : t);
}

static bool is_below(double knot, double t, bool equal)
{
    return knot < t || (equal && knot == t);
}

/* The index that t would have among knots that are spread evenly. */
static size_t guess_index(const double *knots, size_t low, size_t high, double t)
{
    const double share = (t - knots[low]) / (knots[high] - knots[low]);
    const double guess = share * (double)(high - low);
    return guess > 0.0 && guess < (double)(high - low) ? low + (size_t)guess : low;
}

/* The largest index in low..high - 1 whose knot is below t (or equal, when `equal`), given that
 * this holds at low. Looked for in growing steps from the guess, then by halving. */
static size_t last_knot_below(const double *knots, size_t low, size_t high, double t, bool equal)
{
    const size_t guess = guess_index(knots, low, high, t);
    if (is_below(knots[guess], t, equal)) {
        low = guess;
        for (size_t step = 1; high - low > step; step *= 2) {
            if (!is_below(knots[low + step], t, equal)) {
                high = low + step;
                break;
            }
            low += step;
        }
    } else {
        high = guess;
        for (size_t step = 1; high - low > step; step *= 2) {
            if (is_below(knots[high - step], t, equal)) {
                low = high - step;
                break;
            }
            high -= step;
        }
    }
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (is_below(knots[middle], t, equal))
            low = middle;
        else
            high = middle;
    }
    return low;
}

size_t crease_basis_span(const double *knots, int order, size_t count, double t, crease_side side)
{
    const size_t first = (size_t)order - 1;
    t = crease_basis_clamp(knots, order, count, t);
    const bool right = t <= knots[first] || (side == CREASE_SIDE_RIGHT && t < knots[count]);
    return last_knot_below(knots, first, count, t, right);
}

/* One step of the triangular scheme: functions of order j become those of order j + 1. What is
 * divided by holds the span, so it is never zero; at the ends of the span the share is exactly 0 or
 * 1, so that a clamped end is exactly its control point. */
CREASE_INLINE void raise_order(const double *knots, size_t span, double t, size_t j, double *values)
{
    double saved = 0.0;
    for (size_t r = 0; r < j; r++) {
        const double right = knots[span + r + 1];
        const double left = knots[span + 1 + r - j];
        const double share = (t - left) / (right - left);
        const double value = values[r];
        values[r] = saved + (1.0 - share) * value;
        saved = share * value;
    }
    values[j] = saved;
}

CREASE_INLINE void find_values(
    const double *knots, size_t order, size_t span, double t, double *values)
{
    values[0] = 1.0;
    for (size_t j = 1; j < order; j++)
        raise_order(knots, span, t, j, values);
}

/* Cubics, which nearly all splines are, get loops of known length. */
void crease_basis_values(const double *knots, int order, size_t span, double t, double *values)
{
    if (order == CUBIC)
        find_values(knots, CUBIC, span, t, values);
    else
        find_values(knots, (size_t)order, span, t, values);
}

void crease_basis_blossom(
    const double *knots, int order, size_t span, const double *arguments, double *weights)
{
    weights[0] = 1.0;
    for (size_t j = 1; j < (size_t)order; j++)
        raise_order(knots, span, arguments[j - 1], j, weights);
}

/* One differentiation: a spline of order j + 1 has the derivative sum_r d_r N_r of order j with
 * d_r = j (c_r - c_{r-1}) / length. Read backwards, derivatives of order j become those of order
 * j + 1, one higher. */
CREASE_INLINE void differentiate(const double *knots, size_t span, size_t j, double *values)
{
    double saved = 0.0;
    for (size_t r = 0; r < j; r++) {
        const double share =
            (double)j * values[r] / (knots[span + r + 1] - knots[span + 1 + r - j]);
        values[r] = saved - share;
        saved = share;
    }
    values[j] = saved;
}

CREASE_INLINE void find_derivatives(
    const double *knots, size_t size, size_t span, double t, size_t rows, double *out)
{
    double values[CREASE_ORDER_MAX] = {1.0};
    for (size_t j = 1; j <= size; j++) { /* the values are those of order j */
        if (size - j < rows) {
            memcpy(out + (size - j) * size, values, j * sizeof *out);
            memset(out + (size - j) * size + j, 0, (size - j) * sizeof *out);
        }
        if (j < size)
            raise_order(knots, span, t, j, values);
    }
    for (size_t d = 1; d < rows && d < size; d++)
        for (size_t j = size - d; j < size; j++)
            differentiate(knots, span, j, out + d * size);
}

void crease_basis_derivatives(
    const double *knots, int order, size_t span, double t, int derivatives, double *out)
{
    const size_t size = (size_t)order, rows = (size_t)derivatives + 1;
    if (order == CUBIC && rows == 2) {
        find_derivatives(knots, CUBIC, span, t, 2, out);
    } else if (order == CUBIC && rows == 3) {
        find_derivatives(knots, CUBIC, span, t, 3, out);
    } else {
        find_derivatives(knots, size, span, t, rows, out);
        if (rows > size)
            memset(out + size * size, 0, (rows - size) * size * sizeof *out);
    }
}
