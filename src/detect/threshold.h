/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The decision which points are features. */
#ifndef CREASE_DETECT_THRESHOLD_H
#define CREASE_DETECT_THRESHOLD_H

#include <stddef.h>
#include <stdint.h>

/* The bootstrap variance from which on a point of a cloud is significant: what noise alone would
 * give is taken from the variances themselves, and among the points found the expected share that
 * noise explains is below the rate. k: neighbours that the variances come from.
 * Infinite when no point is significant. O(count). */
double crease_threshold_find(const double *variance, size_t count, int k, double rate);

#endif
