/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The borders of points that lie on a surface, outer ones and those of holes: what a disc touches
 * that is rolled along them in the surface. Two points follow each other when a disc through both
 * holds no point, so they are sides of the alpha shape.
 *
 * Based on: Edelsbrunner, Kirkpatrick, Seidel. On the shape of a set of points in the plane. 1983.
 */
#ifndef CREASE_SPACE_OUTLINE_H
#define CREASE_SPACE_OUTLINE_H

#include "base/context.h"

/* Closed loops of points, the surface on their left as seen from where the normals point: loop
 * number i is points[first[i]] .. points[first[i + 1] - 1]. */
typedef struct crease_outline {
    size_t loop_count;
    size_t *first;    /* loop_count + 1 */
    uint32_t *points; /* indices */
} crease_outline;

/* normals: unit vectors, of which neighbours agree. touched: of each point, whether the disc may
 * touch it; NULL: any. The others are only in its way. radius: of the disc; holes and bays that it
 * does not fit into are none. Lines of single points that stand out of the rest are left out, as
 * are single points and pairs. O(n log n), threaded. Errors: NO_MEMORY, CANCELLED. */
crease_status crease_outline_find(crease_context *context, const double *points,
    const double *normals, size_t count, const bool *touched, double radius, crease_outline *out);
/* The same of points in a plane, count x 2, seen from above. Only those near the borders are looked
 * at: O(count) beside O(n log n) for these n. */
crease_status crease_outline_find_flat(crease_context *context, const double *places, size_t count,
    double radius, crease_outline *out);
void crease_outline_clear(crease_outline *outline);

#endif
