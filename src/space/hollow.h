/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Where a disc in the plane may hold no point. Nearly all points of a dense cloud are far from such
 * a disc, and an outline need not look at them. */
#ifndef CREASE_SPACE_HOLLOW_H
#define CREASE_SPACE_HOLLOW_H

#include "base/context.h"

typedef enum crease_hollow {
    CREASE_HOLLOW_FAR,    /* no point that an empty disc touches is less than 2 radii away */
    CREASE_HOLLOW_NEAR,   /* no empty disc touches it */
    CREASE_HOLLOW_TOUCHED /* an empty disc may touch it */
} crease_hollow;

/* places: count x 2. out: count elements, of crease_hollow. Certain for CREASE_HOLLOW_FAR and
 * CREASE_HOLLOW_NEAR; some points are CREASE_HOLLOW_TOUCHED without need, all of them where they
 * are very sparse. O(count). Errors: NO_MEMORY. */
crease_status crease_hollow_find(
    crease_context *context, const double *places, size_t count, double radius, unsigned char *out);

#endif
