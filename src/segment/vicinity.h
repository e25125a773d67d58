/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A region with the points around it, apart from the rest, to try other models on: how well would
 * all of them be explained if each chose its label anew? */
#ifndef CREASE_SEGMENT_VICINITY_H
#define CREASE_SEGMENT_VICINITY_H

#include "segment/segmentation.h"

typedef struct crease_vicinity {
    const crease_segmentation *seg;
    int32_t region;
    size_t count; /* points; those of the region come first */
    uint32_t *points;
    int32_t *near;     /* count x seg->links neighbours: their place in points, or, outside, -2 less
                          their label */
    int32_t *labels;   /* as they are */
    int32_t *trial;    /* as they would be */
    double *elsewhere; /* twice the least price under the surrounding regions' models */
    uint32_t *chosen;  /* room for a list of points */
    uint32_t *keys;    /* hash table of points, and their places */
    int32_t *places;
    size_t slots;
} crease_vicinity;

/* The region and `rings` rings of neighbours around it. */
crease_status crease_vicinity_create(
    crease_segmentation *seg, size_t region, int rings, crease_vicinity *out);
void crease_vicinity_clear(crease_vicinity *vicinity);
/* Twice the price of all points, links aside, after some rounds of choosing labels, beginning with
 * `trial`. The region's label stands for the first model, the label seg->region_count for the
 * second (NULL: not there). */
double crease_vicinity_energy(
    crease_vicinity *vicinity, const crease_model *first, const crease_model *second);

#endif
