/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The plane of best fit of a neighbourhood, by principal components. */
#ifndef CREASE_DETECT_PRINCIPAL_H
#define CREASE_DETECT_PRINCIPAL_H

#include "detect/neighbourhood.h"

#include <stdbool.h>

/* Points are on a line when the spread (see eigen.h) is below: a thousand times longer than wide.
 */
static const double CREASE_LINE_SPREAD = 1e-6;

typedef struct crease_principal {
    double normal[3]; /* unit, sign arbitrary */
    double mean[3];   /* of the neighbours, in the neighbourhood's units */
    double least;     /* variance of the neighbours along the normal, in those units squared */
    double trace;     /* their variance in all directions together */
    bool degenerate;  /* the neighbours lie on a line or in a point: normal arbitrary */
} crease_principal;

void crease_principal_compute(const crease_neighbourhood *neighbourhood, crease_principal *out);

/* The share of the variance that lies along the normal: 0 for points in a plane, 1/3 for a ball.
 * Based on: Pauly, Gross, Kobbelt. Efficient simplification of point-sampled surfaces. 2002
 * (surface variation). */
double crease_principal_variation(const crease_principal *principal);

#endif
