/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Eigenvectors of symmetric 3 x 3 matrices, many at a time. */
#ifndef CREASE_DETECT_EIGEN_H
#define CREASE_DETECT_EIGEN_H

#include <stddef.h>

enum { CREASE_BATCH = 64 };

/* Positive semi-definite matrices, entry by entry. */
typedef struct crease_matrices {
    double xx[CREASE_BATCH], xy[CREASE_BATCH], xz[CREASE_BATCH];
    double yy[CREASE_BATCH], yz[CREASE_BATCH], zz[CREASE_BATCH];
} crease_matrices;

typedef struct crease_directions {
    double x[CREASE_BATCH], y[CREASE_BATCH], z[CREASE_BATCH];
    /* Sum of the products of two eigenvalues over the squared trace: 0 when at most one eigenvalue
     * differs from 0 (points on a line), 1/4 for a round patch, 1/3 for a ball. */
    double spread[CREASE_BATCH];
} crease_directions;

/* Unit eigenvectors of the smallest eigenvalues of the first count matrices, sign arbitrary. Where
 * the smallest eigenvalue is double or triple, any one vector of its space. Works on whole groups
 * of eight: the matrices up to the next multiple of eight must be set, to anything. */
void crease_eigen_smallest(
    const crease_matrices *restrict matrices, size_t count, crease_directions *restrict directions);

#endif
