/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A sheet whose control points are free in space, and the feet of points on it. */
#ifndef CREASE_FIT_FORM_H
#define CREASE_FIT_FORM_H

#include "net/height.h"

typedef struct crease_form {
    crease_layout layout;
    crease_height basis; /* its coefficients are not in use */
    double *net;         /* count[0] x count[1] x 3, the second index fastest */
} crease_form;

/* Points and where they fall on a form. Every point has its strip, the part of the form between two
 * lines of direction 0, and its foot stays in it: near a crease the distance from the surface of
 * one side counts, extended if need be. */
typedef struct crease_feet {
    size_t count;
    const double *points; /* count x 3 */
    uint8_t *strip;       /* number of lines below */
    double *uv;           /* count x 2 */
    double *foot;         /* count x 3 */
    double *normal;       /* count x 3, of the form at the foot */
    double *residual;     /* distance along the normal */
    double *clear;        /* distance of the foot from the nearest line, along the form */
    double *prior;        /* 0: left out, else 1 */
    double *weight;
} crease_feet;

crease_status crease_form_create(
    crease_context *context, const crease_layout *layout, crease_form *out);
void crease_form_free(crease_form *form);
/* The functions that are not zero at a place of a strip; at a line, those of the strip. */
void crease_form_support(const crease_form *form, size_t strip, const double uv[2], int derivatives,
    crease_support *out);
/* Point, and first derivatives along u and v. */
void crease_form_at(const crease_form *form, size_t strip, const double uv[2], double out[3][3]);

crease_status crease_feet_create(
    crease_context *context, const double *points, size_t count, crease_feet *out);
void crease_feet_free(crease_feet *feet);
/* Gives each point strip, parameters and prior of the nearest one of others that is not left out;
 * points further than `reach` from all of them are left out. */
crease_status crease_feet_borrow(
    crease_context *context, const crease_feet *from, double reach, crease_feet *to);
/* Moves the feet of all points to the nearest place of their strips, from where they are; a point
 * less than `near` from a line goes to the nearer one of its sides. Threaded. */
crease_status crease_feet_move(
    crease_context *context, const crease_form *form, double near, crease_feet *feet);
/* Sets foot, normal and residual without moving. Threaded. */
crease_status crease_feet_measure(
    crease_context *context, const crease_form *form, crease_feet *feet);

#endif
