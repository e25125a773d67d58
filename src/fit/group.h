/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Groups of points with nothing near them. */
#ifndef CREASE_FIT_GROUP_H
#define CREASE_FIT_GROUP_H

#include "base/context.h"

/* Sorts the points that are kept into cubes of this size; cubes that touch, also at a corner, are
 * one group. sizes[i]: number of points in the group of point i, 0 for points not kept.
 * O(n log n). Errors: NO_MEMORY. */
crease_status crease_group_sizes(crease_context *context, const double *points, const double *keep,
    size_t count, double cube, size_t *sizes);

#endif
