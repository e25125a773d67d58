/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Morton order: points sorted along a Z-shaped curve that fills space, so that points near each
 * other in space are mostly near each other in memory. */
#ifndef CREASE_SPACE_MORTON_H
#define CREASE_SPACE_MORTON_H

#include "base/context.h"

/* The cube whose cells are numbered along the curve: low is that of halved points. */
typedef struct crease_morton_frame {
    double low[3], scale;
} crease_morton_frame;

/* Around points between these lowest and highest coordinates. */
crease_morton_frame crease_morton_frame_of(const double low[3], const double high[3]);
/* The key of a point, 63 bits. */
uint64_t crease_morton_key(const crease_morton_frame *frame, const double point[3]);

/* Sorts finite points along the curve: order[i] is the original index of the i-th point, keys[i]
 * its key of 63 bits (21 for each axis, cells are cubes). Equal keys stay in ascending index order,
 * so the result is unique. Both arrays hold count elements. Threaded, O(n).
 * Errors: NO_MEMORY, CANCELLED. */
crease_status crease_morton_sort(
    crease_context *context, const double *points, size_t count, uint64_t *keys, uint32_t *order);

#endif
