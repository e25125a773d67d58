/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The energies that hold a sheet where its points do not: bending, the integral of
 * f_xx^2 + 2 f_xy^2 + f_yy^2 over the smooth parts, creases being free (order 2: f_x^2 + f_y^2),
 * and tension in the gaps, where bending costs nothing: the integral of f_x^2 + f_y^2 and of some
 * bending over them, a membrane, which stays within what surrounds it. */
#ifndef CREASE_NET_BENDING_H
#define CREASE_NET_BENDING_H

#include "net/gaps.h"
#include "net/stencil.h"

/* Integrals along one direction, over whole spans and over the pieces that they are cut into where
 * there are gaps. A block holds, packed, the products of the values, slopes and second derivatives
 * of the functions that are not zero there. */
typedef struct crease_strip {
    size_t spans, pieces;
    size_t *first;  /* function of each span */
    size_t *begin;  /* first piece of each span; one more than spans */
    double *middle; /* of each piece */
    double *whole;  /* a block for each span */
    double *part;   /* a block for each piece */
} crease_strip;

typedef struct crease_bending {
    int order;
    size_t block;     /* numbers of a block; the products of the values come first */
    crease_gaps gaps; /* its raster is not owned */
    crease_strip strip[2];
} crease_bending;

/* Of the height only the knots are looked at; the raster of
 * the gaps must outlive this. Errors: NO_MEMORY. */
crease_status crease_bending_create(crease_context *context, const crease_height *height,
    const crease_gaps *gaps, crease_bending *out);
void crease_bending_free(crease_bending *bending);
/* Traces of the matrices of bending and tension. */
void crease_bending_traces(const crease_bending *bending, double traces[2]);
/* Adds bending times one weight and tension times another. Errors: NO_MEMORY, CANCELLED. */
crease_status crease_bending_add(crease_context *context, const crease_bending *bending,
    double weight, double tension, crease_stencil *stencil);

#endif
