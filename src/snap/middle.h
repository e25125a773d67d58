/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What tells where a mirror plane would be: two places that may be each other's image, or one that
 * may be its own. */
#ifndef CREASE_SNAP_MIDDLE_H
#define CREASE_SNAP_MIDDLE_H

#include "snap/place.h"

enum { CREASE_MOST_PLACES_ACROSS = 60 };

/* Two places, or twice the same: the mirror plane between them is a linear function of theirs. */
typedef struct crease_middle {
    size_t place[2];
    double row[2][CREASE_PLACE_COORDINATES];
    double across[3]; /* not zero: axes that must not be apart this way either */
    double at, variance;
} crease_middle;

/* All zero is none; to be freed: items. */
typedef struct crease_middles {
    crease_middle *items;
    size_t count, room;
} crease_middles;

crease_status crease_middles_add(
    crease_context *context, crease_middles *middles, const crease_middle *middle);
/* The middles of mirrors at right angles to `normal`, by where they are, in place of those that
 * were there, and how many places a mirror would move or turn; no middles where these are more than
 * CREASE_MOST_PLACES_ACROSS. O(places squared). */
crease_status crease_middles_find(const crease_snapping *all, const crease_place *places,
    size_t count, const bool *excluded, const double normal[3], crease_middles *out,
    size_t *across);

#endif
