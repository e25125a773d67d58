/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The normal equations of a penalised least-squares fit of a height: banded matrices, so that
 * LAPACK solves them.
 *
 * Minimised is sum_i weight_i tilt_i^2 (target_i - f(uv_i))^2 + lambda scale * bending(f), with
 * bending the integral of f_xx^2 + 2 f_xy^2 + f_yy^2 over the smooth parts: creases cost nothing.
 * (Order 2: f_x^2 + f_y^2.) `scale` makes lambda a pure number: both matrices have the same trace
 * at lambda = 1.
 *
 * Where points are missing nothing would hold such a sheet: it goes on as steeply as it came. There
 * bending costs nothing, and hold * tension(f) is added instead, with tension the integral of
 * f_x^2 + f_y^2 and of some bending over the gaps: a membrane, which stays within what surrounds
 * it. */
#ifndef CREASE_FIT_SYSTEM_H
#define CREASE_FIT_SYSTEM_H

#include "fit/gaps.h"

typedef struct crease_system {
    size_t size;      /* unknowns */
    size_t width;     /* of the band: diagonals below the main one, plus one */
    size_t stride[2]; /* number of the unknown: stride[0] i + stride[1] j; the smaller one is 1 */
    double *normal;   /* size x width, as LAPACK stores a lower band */
    double *bending;  /* the same */
    double *tension;  /* the same; NULL when there are no gaps */
    double hold;      /* weight of the tension; set by whoever solves */
    double *factor;   /* Cholesky factor of normal + lambda scale bending + hold tension */
    double *right;    /* size */
    double *solution; /* size */
    double *probes;   /* 2 x CREASE_PROBES x size: vectors that the trace is taken with, images */
    double lambda;    /* of the factor */
} crease_system;

enum { CREASE_PROBES = 8 };

/* Makes room, and computes the matrices of bending and tension. */
crease_status crease_system_create(crease_context *context, const crease_height *height,
    const crease_gaps *gaps, crease_system *out);
void crease_system_free(crease_system *system);
/* Number of the unknown that is control point i, j. */
size_t crease_system_index(const crease_system *system, size_t i, size_t j);
/* The normal matrix and the right side from the samples. Threaded. */
crease_status crease_system_assemble(crease_context *context, crease_system *system,
    const crease_height *height, const crease_samples *samples);
/* Factors for this lambda; false when the matrix is not positive definite. */
bool crease_system_factor(crease_system *system, double lambda);
/* Coefficients of the height from the right side; needs the factor. */
void crease_system_solve(crease_system *system, crease_height *height);
/* Solves in place for `count` further right sides of `size` numbers each. */
void crease_system_solve_many(const crease_system *system, double *sides, size_t count);
/* Effective number of free parameters, the trace of factor^-1 normal: exact for few unknowns, else
 * estimated.
 * Based on: Hutchinson. A stochastic estimator of the trace of the influence matrix for Laplacian
 * smoothing splines. 1990. */
double crease_system_freedom(crease_system *system);

#endif
