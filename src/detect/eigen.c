/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* With the trace scaled to 1 the eigenvalues are the roots of l^3 - l^2 + c1 l - c0. Its smallest
 * root is found in closed form, the cosine of a third of an angle being replaced by a polynomial,
 * and improved by a step of Halley's. A column of the adjugate of A - l I then is the eigenvector;
 * its Rayleigh quotient frees l from the rounding of the determinant, and a second adjugate gives
 * the final vector.
 *
 * Based on: Smith. Eigenvalues of a symmetric 3 x 3 matrix. 1961.
 * Based on: Parlett. The symmetric eigenvalue problem. 1980 (Rayleigh quotient iteration). */
#include "detect/eigen.h"

#include "base/simd.h"

#include <math.h>

enum { LANES = 8 };

/* Below this the smallest eigenvalue is double for all that matters, and the adjugate mostly
 * rounding. */
static const double weakest = 1e-8;

typedef struct matrix {
    double xx, xy, xz, yy, yz, zz;
} matrix;

typedef struct vector {
    double x, y, z;
} vector;

CREASE_INLINE matrix shifted(const matrix *a, double value)
{
    return (matrix){a->xx - value, a->xy, a->xz, a->yy - value, a->yz, a->zz - value};
}

CREASE_INLINE matrix adjugate(const matrix *a)
{
    return (matrix){a->yy * a->zz - a->yz * a->yz, a->xz * a->yz - a->xy * a->zz,
        a->xy * a->yz - a->xz * a->yy, a->xx * a->zz - a->xz * a->xz, a->xy * a->xz - a->xx * a->yz,
        a->xx * a->yy - a->xy * a->xy};
}

/* The column with the largest diagonal entry. */
CREASE_INLINE vector column(const matrix *a)
{
    const int y = a->yy > a->xx, z = a->zz > (y ? a->yy : a->xx);
    const vector low = {y ? a->xy : a->xx, y ? a->yy : a->xy, y ? a->yz : a->xz};
    return (vector){z ? a->xz : low.x, z ? a->yz : low.y, z ? a->zz : low.z};
}

CREASE_INLINE double square(const vector *v)
{
    return v->x * v->x + v->y * v->y + v->z * v->z;
}

CREASE_INLINE double rayleigh(const matrix *a, const vector *v)
{
    const double diagonal = a->xx * v->x * v->x + a->yy * v->y * v->y + a->zz * v->z * v->z;
    const double mixed = a->xy * v->x * v->y + a->xz * v->x * v->z + a->yz * v->y * v->z;
    const double length = square(v);
    return (diagonal + 2 * mixed) / (length > 0 ? length : 1);
}

/* 2 cos(2 pi / 3 + acos(1 - 2 u^2) / 3) for u = 0..1, to 3e-5. */
CREASE_INLINE double smallest_cosine(double u)
{
    const double bend = 0.15389809321 + u * (-0.05998187323 + u * 0.01775384789);
    return -1 - u * (1 + (1 - u) * bend);
}

/* The smallest root of l^3 - l^2 + c1 l - c0, all roots being real and not negative. */
CREASE_INLINE double smallest_root(double c1, double c0)
{
    const double third = 1.0 / 3;
    const double p = third * (third - c1), q = 0.5 * (c0 - third * (c1 - 2 * third * third));
    const double size = sqrt(p > 0 ? p : 0);
    const double cube = p * size;
    const double ratio = cube > 1e-30 ? q / cube : 1;
    const double versine = 0.5 * (1 - (ratio < 1 ? ratio : 1));
    double root = third + size * smallest_cosine(sqrt(versine < 1 ? versine : 1));
    const double value = ((root - 1) * root + c1) * root - c0;
    const double slope = (3 * root - 2) * root + c1;
    const double below = 2 * slope * slope - value * (6 * root - 2);
    const double step = 2 * value * slope / (below > 1e-200 ? below : 1);
    return root - (below > 1e-200 ? step : 0);
}

CREASE_INLINE matrix scaled(const crease_matrices *matrices, size_t i)
{
    const double trace = matrices->xx[i] + matrices->yy[i] + matrices->zz[i];
    const double scale = trace > 0 ? 1 / trace : 0;
    return (matrix){matrices->xx[i] * scale, matrices->xy[i] * scale, matrices->xz[i] * scale,
        matrices->yy[i] * scale, matrices->yz[i] * scale, matrices->zz[i] * scale};
}

/* Returns the strength: how far the smallest eigenvalue is from being double; 0 when it is. */
CREASE_INLINE double solve(const matrix *a, vector *out, double *spread)
{
    const matrix minors = adjugate(a);
    const double c1 = minors.xx + minors.yy + minors.zz;
    const double c0 = a->xx * minors.xx + a->xy * minors.xy + a->xz * minors.xz;
    const matrix rough = shifted(a, smallest_root(c1, c0));
    const matrix first = adjugate(&rough);
    const vector guess = column(&first);
    const matrix fine = shifted(a, rayleigh(a, &guess));
    const matrix second = adjugate(&fine);
    const vector found = column(&second);
    const double length = sqrt(square(&found));
    const double scale = 1 / (length > 0 ? length : 1);
    *out = (vector){found.x * scale, found.y * scale, found.z * scale};
    *spread = c1;
    const double guess_length = sqrt(square(&guess));
    return guess_length < length ? guess_length : length;
}

/* A unit vector across v, which is not 0. */
static vector across(const vector *v)
{
    const double x = fabs(v->x), y = fabs(v->y), z = fabs(v->z);
    vector w = {-v->y, v->x, 0};
    if (x <= y && x <= z)
        w = (vector){0, -v->z, v->y};
    else if (y <= z)
        w = (vector){v->z, 0, -v->x};
    const double length = sqrt(square(&w));
    return (vector){w.x / length, w.y / length, w.z / length};
}

/* A = l I + (l3 - l) v3 v3', l also being a root of the derivative 3 l^2 - 2 l + c1: the columns of
 * A - l I point along v3, and any vector across v3 will do. */
static vector solve_double(const matrix *a)
{
    const matrix minors = adjugate(a);
    const double c1 = minors.xx + minors.yy + minors.zz;
    const matrix rest = shifted(a, (1 - sqrt(fmax(1 - 3 * c1, 0))) / 3);
    const vector v3 = column(&rest);
    return square(&v3) > 1e-24 ? across(&v3) : (vector){0, 0, 1};
}

CREASE_VECTORISED void crease_eigen_smallest(
    const crease_matrices *restrict matrices, size_t count, crease_directions *restrict directions)
{
    double strengths[CREASE_BATCH];
    const size_t whole = (count + LANES - 1) / LANES * LANES;
    for (size_t i = 0; i < whole; i++) {
        const matrix a = scaled(matrices, i);
        vector v;
        strengths[i] = solve(&a, &v, &directions->spread[i]);
        directions->x[i] = v.x;
        directions->y[i] = v.y;
        directions->z[i] = v.z;
    }
    for (size_t i = 0; i < count; i++) {
        if (strengths[i] >= weakest)
            continue;
        const matrix a = scaled(matrices, i);
        const vector v = solve_double(&a);
        directions->x[i] = v.x;
        directions->y[i] = v.y;
        directions->z[i] = v.z;
    }
}
