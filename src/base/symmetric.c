/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "base/symmetric.h"

#include "base/simd.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum {
    MOST_SWEEPS = 30,
    LANES = 8,
    NARROW = 15 /* rows up to which products are summed one by one */
};

/* Turns rows (and columns) p and q of a so that entry p q vanishes, and the axes with them.
 * Based on: Golub, Van Loan. Matrix Computations. 1996 (8.4, the classical Jacobi rotation). */
static void rotate(double a[3][3], double axes[9], int p, int q)
{
    if (a[p][q] == 0.0)
        return;
    const double cotangent = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
    const double t = copysign(1.0, cotangent) / (fabs(cotangent) + hypot(cotangent, 1.0));
    const double c = 1.0 / sqrt(t * t + 1.0), s = t * c;
    const int r = 3 - p - q;
    const double pr = a[p][r], qr = a[q][r];
    a[p][p] -= t * a[p][q];
    a[q][q] += t * a[p][q];
    a[p][q] = a[q][p] = 0.0;
    a[p][r] = a[r][p] = c * pr - s * qr;
    a[q][r] = a[r][q] = s * pr + c * qr;
    for (int k = 0; k < 3; k++) {
        const double x = axes[3 * p + k], y = axes[3 * q + k];
        axes[3 * p + k] = c * x - s * y;
        axes[3 * q + k] = s * x + c * y;
    }
}

static void exchange(double values[3], double axes[9], int i, int j)
{
    double row[3];
    const double value = values[i];
    values[i] = values[j];
    values[j] = value;
    memcpy(row, axes + 3 * i, sizeof row);
    memcpy(axes + 3 * i, axes + 3 * j, sizeof row);
    memcpy(axes + 3 * j, row, sizeof row);
}

void crease_symmetric_axes(const double m[6], double values[3], double axes[9])
{
    double a[3][3] = {{m[0], m[1], m[2]}, {m[1], m[3], m[4]}, {m[2], m[4], m[5]}};
    static const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    memcpy(axes, identity, sizeof identity);
    for (int sweep = 0; sweep < MOST_SWEEPS; sweep++) {
        const double rest = fabs(a[0][1]) + fabs(a[0][2]) + fabs(a[1][2]);
        const double size = fabs(a[0][0]) + fabs(a[1][1]) + fabs(a[2][2]);
        if (rest <= DBL_EPSILON * DBL_EPSILON * size)
            break;
        rotate(a, axes, 0, 1);
        rotate(a, axes, 0, 2);
        rotate(a, axes, 1, 2);
    }
    for (int k = 0; k < 3; k++)
        values[k] = a[k][k];
    if (values[1] < values[0])
        exchange(values, axes, 0, 1);
    if (values[2] < values[1])
        exchange(values, axes, 1, 2);
    if (values[1] < values[0])
        exchange(values, axes, 0, 1);
}

void crease_symmetric_add(double matrix[6], double weight, const double v[3])
{
    matrix[0] += weight * v[0] * v[0];
    matrix[1] += weight * v[0] * v[1];
    matrix[2] += weight * v[0] * v[2];
    matrix[3] += weight * v[1] * v[1];
    matrix[4] += weight * v[1] * v[2];
    matrix[5] += weight * v[2] * v[2];
}

static size_t first_column(size_t row, size_t band)
{
    return row > band ? row - band : 0;
}

/* Scalar product in lanes that are summed in the end, so that it vectorises. */
CREASE_INLINE double product(const double *a, const double *b, size_t count)
{
    double sums[LANES] = {0.0}, sum = 0.0;
    size_t k = 0;
    for (; k + LANES <= count; k += LANES)
        for (size_t lane = 0; lane < LANES; lane++)
            sums[lane] += a[k + lane] * b[k + lane];
    for (; k < count; k++)
        sum += a[k] * b[k];
    for (size_t lane = 0; lane < LANES; lane++)
        sum += sums[lane];
    return sum;
}

CREASE_INLINE bool factor(double *matrix, size_t n, size_t stride, size_t band, bool wide)
{
    for (size_t i = 0; i < n; i++) {
        double *const row = matrix + i * stride;
        const size_t begin = first_column(i, band);
        for (size_t j = begin; j <= i; j++) {
            const double *const other = matrix + j * stride;
            double sum = row[j];
            if (wide)
                sum -= product(row + begin, other + begin, j - begin);
            for (size_t k = wide ? j : begin; k < j; k++)
                sum -= row[k] * other[k];
            if (j < i)
                row[j] = sum / other[j];
            else if (!(sum > 0.0) || !isfinite(sum))
                return false;
            else
                row[i] = sqrt(sum);
        }
    }
    return true;
}

CREASE_VECTORISED static bool factor_wide(double *matrix, size_t n, size_t stride, size_t band)
{
    return factor(matrix, n, stride, band, true);
}

bool crease_symmetric_factor(double *matrix, size_t n, size_t stride, size_t band)
{
    return n > NARROW ? factor_wide(matrix, n, stride, band)
                      : factor(matrix, n, stride, band, false);
}

void crease_symmetric_solve(
    const double *factor, size_t n, size_t stride, size_t band, double *right)
{
    for (size_t i = 0; i < n; i++) {
        for (size_t k = first_column(i, band); k < i; k++)
            right[i] -= factor[i * stride + k] * right[k];
        right[i] /= factor[i * stride + i];
    }
    for (size_t i = n; i-- > 0;) {
        right[i] /= factor[i * stride + i];
        for (size_t k = first_column(i, band); k < i; k++)
            right[k] -= factor[i * stride + k] * right[i];
    }
}
