/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The closest places of a height field. */
#ifndef CREASE_FIT_CLOSEST_H
#define CREASE_FIT_CLOSEST_H

#include "net/height.h"

/* A height field made ready to find what is closest on it. */
typedef struct crease_closest crease_closest;

/* The height is that of the surface in the frame; all are kept, not copied. Memory: 120 bytes for
 * each cell of the net. Threaded. Errors: NO_MEMORY, CANCELLED. */
crease_status crease_closest_create(crease_context *context, const crease_height *height,
    const crease_layout *layout, const crease_frame *frame, const crease_surface *surface,
    crease_closest **out);
void crease_closest_free(crease_closest *closest);
/* What crease_surface_project() finds, for a surface that is a height over its parameters, sooner.
 * Newton's method goes from straight below a point to a foot. Nothing is closer than that when the
 * squared distance is convex wherever something closer could be, which is told from bounds of the
 * slopes and second derivatives in the cells around; all other points, such as those
 * beside a crease or the border, are left to crease_surface_project(). About 1 microsecond for each
 * point. Threaded. Errors: VALUE, NO_MEMORY, CANCELLED. */
crease_status crease_closest_feet(crease_context *context, const crease_closest *closest,
    const double *points, size_t count, crease_foot *feet);

#endif
