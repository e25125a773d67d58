/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A height over a rectangle: a tensor-product B-spline z = f(x, y). */
#ifndef CREASE_NET_HEIGHT_H
#define CREASE_NET_HEIGHT_H

#include "base/context.h"
#include "base/frame.h"
#include "net/layout.h"

enum { CREASE_HEIGHT_ORDER_MAX = 8 };

typedef struct crease_height {
    int order;
    size_t count[2];
    double *knots[2];     /* count + order */
    double *coefficients; /* count[0] x count[1], the second index fastest */
} crease_height;

crease_status crease_height_create(
    crease_context *context, const crease_layout *layout, crease_height *out);
void crease_height_free(crease_height *height);

/* Makes the height much like another over much the same domain, exactly when that is linear.
 * Based on: Schoenberg. On spline functions. 1967 (variation diminishing approximation). */
void crease_height_resemble(const crease_height *other, crease_height *height);

/* The functions that are not zero at a place, first[d] .. first[d] + order - 1 along each
 * direction, and their values and, when asked for, first derivatives. */
typedef struct crease_support {
    size_t first[2];
    double values[2][CREASE_HEIGHT_ORDER_MAX];
    double slopes[2][CREASE_HEIGHT_ORDER_MAX];
} crease_support;

void crease_height_support(const crease_height *height, const double uv[2],
    const crease_side sides[2], int derivatives, crease_support *out);
/* Value, and with derivatives 1 also the partial derivatives along x and y. */
void crease_height_at(const crease_height *height, const double uv[2], const crease_side sides[2],
    int derivatives, double out[3]);
/* The surface in space: x and y are its parameters, exactly. */
crease_status crease_height_surface(crease_context *context, const crease_height *height,
    const crease_frame *frame, crease_surface **out);

#endif
