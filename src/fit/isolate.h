/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Points that stand alone, singly or in small groups, and how dense the others are. */
#ifndef CREASE_FIT_ISOLATE_H
#define CREASE_FIT_ISOLATE_H

#include "base/context.h"

/* keep[i] = 0 for an outlier, else 1: a point whose eighth neighbour is four times as far away as
 * is usual in the cloud, or one of a group of less than sqrt(count) points with nothing around it.
 * *spacing: mean distance of neighbouring points, sqrt(area / count). */
crease_status crease_isolate(
    crease_context *context, const double *points, size_t count, double *keep, double *spacing);

#endif
