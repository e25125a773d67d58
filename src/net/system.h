/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The normal equations of a penalised least-squares fit over the knots of a net.
 *
 * Minimised is sum_i weight_i tilt_i^2 (target_i - f(uv_i))^2 + lambda scale * bending(f) +
 * hold * tension(f), see there for the energies. `scale` makes lambda a pure number: the matrices
 * of the sum and of the bending have the same trace at lambda = 1. There may be several targets, as
 * the coordinates of a point; each has its right side and its solution.
 *
 * Unknown number i count[1] + j is control point (i, j). Few unknowns, or a narrow band of them,
 * are solved for by LAPACK, exactly; many by conjugate gradients, see net/multigrid.h. */
#ifndef CREASE_NET_SYSTEM_H
#define CREASE_NET_SYSTEM_H

#include "net/assemble.h"
#include "net/bending.h"
#include "net/multigrid.h"

typedef struct crease_system {
    size_t size, sides, count[2];
    crease_gaps gaps;
    crease_bending energy;
    crease_stencil normal;
    crease_stencil bending, tension; /* kept where there are few unknowns */
    double traces[2];                /* of bending and tension */
    double hold;                     /* weight of the tension; set by whoever solves */
    double lambda;                   /* of the factor */
    double *right;                   /* sides x size */
    double *squares;                 /* of each side: sum of weight tilt^2 target^2 */
    double *probes; /* size x (probe_count + 2): vectors that the trace is taken with; scratch */
    size_t probe_count;
    uint64_t added; /* observations so far */

    crease_stencil whole; /* band: normal + lambda scale bending + hold tension */
    size_t stride[2];     /* band: number of an unknown in it: stride[0] i + stride[1] j */
    size_t width;         /* band: diagonals below the main one, plus one */
    double *factor;       /* band: its Cholesky factor */
    double *permuted;     /* band: sides in its order; NULL where that is ours */

    crease_multigrid *multigrid; /* NULL: band */
    bool carried;                /* its coarser nets have the sum */
} crease_system;

/* Makes room for `sides` right sides. Of the height only the knots are looked at; the gaps are
 * taken over, also on failure. Errors: NO_MEMORY, CANCELLED. */
crease_status crease_system_create(crease_context *context, const crease_height *height,
    size_t sides, crease_gaps *gaps, crease_system *out);
void crease_system_free(crease_system *system);
/* Adds observations to the normal matrix and the right sides, after crease_system_clear(). Errors:
 * NO_MEMORY, CANCELLED. */
crease_status crease_system_add(crease_context *context, crease_system *system,
    const crease_height *height, const crease_observations *observations);
void crease_system_clear(crease_system *system);
/* Makes ready to solve with this lambda; *solvable: the matrix is positive definite. Errors:
 * NO_MEMORY, CANCELLED. */
crease_status crease_system_factor(
    crease_context *context, crease_system *system, double lambda, bool *solvable);
/* Solves for all right sides: sides x size. solutions: zeros, or what they are believed to be
 * about. Iterated ones are within about 1e-6 of the least sum of
 * squares, penalties included. Errors: CANCELLED. */
crease_status crease_system_solve(
    crease_context *context, crease_system *system, double *solutions);
/* The same for `count` other right sides of `size` numbers each. */
crease_status crease_system_solve_others(crease_context *context, crease_system *system,
    const double *sides, size_t count, double *solutions);
/* Effective number of free parameters, the trace of factor^-1 normal: exact for few unknowns, else
 * estimated.
 * Based on: Hutchinson. A stochastic estimator of the trace of the influence matrix for Laplacian
 * smoothing splines. 1990; for iterations with a random sign at each observation instead of at each
 * unknown, so that an error of the solution counts by its square. Errors: CANCELLED. */
crease_status crease_system_freedom(
    crease_context *context, crease_system *system, double *freedom);

#endif
