/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What regions are found from: the points in Morton order, their neighbours, the noise. */
#ifndef CREASE_SEGMENT_SURROUNDINGS_H
#define CREASE_SEGMENT_SURROUNDINGS_H

#include "segment/region.h"

/* Sets the points, their neighbours and noise, or takes these from what the context keeps, and
 * marks rounded edges. Errors: NO_MEMORY, CANCELLED, those of `find`. */
crease_status crease_regions_surround(crease_context *context, crease_regions *regions,
    const crease_cloud *cloud, crease_surroundings_find *find, void *user);
/* Copies them from other regions of the same cloud, with the labels. Errors: NO_MEMORY. */
crease_status crease_regions_surround_like(
    crease_context *context, crease_regions *regions, const crease_regions *from);
/* Finds them in this process. */
crease_surroundings_find crease_surroundings_here;

#endif
