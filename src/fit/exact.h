/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Data without noise that one sheet of few control points goes through. */
#ifndef CREASE_FIT_EXACT_H
#define CREASE_FIT_EXACT_H

#include "averaging/orient.h"
#include "net/samples.h"

/* Looks for a frame, whichever way it is turned in space, in which the points are the height of a
 * sheet without simple knots, with at most one crease line: a polynomial, or two that meet in a
 * line. From some frames to begin with (that of `oriented` and the axes as they are, tilted about
 * the edge and across it) Gauss and Newton's method goes to the nearest one; it is taken when what
 * remains is rounding. *found is false, and nothing else changed, where there is none. Of the
 * layout only the order is looked at; then it is that of the sheet, the ends of the domain apart.
 * lines: the most that there may be. At most 600 of the samples are looked at. Errors: NO_MEMORY,
 * CANCELLED.
 * Based on: Golub, Pereyra. The differentiation of pseudo-inverses and nonlinear least squares
 * problems whose variables separate. 1973. */
crease_status crease_exact_find(crease_context *context, const crease_samples *samples,
    const crease_oriented *oriented, size_t lines, crease_frame *frame, crease_layout *layout,
    bool *found);

#endif
