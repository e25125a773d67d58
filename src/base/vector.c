/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "base/vector.h"

#include <lapacke.h>
#include <math.h>
#include <string.h>

void crease_vector_normalise(double a[3])
{
    const double length = crease_vector_length(a);
    for (int c = 0; c < 3 && length > 0.0; c++)
        a[c] /= length;
}

void crease_vector_orient(double a[3], const int order[3])
{
    int i = 0;
    while (i < 2 && fabs(a[order[i]]) < 1e-9)
        i++;
    const double sign = a[order[i]] < 0.0 ? -1.0 : 1.0;
    for (int c = 0; c < 3; c++)
        a[c] *= sign;
}

static double weight_of(const double *weights, size_t i)
{
    return weights ? weights[i] : 1.0;
}

static void weighted_mean(const double *points, const double *weights, size_t count, double out[3])
{
    double sum = 0.0, total[3] = {0};
    for (size_t i = 0; i < count; i++) {
        sum += weight_of(weights, i);
        for (size_t c = 0; c < 3; c++)
            total[c] += weight_of(weights, i) * points[3 * i + c];
    }
    for (int c = 0; c < 3; c++)
        out[c] = sum > 0.0 ? total[c] / sum : 0.0;
}

void crease_vector_main_axes(const double *points, const double *weights, size_t count,
    double mean[3], double values[3], double axes[9])
{
    weighted_mean(points, weights, count, mean);
    double sum = 0.0;
    memset(axes, 0, 9 * sizeof *axes);
    for (size_t i = 0; i < count; i++) {
        const double w = weight_of(weights, i);
        const double *const p = points + 3 * i;
        const double d[3] = {p[0] - mean[0], p[1] - mean[1], p[2] - mean[2]};
        sum += w;
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 3; c++)
                axes[3 * r + c] += w * d[r] * d[c];
    }
    for (int i = 0; i < 9 && sum > 0.0; i++)
        axes[i] /= sum;
    double work[32];
    LAPACKE_dsyev_work(LAPACK_COL_MAJOR, 'V', 'U', 3, axes, 3, values, work, 32);
}
