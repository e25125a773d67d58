/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A symmetric matrix over the control points of a net, each of which is coupled to those whose
 * functions overlap its own: 7 x 7 of them in a bicubic net. Half of these are kept, 25 numbers for
 * each control point.
 *
 * Number k = (2 order - 1) di + dj of the row of control points i couples (i, j) with
 * (i + di, j + dj), for di from 0 and dj from -(order - 1), or from 0 when di is 0, up to
 * order - 1. What would lie beside the net is zero. Vectors have count[0] x count[1] numbers, the
 * second index fastest. */
#ifndef CREASE_NET_STENCIL_H
#define CREASE_NET_STENCIL_H

#include "base/context.h"

typedef struct crease_stencil {
    size_t order, count[2];
    size_t width;   /* numbers kept for each control point */
    double *values; /* count[0] x width x count[1] */
} crease_stencil;

/* All zeros. Errors: NO_MEMORY. */
crease_status crease_stencil_create(
    crease_context *context, int order, const size_t count[2], crease_stencil *out);
void crease_stencil_free(crease_stencil *stencil);

void crease_stencil_clear(crease_stencil *stencil);
void crease_stencil_copy(const crease_stencil *from, crease_stencil *to);
/* Adds factor times another over the same net. */
void crease_stencil_add_scaled(const crease_stencil *from, double factor, crease_stencil *to);

/* Number of pairs a <= b of `order` functions. In a packed product of two directions, pair (a, b)
 * of the first and (c, d) of the second stand at [pair(a, b) pairs + pair(c, d)], and pair(a, b) is
 * a number of the sequence 00 01 .. 0n 11 12 .. nn. */
size_t crease_stencil_pairs(size_t order);
/* Products a b of the values of the functions, packed. */
void crease_stencil_pack(const double *values, size_t order, double *pairs);
/* Adds a packed product for the functions first[d] .. first[d] + order - 1 of each direction. */
void crease_stencil_add(crease_stencil *stencil, const size_t first[2], const double *product);

/* y = stencil x. Threaded. Errors: CANCELLED. */
crease_status crease_stencil_multiply(
    crease_context *context, const crease_stencil *stencil, const double *x, double *y);
/* Coupling of control point (i, j) with itself. */
double crease_stencil_diagonal(const crease_stencil *stencil, size_t i, size_t j);
double crease_stencil_trace(const crease_stencil *stencil);
/* The matrix as LAPACK stores a lower band, `width` numbers for each column. The unknown of control
 * point (i, j) is stride[0] i + stride[1] j, one of the strides being 1. band is overwritten. */
void crease_stencil_band(
    const crease_stencil *stencil, const size_t stride[2], size_t width, double *band);
/* The matrix over a coarser net, P^T stencil P. Fine control point i of direction d is the sum over
 * r of weights[d][order i + r] times the coarse one number first[d][i] + r. `coarse` must be zero.
 * Threaded. Errors: NO_MEMORY, CANCELLED. */
crease_status crease_stencil_coarsen(crease_context *context, const crease_stencil *stencil,
    const size_t *const first[2], const double *const weights[2], crease_stencil *coarse);

#endif
