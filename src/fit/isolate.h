/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Points that stand alone, and how dense the others are. */
#ifndef CREASE_FIT_ISOLATE_H
#define CREASE_FIT_ISOLATE_H

#include "base/context.h"

/* keep[i] = 0 for a point whose eighth neighbour is four times as far away as is usual in the cloud
 * (an outlier), else 1. *spacing: mean distance of neighbouring points, sqrt(area / count). */
crease_status crease_isolate(
    crease_context *context, const double *points, size_t count, double *keep, double *spacing);

#endif
