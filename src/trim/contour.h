/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Smooth lines along the ragged border of points: straight where they may be, with sharp corners,
 * and through the outermost points rather than their mean. */
#ifndef CREASE_TRIM_CONTOUR_H
#define CREASE_TRIM_CONTOUR_H

#include "base/context.h"

/* Points of the border in order, the surface on their left as seen from where the normals point. */
typedef struct crease_rag {
    size_t count;
    const double *points, *normals; /* count x 3 */
    bool closed;                    /* the first follows the last */
    double spacing;
} crease_rag;

/* A smooth line; its points are half a spacing apart or less. */
typedef struct crease_stretch {
    size_t count, room;
    double *points;
} crease_stretch;

/* One after the other, each beginning at the corner where the one before ends. Closed: the last
 * ends where the first begins, which is no corner when there is one only. */
typedef struct crease_contour {
    bool closed;
    size_t count;
    crease_stretch *items;
} crease_contour;

/* Errors: NO_MEMORY. */
crease_status crease_contour_fit(
    crease_context *context, const crease_rag *rag, crease_contour *out);
void crease_contour_clear(crease_contour *contour);

#endif
