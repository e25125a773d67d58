/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Vectors of space. */
#ifndef CREASE_BASE_VECTOR_H
#define CREASE_BASE_VECTOR_H

#include <math.h>
#include <stddef.h>

static inline double crease_vector_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline double crease_vector_length(const double a[3])
{
    return sqrt(crease_vector_dot(a, a));
}

static inline double crease_vector_distance(const double a[3], const double b[3])
{
    const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return crease_vector_length(d);
}

/* out may be a or b. */
static inline void crease_vector_cross(const double a[3], const double b[3], double out[3])
{
    const double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
    out[0] = x;
    out[1] = y;
}

/* Divides by the length, unless that is zero. */
void crease_vector_normalise(double a[3]);
/* Of a and -a the one whose first component that is not about zero, in the order given, is
 * positive. a is a unit vector. */
void crease_vector_orient(double a[3], const int order[3]);
/* Mean, and eigenvalues (ascending) and unit eigenvectors (rows of axes) of the covariance of count
 * points; weights may be NULL. */
void crease_vector_main_axes(const double *points, const double *weights, size_t count,
    double mean[3], double values[3], double axes[9]);

#endif
