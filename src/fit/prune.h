/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Removes what a draft does not need. */
#ifndef CREASE_FIT_PRUNE_H
#define CREASE_FIT_PRUNE_H

#include "fit/explore.h"

/* Removes simple knots and lines without which the score is lower, lines that simple knots replace
 * as well, one by one, then all but the most telling ones together, then those that are no creases
 * where points would show it (see fit/sharpness.h); two lines that are close together become one
 * when that does as well. Compares vertical distances: the draft must not be orthogonal. turn: the
 * frame may be turned about z. */
crease_status crease_prune(
    crease_context *context, crease_draft *draft, const crease_bounds *bounds, bool turn);

#endif
