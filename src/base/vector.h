/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Vectors of space. */
#ifndef CREASE_BASE_VECTOR_H
#define CREASE_BASE_VECTOR_H

#include <stddef.h>

double crease_vector_dot(const double a[3], const double b[3]);
double crease_vector_length(const double a[3]);
double crease_vector_distance(const double a[3], const double b[3]);
void crease_vector_cross(const double a[3], const double b[3], double out[3]);
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
