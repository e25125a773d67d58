/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The bending matrix, a sum of Kronecker products of integrals along the two directions.
 *
 * Based on: Duchon. Splines minimizing rotation-invariant semi-norms in Sobolev spaces. 1977;
 * Golub, Welsch. Calculation of Gauss quadrature rules. 1969 (the rule; its nodes by Newton's
 * method). */
#include "fit/bending.h"

#include "base/memory.h"
#include "spline/basis.h"

#include <math.h>
#include <stdlib.h>

enum { MOST = CREASE_HEIGHT_ORDER_MAX, KINDS = 3 };

/* Nodes and weights of the Gauss-Legendre rule with n points on [-1, 1]. */
static void gauss_rule(int n, double *nodes, double *weights)
{
    for (int i = 0; i < n; i++) {
        double x = cos(3.14159265358979324 * (i + 0.75) / (n + 0.5)), slope = 1.0;
        for (int step = 0; step < 10; step++) {
            double before = 1.0, value = x;
            for (int k = 2; k <= n; k++) {
                const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
                before = value;
                value = next;
            }
            slope = n * (x * value - before) / (x * x - 1.0);
            x -= value / slope;
        }
        nodes[i] = x;
        weights[i] = 2.0 / ((1.0 - x * x) * slope * slope);
    }
}

/* integrals[kind][i * order + k]: the integral of the products of the derivatives number `kind` of
 * functions i and i + k. */
static void integrate(const double *knots, int order, size_t count, double *integrals[KINDS])
{
    double nodes[MOST], weights[MOST], values[KINDS * MOST];
    const size_t width = (size_t)order;
    gauss_rule(order, nodes, weights);
    for (size_t span = width - 1; span < count; span++) {
        const double half = 0.5 * (knots[span + 1] - knots[span]);
        for (size_t g = 0; g < width && half > 0.0; g++) {
            const double t = knots[span] + half * (1.0 + nodes[g]);
            crease_basis_derivatives(knots, order, span, t, KINDS - 1, values);
            for (size_t kind = 0; kind < KINDS; kind++)
                for (size_t a = 0; a < width; a++)
                    for (size_t b = a; b < width; b++)
                        integrals[kind][(span + 1 - width + a) * width + (b - a)] +=
                            half * weights[g] * values[kind * width + a] * values[kind * width + b];
        }
    }
}

static double product(
    double *integrals[2][KINDS], size_t iu, size_t ku, size_t iv, size_t kv, size_t width)
{
    const size_t u = iu * width + ku, v = iv * width + kv;
    if (width == 2)
        return integrals[0][1][u] * integrals[1][0][v] + integrals[0][0][u] * integrals[1][1][v];
    return integrals[0][2][u] * integrals[1][0][v] + 2.0 * integrals[0][1][u] * integrals[1][1][v] +
        integrals[0][0][u] * integrals[1][2][v];
}

static void fill(crease_system *system, const crease_height *height, double *integrals[2][KINDS])
{
    const size_t width = (size_t)height->order, rows = height->count[0], columns = height->count[1];
    for (size_t iu = 0; iu < rows; iu++)
        for (size_t iv = 0; iv < columns; iv++)
            for (size_t ju = iu + 1 > width ? iu + 1 - width : 0; ju < rows && ju < iu + width;
                 ju++)
                for (size_t jv = iv + 1 > width ? iv + 1 - width : 0;
                     jv < columns && jv < iv + width; jv++) {
                    const size_t a = crease_system_index(system, iu, iv);
                    const size_t b = crease_system_index(system, ju, jv);
                    if (a < b)
                        continue;
                    const size_t lu = iu < ju ? iu : ju, lv = iv < jv ? iv : jv;
                    system->bending[b * system->width + (a - b)] =
                        product(integrals, lu, iu + ju - 2 * lu, lv, iv + jv - 2 * lv, width);
                }
}

crease_status crease_bending_fill(
    crease_context *context, const crease_height *height, crease_system *system)
{
    double *integrals[2][KINDS] = {{NULL}};
    bool complete = true;
    for (int d = 0; d < 2; d++)
        for (int kind = 0; kind < KINDS && complete; kind++) {
            integrals[d][kind] =
                crease_allocate(context, height->count[d], (size_t)height->order * sizeof(double));
            complete = integrals[d][kind] != NULL;
        }
    for (int d = 0; d < 2 && complete; d++)
        integrate(height->knots[d], height->order, height->count[d], integrals[d]);
    if (complete)
        fill(system, height, integrals);
    for (int d = 0; d < 2; d++)
        for (int kind = 0; kind < KINDS; kind++)
            free(integrals[d][kind]);
    return complete ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
}
