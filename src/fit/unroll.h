/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Points of a patch laid out in the plane, whatever way it is bent or folded in space. */
#ifndef CREASE_FIT_UNROLL_H
#define CREASE_FIT_UNROLL_H

#include "base/context.h"

/* Gives every point two coordinates, so that distances in the plane are nearly those along the
 * surface, by way of neighbouring points; what is not linked to the largest connected part keeps
 * keep[i] = 0, all others keep what they had. plane: count x 2. Turned, moved or mirrored points
 * get the same plane, itself turned or mirrored at most. O(n log n).
 * Based on: de Silva, Tenenbaum. Sparse multidimensional scaling using landmark points. 2004;
 * Tenenbaum, de Silva, Langford. A global geometric framework for nonlinear dimensionality
 * reduction. 2000. Errors: DEGENERATE (the points have no extent in two directions), NO_MEMORY,
 * CANCELLED. */
crease_status crease_unroll(
    crease_context *context, const double *points, size_t count, double *keep, double *plane);

#endif
