/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Regions between two planes that may be parts of one fillet, or of nothing but a sharp edge. */
#ifndef CREASE_SEGMENT_BLEND_H
#define CREASE_SEGMENT_BLEND_H

#include "primitive/rolling.h"
#include "segment/segmentation.h"

enum { CREASE_BLEND_PARTS = 8 };

typedef struct crease_blend {
    int32_t planes[2], parts[CREASE_BLEND_PARTS]; /* regions */
    int count;                                    /* of parts */
    crease_wedge wedge;
    double low, high; /* along the edge */
    double reach;     /* away from it, of the points that are compared */
    double radius;    /* 0: a sharp edge */
    double gain;      /* above 0: worth it */
} crease_blend;

/* Sets all but regions: the radius by which the points fit best, and what is gained against the
 * regions as they are. fresh: the planes are fitted again without what would be rounded. */
crease_status crease_blend_judge(
    crease_segmentation *seg, crease_fitter *fitter, bool fresh, crease_blend *blend);
/* Fits the plane of a region again, to members next to no other region and, given a blend, not in
 * its arc. */
crease_status crease_blend_refit(crease_segmentation *seg, crease_fitter *fitter, int32_t region,
    const crease_blend *without, crease_model *out);
/* Whether the place is where the blend's points are compared. */
bool crease_blend_holds(const crease_blend *blend, const double place[3], crease_section *out);

#endif
