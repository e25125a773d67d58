/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Step 11 of Algorithm 1: the height of the surface over every data point. */
#ifndef CREASE_AVERAGING_PROJECT_H
#define CREASE_AVERAGING_PROJECT_H

#include "base/context.h"

/* Replaces z of count points (local coordinates) by that of the surface over the same x and y;
 * where the surface ends before, by that of its nearest border. The surface's net must be regular:
 * x of its control points depends on one index only and never falls along it, y on the other
 * (`transposed`: x on the second). */
crease_status crease_project_heights(crease_context *context, const crease_surface *surface,
    bool transposed, double *points, size_t count);

#endif
