/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The list of what was snapped. */
#ifndef CREASE_SEGMENT_SNAPS_H
#define CREASE_SEGMENT_SNAPS_H

#include "base/context.h"

#include <stdint.h>

typedef struct crease_snaps {
    size_t count, room;
    struct crease_snaps_item {
        crease_snap_kind kind;
        size_t first, size;
    } * items;
    size_t region_count, region_room;
    uint32_t *regions; /* of all items, one after the other */
} crease_snaps;

/* Opens an item, adds a region to it, and closes it; one of fewer than two regions vanishes. */
crease_status crease_snaps_begin(
    crease_context *context, crease_snaps *snaps, crease_snap_kind kind);
crease_status crease_snaps_add(crease_context *context, crease_snaps *snaps, uint32_t region);
void crease_snaps_end(crease_snaps *snaps);
void crease_snaps_clear(crease_snaps *snaps);

#endif
