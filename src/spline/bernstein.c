/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Based on: Farouki, Rajan. Algorithms for polynomials in Bernstein form. 1988; Garloff. The
 * Bernstein algorithm. 1993. */
#include "spline/bernstein.h"

#include "spline/basis.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Binomial coefficients n over 0..n. */
static void binomials(int n, double *out)
{
    out[0] = 1.0;
    for (int i = 1; i <= n; i++)
        out[i] = out[i - 1] * (n + 1 - i) / i;
}

/* Bernstein polynomials of a degree from those one degree lower. */
static void raise_degree(int degree, double t, const double *from, double *to)
{
    for (int i = 0; i <= degree; i++)
        to[i] = (i < degree ? (1.0 - t) * from[i] : 0.0) + (i > 0 ? t * from[i - 1] : 0.0);
}

/* Derivatives of a spline of a degree from the same of the functions one degree lower. */
static void differentiate(int degree, const double *from, double *to)
{
    for (int i = 0; i <= degree; i++)
        to[i] = degree * ((i > 0 ? from[i - 1] : 0.0) - (i < degree ? from[i] : 0.0));
}

/* Values, first and second derivatives of all Bernstein polynomials of a degree. */
static void bernstein(int degree, double t, double out[3][CREASE_ORDER_MAX])
{
    double lower[3][CREASE_ORDER_MAX] = {{1.0}};
    memset(out, 0, 3 * sizeof out[0]);
    out[0][0] = 1.0;
    for (int i = 1; i <= degree; i++) {
        memcpy(lower[0], out[0], (size_t)i * sizeof(double));
        if (i == degree - 1)
            differentiate(i, lower[0], lower[1]);
        if (i == degree) {
            differentiate(i, lower[0], out[1]);
            if (degree > 1)
                differentiate(i, lower[1], out[2]);
        }
        raise_degree(i, t, lower[0], out[0]);
    }
}

void crease_patch_evaluate(const crease_patch *patch, const double at[2], crease_patch_point *out)
{
    double basis[2][3][CREASE_ORDER_MAX];
    for (int d = 0; d < 2; d++)
        bernstein(patch->degree[d], at[d], basis[d]);
    memset(out, 0, sizeof *out);
    const double *point = patch->points;
    for (int i = 0; i <= patch->degree[0]; i++) {
        double sum[3][3] = {{0}};
        for (int j = 0; j <= patch->degree[1]; j++, point += 3)
            for (int b = 0; b < 3; b++)
                for (int c = 0; c < 3; c++)
                    sum[b][c] += basis[1][b][j] * point[c];
        for (int c = 0; c < 3; c++) {
            out->s[c] += basis[0][0][i] * sum[0][c];
            out->u[c] += basis[0][1][i] * sum[0][c];
            out->v[c] += basis[0][0][i] * sum[1][c];
            out->uu[c] += basis[0][2][i] * sum[0][c];
            out->uv[c] += basis[0][1][i] * sum[1][c];
            out->vv[c] += basis[0][0][i] * sum[2][c];
        }
    }
}

static int coefficient_count(const crease_box *box)
{
    return (box->degree[0] + 1) * (box->degree[1] + 1);
}

static void find_least(crease_box *box)
{
    box->least = box->coefficients[0];
    for (int i = 1; i < coefficient_count(box); i++)
        box->least = fmin(box->least, box->coefficients[i]);
}

/* Points times the binomials of their indices: products of polynomials then are plain sums. */
static void weigh_points(const crease_patch *patch, double *weighed)
{
    double choose[2][CREASE_ORDER_MAX];
    for (int d = 0; d < 2; d++)
        binomials(patch->degree[d], choose[d]);
    const int width = patch->degree[1] + 1;
    for (int i = 0; i < 3 * (patch->degree[0] + 1) * width; i++)
        weighed[i] = choose[0][i / 3 / width] * choose[1][i / 3 % width] * patch->points[i];
}

/* Adds up the products of all pairs of points where their indices lead. */
static void multiply(const int degree[2], const double *weighed, double *out)
{
    const int width = degree[1] + 1;
    const int count = (degree[0] + 1) * width;
    for (int a = 0; a < count; a++) {
        const double *const p = weighed + 3 * a;
        double *const row = out + a / width * (2 * degree[1] + 1) + a % width;
        for (int b = a; b < count; b++) {
            const double *const q = weighed + 3 * b;
            const double product = p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
            row[b / width * (2 * degree[1] + 1) + b % width] += a == b ? product : 2.0 * product;
        }
    }
}

void crease_box_of_patch(const crease_patch *patch, crease_box *box)
{
    double weighed[3 * CREASE_ORDER_MAX * CREASE_ORDER_MAX];
    double choose[2][2 * CREASE_ORDER_MAX];
    for (int d = 0; d < 2; d++) {
        box->degree[d] = 2 * patch->degree[d];
        box->lowest[d] = 0.0;
        box->highest[d] = 1.0;
        binomials(box->degree[d], choose[d]);
    }
    weigh_points(patch, weighed);
    memset(box->coefficients, 0, (size_t)coefficient_count(box) * sizeof(double));
    multiply(patch->degree, weighed, box->coefficients);
    const int width = box->degree[1] + 1;
    double largest = 0.0;
    for (int i = 0; i < coefficient_count(box); i++) {
        box->coefficients[i] /= choose[0][i / width] * choose[1][i % width];
        largest = fmax(largest, fabs(box->coefficients[i]));
    }
    box->rounding = 16.0 * DBL_EPSILON * largest;
    find_least(box);
}

/* Range of the differences of neighbouring coefficients along a direction. */
static void difference_range(const crease_box *box, int direction, double range[2])
{
    const int width = box->degree[1] + 1;
    const int step = direction == 0 ? width : 1;
    range[0] = INFINITY;
    range[1] = -INFINITY;
    for (int i = 0; i < coefficient_count(box); i++) {
        if ((direction == 0 ? i / width : i % width) == box->degree[direction])
            continue;
        const double difference = box->coefficients[i + step] - box->coefficients[i];
        range[0] = fmin(range[0], difference);
        range[1] = fmax(range[1], difference);
    }
}

/* Keeps one side of the box: that of the lowest or highest parameter of a direction. */
static void collapse(crease_box *box, int direction, bool highest)
{
    const int width = box->degree[1] + 1;
    const int kept = highest ? box->degree[direction] : 0;
    const int along = box->degree[1 - direction] + 1;
    for (int i = 0; i < along; i++)
        box->coefficients[i] =
            box->coefficients[direction == 0 ? kept * width + i : i * width + kept];
    box->degree[direction] = 0;
    if (highest)
        box->lowest[direction] = box->highest[direction];
    else
        box->highest[direction] = box->lowest[direction];
    find_least(box);
}

void crease_box_reduce(crease_box *box)
{
    for (int d = 0; d < 2; d++) {
        if (box->degree[d] == 0)
            continue;
        double range[2];
        difference_range(box, d, range);
        if (range[0] >= -box->rounding)
            collapse(box, d, false);
        else if (range[1] <= box->rounding)
            collapse(box, d, true);
    }
}

/* Smallest second difference along a direction; infinite for a box without width. */
static double least_curvature(const crease_box *box, int direction)
{
    const int width = box->degree[1] + 1;
    const int step = direction == 0 ? width : 1;
    double least = INFINITY;
    for (int i = 0; i < coefficient_count(box); i++) {
        if ((direction == 0 ? i / width : i % width) + 2 > box->degree[direction])
            continue;
        const double *const c = box->coefficients + i;
        least = fmin(least, c[2 * step] - 2.0 * c[step] + c[0]);
    }
    const int m = box->degree[direction];
    return m * (m - 1) * (least - 4.0 * box->rounding);
}

static double largest_twist(const crease_box *box)
{
    const int width = box->degree[1] + 1;
    double largest = 0.0;
    for (int i = 0; i + width < coefficient_count(box); i++) {
        if (i % width == box->degree[1])
            continue;
        const double *const c = box->coefficients + i;
        largest = fmax(largest, fabs(c[width + 1] - c[width] - c[1] + c[0]));
    }
    return box->degree[0] * box->degree[1] * (largest + 4.0 * box->rounding);
}

bool crease_box_convex(const crease_box *box)
{
    double curvature[2];
    for (int d = 0; d < 2; d++) {
        curvature[d] = box->degree[d] ? least_curvature(box, d) : 1.0;
        if (!(curvature[d] > 0.0))
            return false;
    }
    if (box->degree[0] == 0 || box->degree[1] == 0)
        return true;
    const double twist = largest_twist(box);
    return curvature[0] * curvature[1] > twist * twist;
}

void crease_box_guess(const crease_box *box, double at[2])
{
    const int width = box->degree[1] + 1;
    int best = 0;
    for (int i = 1; i < coefficient_count(box); i++)
        if (box->coefficients[i] < box->coefficients[best])
            best = i;
    const int index[2] = {best / width, best % width};
    for (int d = 0; d < 2; d++) {
        const double share = box->degree[d] ? (double)index[d] / box->degree[d] : 0.0;
        at[d] = box->lowest[d] + share * (box->highest[d] - box->lowest[d]);
    }
}

/* Halves one line of coefficients. Based on: de Casteljau. Outillages methodes calcul. 1959. */
static void halve_line(double *lower, double *upper, int degree, int step)
{
    for (int r = 0; r < degree; r++) {
        upper[(degree - r) * step] = lower[degree * step];
        for (int i = degree; i > r; i--)
            lower[i * step] = 0.5 * (lower[i * step] + lower[(i - 1) * step]);
    }
    upper[0] = lower[degree * step];
}

void crease_box_halve(crease_box *box, crease_box *upper)
{
    double range[2] = {0};
    double variation[2] = {0};
    for (int d = 0; d < 2; d++)
        if (box->degree[d]) {
            difference_range(box, d, range);
            variation[d] = fmax(fabs(range[0]), fabs(range[1])) * box->degree[d];
        }
    const int direction = variation[1] > variation[0];
    const int width = box->degree[1] + 1;
    double *const coefficients = upper->coefficients;
    *upper = *box;
    upper->coefficients = coefficients;
    for (int i = 0; i <= box->degree[1 - direction]; i++) {
        const int line = direction == 0 ? i : i * width;
        halve_line(box->coefficients + line, coefficients + line, box->degree[direction],
            direction == 0 ? width : 1);
    }
    const double middle = 0.5 * (box->lowest[direction] + box->highest[direction]);
    box->highest[direction] = upper->lowest[direction] = middle;
    find_least(box);
    find_least(upper);
}
