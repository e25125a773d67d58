/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The squared distance of a place to a Bezier patch as a polynomial in Bernstein form over a box of
 * the patch's parameters: its coefficients bound it from below, and their differences tell where it
 * is monotone or convex. */
#ifndef CREASE_SPLINE_BERNSTEIN_H
#define CREASE_SPLINE_BERNSTEIN_H

#include <stdbool.h>
#include <stddef.h>

/* A Bezier patch seen from a place: degree + 1 points along u and v, v fastest, relative to it. */
typedef struct crease_patch {
    int degree[2];
    const double *points;
} crease_patch;

/* Squared distance over the box lowest..highest (each within 0..1): (degree[0] + 1) x (degree[1] +
 * 1) coefficients, v fastest. A degree of 0 belongs to a box without width. */
typedef struct crease_box {
    int degree[2];
    double lowest[2], highest[2];
    double least;    /* smallest coefficient: the distance is nowhere less */
    double rounding; /* bound on the rounding error of the coefficients */
    double *coefficients;
} crease_box;

/* Point and derivatives of a patch, relative to the place. */
typedef struct crease_patch_point {
    double s[3], u[3], v[3], uu[3], uv[3], vv[3];
} crease_patch_point;

void crease_patch_evaluate(const crease_patch *patch, const double at[2], crease_patch_point *out);
/* The whole patch. Coefficients: room for (2 degree[0] + 1) x (2 degree[1] + 1). */
void crease_box_of_patch(const crease_patch *patch, crease_box *box);
/* Reduces the box to its side (or corner) when the distance grows away from it throughout. */
void crease_box_reduce(crease_box *box);
/* True when the distance is strictly convex in the box: one minimum, to be found by Newton's
 * method.
 */
bool crease_box_convex(const crease_box *box);
/* Parameters that belong to the smallest coefficient: a first guess. */
void crease_box_guess(const crease_box *box, double at[2]);
/* Halves the box across the direction in which the distance varies more. The lower half stays in
 * `box`, the upper half goes to `upper`, whose coefficients have room. */
void crease_box_halve(crease_box *box, crease_box *upper);

#endif
