/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A matrix that is easily inverted and near to the normal matrix of a net: that of points spread
 * evenly over it, a product of one matrix for each direction, scaled by the diagonal of the true
 * one. What is left to do after it is smooth, or due to the unevenness of the points.
 *
 * Based on: Hofreither, Takacs. Robust multigrid for isogeometric analysis based on stable
 * splittings of spline spaces. 2017 (the mass matrix as smoother). */
#ifndef CREASE_NET_RELAX_H
#define CREASE_NET_RELAX_H

#include "net/bending.h"

typedef struct crease_relaxation {
    size_t order, count[2];
    double *factor[2]; /* Cholesky factors of the two matrices with unit diagonals: count x order;
                          first the reciprocal of the diagonal */
    double *scale;     /* reciprocal root of the diagonal of each unknown */
} crease_relaxation;

/* Errors: NO_MEMORY. */
crease_status crease_relaxation_create(crease_context *context, const crease_bending *bending,
    const size_t count[2], crease_relaxation *out);
void crease_relaxation_free(crease_relaxation *relaxation);
/* Takes the scale from the matrix; an unknown without any keeps 0. */
void crease_relaxation_set(crease_relaxation *relaxation, const crease_stencil *stencil);
/* z = inverse r. Threaded. Errors: CANCELLED. */
crease_status crease_relaxation_apply(
    crease_context *context, const crease_relaxation *relaxation, const double *r, double *z);

#endif
