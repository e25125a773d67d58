/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The points of a cloud beside its rounded edges, as a cloud of its own: regions are found there,
 * and then continued up to the edges that the scanner has taken away. */
#ifndef CREASE_SEGMENT_EXCERPT_H
#define CREASE_SEGMENT_EXCERPT_H

#include "segment/segmentation.h"
#include "space/neighbours.h"

typedef struct crease_excerpt {
    size_t count;
    uint32_t *places; /* positions in the whole cloud, ascending */
    double *points;
    crease_neighbours *neighbours;
    crease_noise noise; /* normals and scores of the whole cloud's */
    int32_t *labels;    /* not yet anything */
} crease_excerpt;

/* Takes the points that are not to be skipped. Free it, whatever the status. */
crease_status crease_excerpt_take(crease_context *context, const double *points, size_t count,
    const crease_noise *noise, const uint8_t *skipped, crease_excerpt *out);
/* Carries the labels of the excerpt over to the `count` points of the whole; those skipped get that
 * of the nearest of the surfaces around them, if one is within reach. */
crease_status crease_excerpt_spread(crease_context *context, const crease_excerpt *excerpt,
    const crease_model *models, const double *points, size_t count, int32_t *labels);
void crease_excerpt_clear(crease_excerpt *excerpt);

#endif
