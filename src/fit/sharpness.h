/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Whether a height bends at a line more than it bends beside it. */
#ifndef CREASE_FIT_SHARPNESS_H
#define CREASE_FIT_SHARPNESS_H

#include "fit/draft.h"

/* Of a line of a draft that is fitted: false where its bend, the mean over its course where points
 * are, is no more than what the smooth pieces beside it bend by within four spacings. Such a
 * line may be but a place for three more knots. O(1). */
bool crease_sharpness_is_crease(const crease_draft *draft, int direction, size_t line);

#endif
