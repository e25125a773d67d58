/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Conjugate gradients for the normal equations of a large net, preconditioned by a multigrid cycle
 * over nets with ever fewer knots: what a coarse net says is carried to the next finer one by knot
 * insertion, and back by its transpose, so that every coarse equation is that of the same problem.
 *
 * Memory: some 600 bytes for each control point of a bicubic net. Results do not depend on the
 * number of threads. */
#ifndef CREASE_NET_MULTIGRID_H
#define CREASE_NET_MULTIGRID_H

#include "net/bending.h"

typedef struct crease_multigrid crease_multigrid;

/* Of the height only the knots are looked at; the raster of the gaps must outlive this. Errors:
 * NO_MEMORY. */
crease_status crease_multigrid_create(crease_context *context, const crease_height *height,
    const crease_gaps *gaps, crease_multigrid **out);
void crease_multigrid_free(crease_multigrid *multigrid);
/* Takes the sum over the points to the coarser nets; normal must stay as it is while solving.
 * Errors: NO_MEMORY, CANCELLED. */
crease_status crease_multigrid_coarsen(
    crease_context *context, crease_multigrid *multigrid, const crease_stencil *normal);
/* The matrix becomes normal + weight bending + tension times its energy; *solvable: the coarsest of
 * them is positive definite. Errors: NO_MEMORY, CANCELLED. */
crease_status crease_multigrid_weigh(crease_context *context, crease_multigrid *multigrid,
    double weight, double tension, bool *solvable);
/* Solves until the square of the error, in the norm of the matrix, is tolerance^2 times the least
 * sum of squares: square, the sum of weight target^2, less what the solution explains; square 0:
 * times what the solution explains. A start of zeros is replaced by what the coarser nets say.
 * Errors: CANCELLED. */
crease_status crease_multigrid_solve(crease_context *context, crease_multigrid *multigrid,
    const double *right, double square, double tolerance, double *solution);

#endif
