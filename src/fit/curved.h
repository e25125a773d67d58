/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Sheets with curved creases, and folded ones: knot lines follow the creases that the points'
 * regions have between them, and all three coordinates are fitted. */
#ifndef CREASE_FIT_CURVED_H
#define CREASE_FIT_CURVED_H

#include "fit/straight.h"
#include "spline/sheet.h"

/* A surface with its lines, no deviations yet, when the cloud's creases run side by side from
 * border to border and the surface follows the points as closely as their noise lets it; else *out
 * is NULL, or when straight lines in a height field will do: found tells of the creases. tolerance:
 * refine until the rms deviation is below; 0: until only noise is left. Deterministic; O(n log n).
 * Errors: NO_MEMORY, CANCELLED. */
crease_status crease_curved_fit(crease_context *context, const crease_cloud *cloud,
    const crease_sheet_options *options, crease_straightness *found, crease_sheet **out);

#endif
