/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Where the crease lines of a draft truly are. */
#ifndef CREASE_FIT_LINES_H
#define CREASE_FIT_LINES_H

#include "fit/draft.h"

/* Moves all crease lines across themselves and, when `turn`, turns the frame about z, as long as
 * that brings the points nearer to the sheet. The draft must be fitted, and is again afterwards. */
crease_status crease_lines_refine(
    crease_context *context, crease_draft *draft, int steps, bool turn);

#endif
