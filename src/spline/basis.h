/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* B-spline basis functions of any order up to CREASE_ORDER_MAX over any knot vector.
 *
 * `count` basis functions of an order have count + order knots and the domain
 * [knots[order - 1], knots[count]]. On the span number s, [knots[s], knots[s + 1]], the functions
 * s - order + 1 .. s are not zero. A function takes a span besides the parameter, so that left and
 * right limits at a knot are the polynomials of the spans on either side of it. */
#ifndef CREASE_SPLINE_BASIS_H
#define CREASE_SPLINE_BASIS_H

#include "crease/crease.h"

enum { CREASE_ORDER_MAX = 16 };

/* t moved into the domain. */
double crease_basis_clamp(const double *knots, int order, size_t count, double t);
/* The span of positive length that holds t, t being moved into the domain. At a knot it is the span
 * that begins (right) or ends (left) there; at the borders the one inside. */
size_t crease_basis_span(const double *knots, int order, size_t count, double t, crease_side side);
/* The order values of the functions that are not zero on the span. */
void crease_basis_values(const double *knots, int order, size_t span, double t, double *values);
/* Derivatives 0..derivatives: (derivatives + 1) x order numbers; zeros above the degree. */
void crease_basis_derivatives(
    const double *knots, int order, size_t span, double t, int derivatives, double *out);
/* Weights of the control points span - order + 1 .. span in the polar form (blossom) of the span's
 * polynomial at the order - 1 arguments. All arguments t: the values at t. Arguments from one end
 * of the span and then from the other: Bezier points. Consecutive knots of a finer knot vector: its
 * control points. */
void crease_basis_blossom(
    const double *knots, int order, size_t span, const double *arguments, double *weights);

#endif
