/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Which of two sheets of the same points is the better one. */
#ifndef CREASE_FIT_BETTER_H
#define CREASE_FIT_BETTER_H

#include "spline/sheet.h"

/* Whether a height field, with z its direction, is better than a curved sheet: when it explains the
 * points better for the control points that it takes (see fit/draft.h), or about as well and the
 * curved sheet turns over somewhere, which the points, seen along z, do not. Both have their
 * points. spacing: of the points. O(points). */
bool crease_better_height(
    const crease_sheet *height, const crease_sheet *curved, const double z[3], double spacing);

#endif
