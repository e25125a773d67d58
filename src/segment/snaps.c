/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "segment/snaps.h"

#include "base/memory.h"
#include "segment/region.h"

#include <stdlib.h>

crease_status crease_snaps_begin(
    crease_context *context, crease_snaps *snaps, crease_snap_kind kind)
{
    if (snaps->count == snaps->room) {
        const size_t room = 2 * snaps->room + 16;
        struct crease_snaps_item *const items =
            crease_reallocate(context, snaps->items, room, sizeof *items);
        if (!items)
            return CREASE_ERROR_NO_MEMORY;
        snaps->items = items;
        snaps->room = room;
    }
    snaps->items[snaps->count++] =
        (struct crease_snaps_item){.kind = kind, .first = snaps->region_count};
    return CREASE_OK;
}

crease_status crease_snaps_add(crease_context *context, crease_snaps *snaps, uint32_t region)
{
    if (snaps->region_count == snaps->region_room) {
        const size_t room = 2 * snaps->region_room + 64;
        uint32_t *const regions = crease_reallocate(context, snaps->regions, room, sizeof *regions);
        if (!regions)
            return CREASE_ERROR_NO_MEMORY;
        snaps->regions = regions;
        snaps->region_room = room;
    }
    snaps->regions[snaps->region_count++] = region;
    snaps->items[snaps->count - 1].size++;
    return CREASE_OK;
}

void crease_snaps_end(crease_snaps *snaps)
{
    const struct crease_snaps_item *const last = &snaps->items[snaps->count - 1];
    if (last->size >= 2)
        return;
    snaps->region_count = last->first;
    snaps->count--;
}

void crease_snaps_clear(crease_snaps *snaps)
{
    free(snaps->items);
    free(snaps->regions);
    *snaps = (crease_snaps){0};
}

size_t crease_regions_snap_count(const crease_regions *regions)
{
    return regions->snaps.count;
}

crease_snap crease_regions_snap_at(const crease_regions *regions, size_t index)
{
    const struct crease_snaps_item *const item = &regions->snaps.items[index];
    return (crease_snap){item->kind, item->size, regions->snaps.regions + item->first};
}
