/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The surface beside one point, from those neighbours that lie on its side of any edge. */
#ifndef CREASE_NOISE_FOOTING_H
#define CREASE_NOISE_FOOTING_H

#include "base/context.h"

enum { CREASE_MOST_FOOTING = 256 };

/* A cloud as the points see it. */
typedef struct crease_surroundings {
    const double *points;  /* count x 3 */
    const double *normals; /* count x 3, unit, sign arbitrary, one-sided */
    const crease_neighbours *neighbours;
    const uint8_t *outliers; /* by point: 1 for those that no surface is fitted to; or NULL */
    double spacing, sigma;
    double least_cosine; /* of the angle between normals of one side */
} crease_surroundings;

typedef struct crease_footing {
    double foot[3];   /* the surface's nearest place, to first order */
    double normal[3]; /* unit, on the side of the one given */
    double distance;  /* of the point above the surface along that normal */
    double error;     /* standard error of the foot along the normal */
    double sigma;     /* the neighbours' distances from the surface, at least the cloud's sigma */
} crease_footing;

/* Fits a plane, or a quadric where it explains significantly more, to the neighbours whose normals
 * agree with the given one and that lie about one surface, the point itself left out, and drops the
 * perpendicular on it. Points are taken for the point's own surface rather than for an opposite
 * wall when a quarter of them lies about as high as the point. False when there are too few, or
 * they are so far that the surface beside the point is known less well than the point itself. O(k).
 */
bool crease_footing_fit(
    const crease_surroundings *around, size_t point, const double normal[3], crease_footing *out);

#endif
