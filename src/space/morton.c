/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Based on: Morton. A computer oriented geodetic data base and a new technique in file sequencing.
 * 1966. The sort is a stable radix sort from the lowest digit up; each chunk counts its digits, the
 * counts are summed in chunk order, and each chunk then moves its own points. */
#include "space/morton.h"

#include "base/memory.h"
#include "base/parallel.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { AXIS_BITS = 21, DIGIT_BITS = 11, DIGITS = 1 << DIGIT_BITS, PASSES = 6, MOST_CHUNKS = 64 };

struct sorting {
    const double *points;
    size_t count, grain, chunks;
    crease_morton_frame frame;
    uint64_t *keys, *next_keys;
    uint32_t *order, *next_order;
    size_t *places; /* chunks x DIGITS: counts, then where the next point of the digit goes */
    unsigned shift;
};

/* Halved, so that the extent of any finite cloud is finite. */
crease_morton_frame crease_morton_frame_of(const double low[3], const double high[3])
{
    crease_morton_frame frame;
    double extent = 0;
    for (int axis = 0; axis < 3; axis++) {
        frame.low[axis] = 0.5 * low[axis];
        extent = fmax(extent, 0.5 * high[axis] - frame.low[axis]);
    }
    frame.scale = (1 << AXIS_BITS) / extent;
    return frame;
}

static crease_morton_frame frame_of(const double *points, size_t count)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < count; i++)
        for (int axis = 0; axis < 3; axis++) {
            const double value = points[3 * i + (size_t)axis];
            low[axis] = value < low[axis] ? value : low[axis];
            high[axis] = value > high[axis] ? value : high[axis];
        }
    return crease_morton_frame_of(low, high);
}

/* Not a number (0 times the infinite scale of a cloud without extent) falls into cell 0. */
static uint64_t cell(const crease_morton_frame *frame, double value, int axis)
{
    const double place = (0.5 * value - frame->low[axis]) * frame->scale;
    const double last = (1 << AXIS_BITS) - 1;
    return place > 0 ? (uint64_t)(place < last ? place : last) : 0;
}

/* Puts two zero bits before each of the lower 21 bits. */
static uint64_t spread(uint64_t bits)
{
    bits = (bits | bits << 32) & 0x001f00000000ffffu;
    bits = (bits | bits << 16) & 0x001f0000ff0000ffu;
    bits = (bits | bits << 8) & 0x100f00f00f00f00fu;
    bits = (bits | bits << 4) & 0x10c30c30c30c30c3u;
    return (bits | bits << 2) & 0x1249249249249249u;
}

uint64_t crease_morton_key(const crease_morton_frame *frame, const double point[3])
{
    return spread(cell(frame, point[0], 0)) << 2 | spread(cell(frame, point[1], 1)) << 1 |
        spread(cell(frame, point[2], 2));
}

static void make_keys(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const struct sorting *sort = user;
    for (size_t i = begin; i < end; i++) {
        sort->keys[i] = crease_morton_key(&sort->frame, sort->points + 3 * i);
        sort->order[i] = (uint32_t)i;
    }
}

static size_t digit(const struct sorting *sort, size_t i)
{
    return sort->keys[i] >> sort->shift & (DIGITS - 1);
}

static void count_digits(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const struct sorting *sort = user;
    size_t *places = sort->places + begin / sort->grain * DIGITS;
    memset(places, 0, DIGITS * sizeof *places);
    for (size_t i = begin; i < end; i++)
        places[digit(sort, i)]++;
}

static void move_points(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const struct sorting *sort = user;
    size_t *places = sort->places + begin / sort->grain * DIGITS;
    for (size_t i = begin; i < end; i++) {
        const size_t place = places[digit(sort, i)]++;
        sort->next_keys[place] = sort->keys[i];
        sort->next_order[place] = sort->order[i];
    }
}

/* Turns counts into places. False when all points have the same digit: nothing is to be moved. */
static bool sum_digits(struct sorting *sort)
{
    size_t place = 0, most = 0;
    for (size_t value = 0; value < DIGITS; value++) {
        const size_t first = place;
        for (size_t chunk = 0; chunk < sort->chunks; chunk++) {
            size_t *slot = &sort->places[chunk * DIGITS + value];
            const size_t count = *slot;
            *slot = place;
            place += count;
        }
        most = place - first > most ? place - first : most;
    }
    return most < sort->count;
}

static crease_status pass(crease_context *context, struct sorting *sort)
{
    crease_status status =
        crease_parallel_for(context, sort->count, sort->grain, count_digits, sort);
    if (status != CREASE_OK || !sum_digits(sort))
        return status;
    status = crease_parallel_for(context, sort->count, sort->grain, move_points, sort);
    uint64_t *const keys = sort->keys;
    sort->keys = sort->next_keys;
    sort->next_keys = keys;
    uint32_t *const order = sort->order;
    sort->order = sort->next_order;
    sort->next_order = order;
    return status;
}

static crease_status run(crease_context *context, struct sorting *sort)
{
    sort->frame = frame_of(sort->points, sort->count);
    crease_status status = crease_parallel_for(context, sort->count, sort->grain, make_keys, sort);
    for (unsigned i = 0; i < PASSES && status == CREASE_OK; i++) {
        sort->shift = i * DIGIT_BITS;
        status = pass(context, sort);
    }
    return status;
}

crease_status crease_morton_sort(
    crease_context *context, const double *points, size_t count, uint64_t *keys, uint32_t *order)
{
    const size_t share = count / MOST_CHUNKS + 1;
    const size_t grain = share > 16384 ? share : 16384;
    struct sorting sort = {
        .points = points, .count = count, .grain = grain, .keys = keys, .order = order};
    sort.chunks = count / grain + (count % grain != 0); /* those of crease_parallel_for */
    sort.places = crease_allocate(context, sort.chunks * DIGITS, sizeof *sort.places);
    uint64_t *const spare_keys = crease_allocate(context, count, sizeof *keys);
    uint32_t *const spare_order = crease_allocate(context, count, sizeof *order);
    sort.next_keys = spare_keys;
    sort.next_order = spare_order;
    crease_status status = CREASE_ERROR_NO_MEMORY;
    if (!sort.places || !spare_keys || !spare_order)
        goto done;
    status = run(context, &sort);
    if (sort.keys != keys) {
        memcpy(keys, sort.keys, count * sizeof *keys);
        memcpy(order, sort.order, count * sizeof *order);
    }
done:
    free(sort.places);
    free(spare_keys);
    free(spare_order);
    return status;
}
