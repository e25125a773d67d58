/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "cloud/weld.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

/* The bits of the coordinates, -0 as 0. */
static void key_of(const double point[3], uint64_t key[3])
{
    for (int c = 0; c < 3; c++) {
        const double value = point[c] + 0.0;
        memcpy(&key[c], &value, sizeof value);
    }
}

static uint64_t hash(const uint64_t key[3])
{
    uint64_t mixed = 0;
    for (int c = 0; c < 3; c++) {
        mixed = (mixed ^ key[c]) * UINT64_C(0x9e3779b97f4a7c15);
        mixed ^= mixed >> 29;
    }
    return mixed * UINT64_C(0xbf58476d1ce4e5b9) >> 20;
}

/* The place of the point in the table: its own, or the free one where it belongs. */
static size_t find_slot(
    const double *points, const uint32_t *slots, size_t mask, const uint64_t key[3])
{
    size_t slot = (size_t)hash(key) & mask;
    for (; slots[slot]; slot = (slot + 1) & mask) {
        uint64_t other[3];
        key_of(points + 3 * (size_t)(slots[slot] - 1), other);
        if (memcmp(other, key, sizeof other) == 0)
            break;
    }
    return slot;
}

crease_status crease_weld(
    crease_context *context, double *points, size_t count, uint32_t *numbers, size_t *left)
{
    size_t size = 16;
    while (size < 2 * count)
        size *= 2;
    uint32_t *const slots = crease_allocate(context, size, sizeof *slots);
    if (!slots)
        return CREASE_ERROR_NO_MEMORY;
    uint32_t places = 0;
    for (size_t i = 0; i < count; i++) {
        uint64_t key[3];
        key_of(points + 3 * i, key);
        const size_t slot = find_slot(points, slots, size - 1, key);
        if (!slots[slot]) {
            memmove(points + 3 * (size_t)places, points + 3 * i, 3 * sizeof *points);
            slots[slot] = ++places;
        }
        numbers[i] = slots[slot] - 1;
    }
    free(slots);
    *left = places;
    return CREASE_OK;
}
