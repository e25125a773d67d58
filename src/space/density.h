/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* How far apart the points of a surface are: the side of a square as large as the area for one of
 * them, from the disc that a point's nearest neighbours fill. */
#ifndef CREASE_SPACE_DENSITY_H
#define CREASE_SPACE_DENSITY_H

#include "base/context.h"

/* For each of the shares, 0..1: the spacing that this share of the points has at most. From a
 * sample of the points. O(n log n). Errors: NO_MEMORY, CANCELLED. */
crease_status crease_density_spacings(crease_context *context, const double *points, size_t count,
    const double *shares, size_t share_count, double *spacings);

#endif
