/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The line through points in order that has no more freedom than they ask for: straight, a uniform
 * cubic B-spline, or, when closed, a sum of harmonics. Points outside it weigh more than those
 * inside (expectiles), so that it runs along the outermost.
 *
 * Based on: Newey, Powell. Asymmetric least squares estimation and testing. 1987; Schwarz.
 * Estimating the dimension of a model. 1978. */
#ifndef CREASE_TRIM_SMOOTHING_H
#define CREASE_TRIM_SMOOTHING_H

#include "base/context.h"

/* The points, the directions in which their outside lies, and where they are along the border. */
typedef struct crease_strip {
    size_t count;
    const double *points, *outward; /* count x 3 */
    const double *at;               /* ascending */
    double begin, length;           /* of the line; closed: once round */
    bool closed;
    double spacing;
} crease_strip;

typedef struct crease_smooth {
    bool closed;
    double begin, length;
    size_t spans, size;   /* spans, or harmonics; 0: a straight line. size: coefficients */
    double *coefficients; /* size x 3 */
    double squares;       /* of the distances of the points, weighted */
    double freedom;       /* parameters */
} crease_smooth;

/* Errors: NO_MEMORY. */
crease_status crease_smooth_fit(
    crease_context *context, const crease_strip *strip, crease_smooth *out);
/* A place of the line; before its begin and after its end it goes on straight. */
void crease_smooth_at(const crease_smooth *line, double at, double place[3]);
/* What is least for the right amount of freedom. */
double crease_smooth_cost(double squares, double freedom, size_t count, double spacing);
void crease_smooth_clear(crease_smooth *line);

#endif
