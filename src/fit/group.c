/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "fit/group.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

enum { BITS = 20 }; /* of a cube's number along an axis; one more keeps neighbours apart */

static const double MOST = (1 << BITS) - 1;

typedef struct place {
    uint64_t key; /* of the cube that holds the point */
    size_t point;
} place;

typedef struct cube {
    uint64_t key;
    size_t parent; /* of the tree that stands for the group; the root is its own */
    size_t points; /* of the group, at the root */
} cube;

static int by_key(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

static uint64_t key_of(const double *point, const double low[3], double size)
{
    uint64_t key = 0;
    for (int c = 0; c < 3; c++)
        key = key << (BITS + 1) | (uint64_t)(1.0 + fmin(MOST, (point[c] - low[c]) / size));
    return key;
}

static size_t place_all(
    const double *points, const double *keep, size_t count, double size, place *out)
{
    double low[3] = {INFINITY, INFINITY, INFINITY};
    size_t placed = 0;
    for (size_t i = 0; i < count; i++)
        for (size_t c = 0; c < 3 && keep[i] > 0.0; c++)
            low[c] = fmin(low[c], points[3 * i + c]);
    for (size_t i = 0; i < count; i++)
        if (keep[i] > 0.0)
            out[placed++] = (place){.key = key_of(points + 3 * i, low, size), .point = i};
    qsort(out, placed, sizeof *out, by_key);
    return placed;
}

static size_t collect_cubes(const place *places, size_t count, cube *out)
{
    size_t cubes = 0;
    for (size_t i = 0; i < count; i++) {
        if (cubes == 0 || out[cubes - 1].key != places[i].key) {
            out[cubes] = (cube){.key = places[i].key, .parent = cubes};
            cubes++;
        }
        out[cubes - 1].points++;
    }
    return cubes;
}

static size_t root_of(cube *cubes, size_t i)
{
    while (cubes[i].parent != i) {
        cubes[i].parent = cubes[cubes[i].parent].parent;
        i = cubes[i].parent;
    }
    return i;
}

static void unite(cube *cubes, size_t a, size_t b)
{
    const size_t x = root_of(cubes, a), y = root_of(cubes, b);
    if (x == y)
        return;
    cubes[y].parent = x;
    cubes[x].points += cubes[y].points;
}

/* With the neighbours of greater key; those of smaller key find this one. */
static void unite_neighbours(cube *cubes, size_t count, size_t i)
{
    for (int64_t dx = 0; dx <= 1; dx++)
        for (int64_t dy = -1; dy <= 1; dy++)
            for (int64_t dz = -1; dz <= 1; dz++) {
                const int64_t step =
                    dx * ((int64_t)1 << (2 * BITS + 2)) + dy * ((int64_t)1 << (BITS + 1)) + dz;
                const uint64_t key = cubes[i].key + (uint64_t)step;
                const cube *const found =
                    step > 0 ? bsearch(&key, cubes, count, sizeof *cubes, by_key) : NULL;
                if (found)
                    unite(cubes, i, (size_t)(found - cubes));
            }
}

crease_status crease_group_sizes(crease_context *context, const double *points, const double *keep,
    size_t count, double size, size_t *sizes)
{
    place *places = crease_allocate(context, count, sizeof *places);
    cube *cubes = crease_allocate(context, count, sizeof *cubes);
    const crease_status status = places && cubes ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK) {
        const size_t placed = place_all(points, keep, count, size, places);
        const size_t found = collect_cubes(places, placed, cubes);
        for (size_t i = 0; i < found; i++)
            unite_neighbours(cubes, found, i);
        for (size_t i = 0; i < count; i++)
            sizes[i] = 0;
        for (size_t i = 0, c = 0; i < placed; i++) {
            c += places[i].key != cubes[c].key;
            sizes[places[i].point] = cubes[root_of(cubes, c)].points;
        }
    }
    free(places);
    free(cubes);
    return status;
}
