/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Points at the same place are one. */
#ifndef CREASE_CLOUD_WELD_H
#define CREASE_CLOUD_WELD_H

#include "crease/crease.h"

/* Leaves each place of count x 3 coordinates once, in the order in which they come first.
 * numbers: count, which place each point was. *left: how many there are. Expected O(count).
 * Errors: NO_MEMORY. */
crease_status crease_weld(
    crease_context *context, double *points, size_t count, uint32_t *numbers, size_t *left);

#endif
