/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The plane in square cells of an eighth of the radius, a bit for each. A cell that has a point
 * blocks all cells that are so near that a disc around any of their places would hold the point.
 * The other cells may hold the centre of an empty disc, so points as far as a radius from them may
 * be touched. Every step widens a map by the cells around each of its own. */
#include "space/hollow.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FINE = 8, MARGIN = FINE + 2, MOST_REACH = 2 * FINE + 1, WORD = 64 };

static const double MOST_CELLS = 256.0; /* for each point */

struct map {
    size_t rows, words; /* of a row */
    uint64_t *bits;
};

/* The cells from -width[k] to width[k] in the rows k before and k after, for k up to reach. */
struct shape {
    size_t reach, width[MOST_REACH + 1];
};

struct plane {
    double low[2], cell;
    size_t size[2]; /* cells along x and y */
};

/* Cells less than `most` from each other, measured between their farthest places (grow = 1) or
 * nearest (grow = -1), in cells. */
static struct shape shape_of(int grow, long most)
{
    struct shape out = {.reach = 0};
    for (long k = 0; k <= MOST_REACH; k++) {
        const long across = k + grow > 0 ? k + grow : 0;
        for (long w = 0; w <= MOST_REACH; w++) {
            const long along = w + grow > 0 ? w + grow : 0;
            if (across * across + along * along >= most * most + (grow < 0))
                break;
            out.width[k] = (size_t)w;
            out.reach = (size_t)k;
        }
    }
    return out;
}

/* ------------------------------------------------------------------------------------ maps -- */

static bool make_map(crease_context *context, const struct plane *plane, struct map *out)
{
    out->rows = plane->size[1];
    out->words = plane->size[0] / WORD + 1;
    out->bits = crease_allocate(context, out->rows * out->words, sizeof *out->bits);
    return out->bits;
}

static bool is_set(const struct map *map, const size_t cell[2])
{
    return map->bits[cell[1] * map->words + cell[0] / WORD] >> cell[0] % WORD & 1;
}

static void set(struct map *map, const size_t cell[2])
{
    map->bits[cell[1] * map->words + cell[0] / WORD] |= (uint64_t)1 << cell[0] % WORD;
}

/* Adds the cells beside those of a row. */
static void widen_row(uint64_t *row, size_t words)
{
    uint64_t before = 0; /* the word before, as it was */
    for (size_t i = 0; i < words; i++) {
        const uint64_t here = row[i], after = i + 1 < words ? row[i + 1] : 0;
        row[i] = here | here << 1 | before >> (WORD - 1) | here >> 1 | after << (WORD - 1);
        before = here;
    }
}

static void add_row(struct map *map, size_t row, const uint64_t *bits)
{
    for (size_t i = 0; i < map->words; i++)
        map->bits[row * map->words + i] |= bits[i];
}

/* Adds to *out the shape around each cell of a map. row: room for one. The narrowest rows are those
 * farthest away. */
static void spread(
    const struct map *from, const struct shape *shape, uint64_t *row, struct map *out)
{
    for (size_t y = 0; y < from->rows; y++) {
        memcpy(row, from->bits + y * from->words, from->words * sizeof *row);
        size_t width = 0;
        for (size_t k = shape->reach + 1; k-- > 0;) {
            for (; width < shape->width[k]; width++)
                widen_row(row, from->words);
            if (y + k < out->rows)
                add_row(out, y + k, row);
            if (k > 0 && y >= k)
                add_row(out, y - k, row);
        }
    }
}

static void invert(struct map *map)
{
    for (size_t i = 0; i < map->rows * map->words; i++)
        map->bits[i] = ~map->bits[i];
}

/* ---------------------------------------------------------------------------------- points -- */

/* Beyond the points there is room for a disc on all sides. False where they are too sparse. */
static bool lay_out(const double *places, size_t count, double radius, struct plane *out)
{
    double high[2] = {-INFINITY, -INFINITY}, cells[2];
    out->low[0] = out->low[1] = INFINITY;
    for (size_t i = 0; i < 2 * count; i++) {
        out->low[i % 2] = fmin(out->low[i % 2], places[i]);
        high[i % 2] = fmax(high[i % 2], places[i]);
    }
    out->cell = radius / FINE;
    for (int d = 0; d < 2; d++) {
        out->low[d] -= MARGIN * out->cell;
        cells[d] = floor((high[d] - out->low[d]) / out->cell) + 1.0 + MARGIN;
    }
    if (!(cells[0] * cells[1] <= MOST_CELLS * (double)count + 1e6))
        return false;
    for (int d = 0; d < 2; d++)
        out->size[d] = (size_t)cells[d];
    return true;
}

static void cell_of(const struct plane *plane, const double place[2], size_t cell[2])
{
    for (int d = 0; d < 2; d++)
        cell[d] = (size_t)((place[d] - plane->low[d]) / plane->cell);
}

/* The three maps, each from the one before: cells with points, those that no empty disc has its
 * centre in, and those that one may touch; then, in the second, those around touched points. */
static void tell(const struct plane *plane, const double *places, size_t count, struct map maps[3],
    uint64_t *row, unsigned char *out)
{
    const struct shape held = shape_of(1, FINE), touched = shape_of(-1, FINE);
    const struct shape near = shape_of(-1, 2 * FINE);
    size_t cell[2];
    for (size_t i = 0; i < count; i++) {
        cell_of(plane, places + 2 * i, cell);
        set(&maps[0], cell);
    }
    spread(&maps[0], &held, row, &maps[1]);
    invert(&maps[1]);
    spread(&maps[1], &touched, row, &maps[2]);
    for (size_t i = 0; i < maps[0].rows * maps[0].words; i++) {
        maps[0].bits[i] &= maps[2].bits[i];
        maps[1].bits[i] = 0;
    }
    spread(&maps[0], &near, row, &maps[1]);
    for (size_t i = 0; i < count; i++) {
        cell_of(plane, places + 2 * i, cell);
        out[i] = is_set(&maps[0], cell) ? CREASE_HOLLOW_TOUCHED
            : is_set(&maps[1], cell)    ? CREASE_HOLLOW_NEAR
                                        : CREASE_HOLLOW_FAR;
    }
}

crease_status crease_hollow_find(
    crease_context *context, const double *places, size_t count, double radius, unsigned char *out)
{
    struct plane plane;
    struct map maps[3] = {{.rows = 0}};
    memset(out, CREASE_HOLLOW_TOUCHED, count);
    if (!lay_out(places, count, radius, &plane))
        return CREASE_OK;
    bool complete = true;
    for (int m = 0; m < 3; m++)
        complete = complete && make_map(context, &plane, &maps[m]);
    uint64_t *const row = complete ? crease_allocate(context, maps[0].words, sizeof *row) : NULL;
    if (row)
        tell(&plane, places, count, maps, row, out);
    for (int m = 0; m < 3; m++)
        free(maps[m].bits);
    free(row);
    return row ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
}
