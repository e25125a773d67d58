/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* One net of a multigrid solver. */
#ifndef CREASE_NET_LEVEL_H
#define CREASE_NET_LEVEL_H

#include "net/relax.h"

typedef struct crease_level {
    size_t size, count[2];
    crease_height height; /* the knots; no coefficients */
    crease_bending energy;
    const crease_stencil *normal; /* sum over the points: `own`, or that of the finest net */
    crease_stencil own, whole;    /* whole: normal and energies */
    crease_relaxation relaxation;
    double largest;                   /* eigenvalue of the relaxed matrix */
    size_t *first[2];                 /* what the next coarser net becomes in this one, see */
    double *weights[2];               /* crease_knots_prolong() */
    double *b, *x, *r, *z, *p, *half; /* vectors of the cycle; half: of one direction's transfer */
} crease_level;

/* Errors: NO_MEMORY. */
crease_status crease_level_create(crease_context *context, const crease_height *height,
    const crease_gaps *gaps, crease_level *out);
/* The net without every other simple knot, along the direction in which it is finer or along both;
 * *coarser is false, and nothing made, where no simple knot is left. Errors: NO_MEMORY. */
crease_status crease_level_coarser(crease_context *context, crease_level *level,
    const crease_gaps *gaps, crease_level *out, bool *coarser);
void crease_level_free(crease_level *level);
/* The normal matrix of the coarser level from that of the finer. Errors: NO_MEMORY, CANCELLED. */
crease_status crease_level_carry(
    crease_context *context, const crease_level *fine, crease_level *coarse);
/* The whole matrix and the relaxation. Errors: CANCELLED. */
crease_status crease_level_weigh(
    crease_context *context, crease_level *level, double weight, double tension);
/* b of the coarse level: the transpose of the prolongation, of a vector of the fine one. */
void crease_level_restrict(const crease_level *fine, crease_level *coarse, const double *vector);
/* vector over the fine level: x of the coarse one. */
void crease_level_prolong(const crease_level *fine, const crease_level *coarse, double *vector);

#endif
