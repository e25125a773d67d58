/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The sum over the points of a least-squares problem over the knots of a net. */
#ifndef CREASE_NET_ASSEMBLE_H
#define CREASE_NET_ASSEMBLE_H

#include "net/height.h"
#include "net/stencil.h"

/* Places on the net and what is observed there, `sides` numbers at each. An observation counts
 * weight tilt^2 times. */
typedef struct crease_observations {
    size_t count, sides;
    const double *uv;     /* count x 2 */
    const double *weight; /* count; those with 0 are left out */
    const double *tilt;   /* count; NULL: all 1 */
    const double *target; /* count x sides */
    size_t probes;        /* right sides besides: root weight tilt, with random signs */
    uint64_t first;       /* number of the first observation, for its signs */
} crease_observations;

/* Adds the normal matrix, and the right sides: (sides + probes) x (count[0]
 * count[1]). Of the height only the
 * knots are looked at. A file in pieces is added piece by piece. Every number is a sum in one order
 * for any number of threads. Memory: 8 bytes per observation and per span of the net. Errors:
 * NO_MEMORY, CANCELLED. */
crease_status crease_assemble(crease_context *context, const crease_height *height,
    const crease_observations *observations, crease_stencil *normal, double *right);

#endif
