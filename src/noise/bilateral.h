/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Normals with less noise, edges kept. */
#ifndef CREASE_NOISE_BILATERAL_H
#define CREASE_NOISE_BILATERAL_H

#include "base/context.h"

/* What is averaged. */
typedef struct crease_bilateral {
    const double *points; /* count x 3 */
    const crease_neighbours *neighbours;
    double least_cosine; /* of the angle between normals that are averaged */
} crease_bilateral;

/* The weighted mean of each point's normal and those of its neighbours, by distance and by angle.
 * from, to: count x 3 unit normals; their signs do not matter, those of from are kept. */
crease_status crease_bilateral_smooth(
    crease_context *context, const crease_bilateral *filter, const double *from, double *to);

#endif
