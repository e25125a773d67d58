/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The points that a model is fitted to: some members of a region, with normals that all lie on the
 * same side, relative to an origin among them, so that fits far from the cloud's origin lose no
 * digits. */
#ifndef CREASE_PRIMITIVE_SAMPLE_H
#define CREASE_PRIMITIVE_SAMPLE_H

#include <stddef.h>

/* Most points of a sample. */
enum { CREASE_SAMPLE_POINTS = 20000 };

typedef struct crease_sample {
    size_t count;
    double origin[3];
    double *points;  /* count x 3, relative to the origin */
    double *normals; /* count x 3 */
} crease_sample;

/* Mean of the sample's points, relative to its origin. */
void crease_sample_mean(const crease_sample *sample, double mean[3]);
/* Point i relative to a place that is itself relative to the origin. */
void crease_sample_from(
    const crease_sample *sample, size_t i, const double place[3], double out[3]);
/* Largest distance of a point from the place. */
double crease_sample_reach(const crease_sample *sample, const double place[3]);

#endif
