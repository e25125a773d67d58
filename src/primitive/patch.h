/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Height fields: the bases of crease_patch and their values. */
#ifndef CREASE_PRIMITIVE_PATCH_H
#define CREASE_PRIMITIVE_PATCH_H

#include "base/simd.h"
#include "primitive/model.h"

enum {
    CREASE_PATCH_TERMS = 15, /* of a polynomial of that degree */
    CREASE_PATCH_DEGREE = 4, /* highest degree of a polynomial */
    CREASE_PATCH_SPANS = 24, /* most spans of a spline in one direction */
    CREASE_PATCH_COEFFICIENTS = (CREASE_PATCH_SPANS + 3) * (CREASE_PATCH_SPANS + 3)
};

/* The cubic B-splines of a spline that are not 0 in one place. */
typedef struct crease_cell {
    size_t first[4];   /* coefficient of each of those of x with the first of those of y */
    double x[4], y[4]; /* their values */
    double t[2];       /* place in the cell, 0..1 */
} crease_cell;

/* The height at any place, and its slopes. */
double crease_patch_at(const crease_patch *patch, double x, double y, double slope[2]);
/* Values of a polynomial's terms, x^i y^j for i + j = 0, 1, .. degree. */
void crease_patch_terms(
    const crease_patch *patch, double x, double y, double out[CREASE_PATCH_TERMS]);
/* Control points along one side of a spline; those of one x or angle are together. */
size_t crease_patch_side(const crease_patch *patch);

CREASE_INLINE void crease_patch_cubic(double t, double out[4])
{
    const double u = 1.0 - t, sixth = 1.0 / 6.0;
    out[0] = sixth * (u * u * u);
    out[1] = sixth * ((3.0 * t - 6.0) * (t * t) + 4.0);
    out[2] = sixth * ((3.0 * u - 6.0) * (u * u) + 4.0);
    out[3] = sixth * (t * t * t);
}

/* The span of a coordinate, the last one beyond the end; *t: the place in it. */
CREASE_INLINE size_t crease_patch_span(const crease_patch *patch, int axis, double at, double *t)
{
    const double u = (at - patch->low[axis]) / patch->unit[axis];
    const int last = patch->spans - 1;
    const int span = u >= last ? last : u > 0.0 ? (int)u : 0;
    *t = u - span;
    return (size_t)span;
}

/* x, y inside low..high. */
CREASE_INLINE void crease_patch_cell(
    const crease_patch *patch, double x, double y, crease_cell *out)
{
    const size_t spans = (size_t)patch->spans, side = spans + 3;
    const size_t i = crease_patch_span(patch, 0, x, &out->t[0]);
    const size_t j = crease_patch_span(patch, 1, y, &out->t[1]);
    crease_patch_cubic(out->t[0], out->x);
    crease_patch_cubic(out->t[1], out->y);
    for (size_t a = 0; a < 4; a++) {
        const size_t row = patch->round && i + a >= spans ? i + a - spans : i + a;
        out->first[a] = row * side + j;
    }
}

#endif
