/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Which triangle is on the other side of each side of a triangle. Side k of a triangle goes from
 * its corner k to the next one; its number is 3 x triangle + k. */
#ifndef CREASE_FACETS_SIDES_H
#define CREASE_FACETS_SIDES_H

#include "facets/facets.h"

/* No other triangle, or more than one. */
#define CREASE_SIDE_NONE UINT32_MAX

/* Turns triangles that share a side so that they face the same way, and finds for each side the
 * same one of the neighbour, where it has exactly one that then runs against it. opposite:
 * triangle_count x 3. O(n log n). Errors: NO_MEMORY. */
crease_status crease_sides_find(crease_context *context, crease_facets *facets, uint32_t *opposite);

#endif
