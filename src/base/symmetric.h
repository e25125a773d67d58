/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Small symmetric matrices, solved where they stand: for the millions of tiny problems of a cloud,
 * inside threads, where a call into LAPACK costs more than the work and brings threads of its own.
 */
#ifndef CREASE_BASE_SYMMETRIC_H
#define CREASE_BASE_SYMMETRIC_H

#include <stdbool.h>
#include <stddef.h>

/* Eigenvalues, ascending, and unit eigenvectors, the rows of axes, of the matrix xx xy xz yy yz zz.
 */
void crease_symmetric_axes(const double matrix[6], double values[3], double axes[9]);

/* Adds weight * v v' to the matrix xx xy xz yy yz zz. */
void crease_symmetric_add(double matrix[6], double weight, const double v[3]);

/* Replaces the lower triangle of a positive definite n x n matrix (row by row, `stride` numbers
 * from row to row) by its Cholesky factor. Entries further than `band` left of the diagonal are
 * zero and not touched. False when the matrix is not positive definite. O(n band^2). */
bool crease_symmetric_factor(double *matrix, size_t n, size_t stride, size_t band);
/* Solves with that factor, in place. */
void crease_symmetric_solve(
    const double *factor, size_t n, size_t stride, size_t band, double *right);

#endif
