/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Knot vectors and what becomes of control points when knots are added. */
#ifndef CREASE_SPLINE_KNOTS_H
#define CREASE_SPLINE_KNOTS_H

#include "base/context.h"

/* Control points seen along one direction: outer x pitch x inner numbers, of which the first
 * `count` of each pitch are in use. A curve: 1 x count x 3; a surface along u: 1 x m x 3n, along
 * v: m x n x 3. */
typedef struct crease_rows {
    size_t outer, pitch, inner;
    double *values;
} crease_rows;

/* CREASE_OK when order, count and knots make a spline space with a domain of positive length;
 * otherwise ARGUMENT with a sentence that begins with `what`. */
crease_status crease_knots_check(
    crease_context *context, const char *what, int order, size_t count, const double *knots);
/* Equally spaced knots with the domain first..last; control points at the ends are not reached. */
void crease_knots_uniform(int order, size_t count, double first, double last, double *knots);
/* Knots `order` times at both ends, equally spaced between. */
void crease_knots_clamped(int order, size_t count, double first, double last, double *knots);
/* How often t stands among the total knots. */
int crease_knots_multiplicity(const double *knots, size_t total, double t);
/* The parameter of each control point: the mean of the order - 1 knots inside its function's
 * support. */
void crease_knots_greville(const double *knots, int order, size_t count, double *out);
/* Inserts t once, in place: one more knot, one more control point in every row (NULL: none), the
 * same spline. There must be room for both; t lies in the domain.
 * Based on: Boehm. Inserting new knots into B-spline curves. 1980. */
void crease_knots_insert(
    int order, size_t count, double *knots, double t, const crease_rows *points);
/* Copies knots to `out` with t raised to a multiplicity of at least that given; returns the new
 * number of control points. out has room for count + order + multiplicity. */
size_t crease_knots_raise(
    const double *knots, int order, size_t count, double t, int multiplicity, double *out);
/* The spline over `knots` written over `fine`, which holds them all: new control point number i is
 * the sum over r of weights[i * order + r] times the old one number first[i] + r. The weights add
 * up to 1 and are not negative where the new point's knots lie within the domain.
 * Based on: Cohen, Lyche, Riesenfeld. Discrete B-splines and subdivision techniques. 1980. */
void crease_knots_prolong(int order, const double *knots, size_t count, const double *fine,
    size_t fine_count, size_t *first, double *weights);

#endif
