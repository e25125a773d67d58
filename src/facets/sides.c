/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "facets/sides.h"

#include "base/memory.h"

#include <stdlib.h>

typedef struct side {
    uint32_t low, high; /* its vertices */
    uint32_t number;
} side;

static int by_vertices(const void *a, const void *b)
{
    const side *const p = a, *const q = b;
    if (p->low != q->low)
        return p->low < q->low ? -1 : 1;
    if (p->high != q->high)
        return p->high < q->high ? -1 : 1;
    return p->number < q->number ? -1 : p->number > q->number;
}

static uint32_t from(const crease_facets *facets, uint32_t number)
{
    return facets->corners[number];
}

static uint32_t to(const crease_facets *facets, uint32_t number)
{
    return facets->corners[number % 3 == 2 ? number - 2 : number + 1];
}

static void sort_sides(const crease_facets *facets, side *sides)
{
    for (uint32_t i = 0; i < 3 * facets->triangle_count; i++) {
        const uint32_t a = from(facets, i), b = to(facets, i);
        sides[i] = (side){a < b ? a : b, a < b ? b : a, i};
    }
    qsort(sides, 3 * facets->triangle_count, sizeof *sides, by_vertices);
}

static void match(const crease_facets *facets, side *sides, uint32_t *opposite)
{
    const size_t count = 3 * facets->triangle_count;
    sort_sides(facets, sides);
    for (size_t begin = 0, end; begin < count; begin = end) {
        for (end = begin + 1; end < count && sides[end].low == sides[begin].low &&
             sides[end].high == sides[begin].high;)
            end++;
        for (size_t i = begin; i < end; i++)
            opposite[sides[i].number] =
                end - begin == 2 ? sides[2 * begin + 1 - i].number : CREASE_SIDE_NONE;
    }
}

static bool runs_along(const crease_facets *facets, uint32_t one, uint32_t other)
{
    return from(facets, one) == from(facets, other);
}

/* From the first triangle of each piece on, all others that hang together with it. */
static void find_turned(const crease_facets *facets, const uint32_t *opposite, uint32_t *stack,
    bool *seen, bool *turned)
{
    for (uint32_t first = 0; first < facets->triangle_count; first++) {
        size_t height = 0;
        if (!seen[first])
            stack[height++] = first;
        seen[first] = true;
        while (height) {
            const uint32_t triangle = stack[--height];
            for (uint32_t i = 3 * triangle; i < 3 * triangle + 3; i++) {
                const uint32_t other = opposite[i] == CREASE_SIDE_NONE ? first : opposite[i] / 3;
                if (seen[other])
                    continue;
                seen[other] = true;
                turned[other] = turned[triangle] != runs_along(facets, i, opposite[i]);
                stack[height++] = other;
            }
        }
    }
}

static bool turn(crease_facets *facets, const bool *turned)
{
    bool any = false;
    for (size_t i = 0; i < facets->triangle_count; i++)
        if (turned[i]) {
            const uint32_t kept = facets->corners[3 * i + 1];
            facets->corners[3 * i + 1] = facets->corners[3 * i + 2];
            facets->corners[3 * i + 2] = kept;
            any = true;
        }
    return any;
}

static void unlink_contrary(const crease_facets *facets, uint32_t *opposite)
{
    for (uint32_t i = 0; i < 3 * facets->triangle_count; i++)
        if (opposite[i] != CREASE_SIDE_NONE && runs_along(facets, i, opposite[i])) {
            opposite[opposite[i]] = CREASE_SIDE_NONE;
            opposite[i] = CREASE_SIDE_NONE;
        }
}

crease_status crease_sides_find(crease_context *context, crease_facets *facets, uint32_t *opposite)
{
    const size_t count = facets->triangle_count;
    side *const sides = crease_allocate(context, 3 * count, sizeof *sides);
    uint32_t *const stack = crease_allocate(context, count, sizeof *stack);
    bool *const seen = crease_allocate(context, count, sizeof *seen);
    bool *const turned = crease_allocate(context, count, sizeof *turned);
    const bool room = sides && stack && seen && turned;
    if (room) {
        match(facets, sides, opposite);
        find_turned(facets, opposite, stack, seen, turned);
        if (turn(facets, turned))
            match(facets, sides, opposite);
        unlink_contrary(facets, opposite);
    }
    free(sides);
    free(stack);
    free(seen);
    free(turned);
    return room ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
}
