/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Other parts are looked through block by block: only those are read that something is asked of.
 * A point that asks for itself, such as an outlier, may at first ask for much, because little of
 * its own part is near. So what it asks for is narrowed before: by the boxes of all blocks, within
 * the farthest corner of each of which there are enough points, then by the points of the blocks
 * that are left. */
#include "stream/part.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A part while it is being put together. */
typedef struct gathering {
    crease_context *context;
    const crease_parts *parts;
    size_t part, most;
    crease_record *records; /* own ones, then those of others */
    size_t count, room;
    bool full; /* there would be more than `most` */
    crease_reaches reaches;
    uint32_t *touching;   /* reaches that touch the other part, then the block at hand */
    uint32_t *asking;     /* the latter */
    crease_record *block; /* CREASE_BLOCK */
    double *places;       /* CREASE_BLOCK x 3 */
    uint8_t *wanted;      /* CREASE_BLOCK */
} gathering;

static crease_status make_tree(crease_context *context, const crease_record *records, size_t count,
    double *places, crease_tree **out)
{
    for (size_t i = 0; i < count; i++)
        memcpy(places + 3 * i, records[i].point, sizeof records[i].point);
    return crease_tree_create(context, places, count, out);
}

/* The reaches of own points. */
static crease_status find_reaches(gathering *run, int k)
{
    crease_tree *tree = NULL;
    double *const places = crease_allocate(run->context, run->count, 3 * sizeof *places);
    crease_status status = places ? make_tree(run->context, run->records, run->count, places, &tree)
                                  : CREASE_ERROR_NO_MEMORY;
    free(places);
    if (status == CREASE_OK)
        status = crease_reaches_find(run->context, tree, k, &run->reaches);
    crease_tree_free(tree);
    if (status != CREASE_OK)
        return status;
    run->touching = crease_allocate(run->context, run->reaches.count, sizeof *run->touching);
    run->asking = crease_allocate(run->context, run->reaches.count, sizeof *run->asking);
    return run->touching && run->asking ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
}

/* -------------------------------------------------------------------------------- narrowing -- */

static size_t block_size(const crease_part *part, size_t block)
{
    const size_t left = part->count - block * CREASE_BLOCK;
    return left < CREASE_BLOCK ? left : CREASE_BLOCK;
}

static double farthest(const crease_block *block, const double place[3])
{
    double squared = 0;
    for (int axis = 0; axis < 3; axis++) {
        const double away =
            fmax(fabs(place[axis] - block->low[axis]), fabs(block->high[axis] - place[axis]));
        squared += away * away;
    }
    return squared;
}

/* A little more, for what rounding may have taken. */
static void narrow_by_boxes(gathering *run, const crease_part *part)
{
    const double more = 1.0 + 1e-12;
    for (size_t i = 0; i < run->reaches.count; i++) {
        crease_reach *const reach = &run->reaches.items[i];
        if (!reach->nearest || !crease_reach_touches(reach, part->low, part->high))
            continue;
        for (size_t b = 0; b < crease_part_blocks(part); b++)
            if (block_size(part, b) >= reach->nearest)
                reach->limit = fmin(reach->limit,
                    more * farthest(&run->parts->blocks[part->first_block + b], reach->low));
    }
}

/* ---------------------------------------------------------------------------------- blocks -- */

static size_t choose_reaches(const gathering *run, const uint32_t *from, size_t count,
    const double low[3], const double high[3], bool nearest, uint32_t *out)
{
    size_t chosen = 0;
    for (size_t i = 0; i < count; i++) {
        const uint32_t number = from ? from[i] : (uint32_t)i;
        const crease_reach *const reach = &run->reaches.items[number];
        if ((!nearest || reach->nearest) && crease_reach_touches(reach, low, high))
            out[chosen++] = number;
    }
    return chosen;
}

static crease_status append(gathering *run, const crease_record *record)
{
    if (run->count == run->most) {
        run->full = true;
        return CREASE_OK;
    }
    if (run->count == run->room) {
        const size_t grown = run->room + run->room / 8 + CREASE_BLOCK;
        const size_t room = grown < run->most ? grown : run->most;
        crease_record *const records =
            crease_reallocate(run->context, run->records, room, sizeof *records);
        if (!records)
            return CREASE_ERROR_NO_MEMORY;
        run->records = records;
        run->room = room;
    }
    run->records[run->count++] = *record;
    return CREASE_OK;
}

/* Of the block at hand what is asked for. */
static crease_status take(gathering *run, const crease_tree *tree, size_t asking)
{
    crease_status status = CREASE_OK;
    memset(run->wanted, 0, tree->count);
    for (size_t i = 0; i < asking; i++)
        crease_reach_mark(&run->reaches.items[run->asking[i]], tree, run->wanted);
    for (size_t i = 0; i < tree->count && status == CREASE_OK && !run->full; i++)
        if (run->wanted[i])
            status = append(run, &run->block[i]);
    return status;
}

static void narrow(gathering *run, const crease_tree *tree, size_t asking)
{
    for (size_t i = 0; i < asking; i++) {
        crease_reach *const reach = &run->reaches.items[run->asking[i]];
        reach->limit = crease_reach_limit(reach, tree);
    }
}

static crease_status look_through(gathering *run, const crease_part *other, bool narrowing)
{
    crease_status status = CREASE_OK;
    const size_t touching = choose_reaches(
        run, NULL, run->reaches.count, other->low, other->high, narrowing, run->touching);
    for (size_t b = 0; b < crease_part_blocks(other) && status == CREASE_OK && !run->full; b++) {
        const crease_block *const block = &run->parts->blocks[other->first_block + b];
        const size_t asking = choose_reaches(
            run, run->touching, touching, block->low, block->high, narrowing, run->asking);
        crease_tree *tree = NULL;
        if (asking == 0)
            continue;
        status = crease_parts_get(run->context, run->parts, other->first + b * CREASE_BLOCK,
            block_size(other, b), run->block);
        if (status == CREASE_OK)
            status = make_tree(run->context, run->block, block_size(other, b), run->places, &tree);
        if (status == CREASE_OK && narrowing)
            narrow(run, tree, asking);
        else if (status == CREASE_OK)
            status = take(run, tree, asking);
        crease_tree_free(tree);
    }
    if (status == CREASE_OK && crease_cancelled(run->context))
        status = crease_fail_cancelled(run->context);
    return status;
}

static crease_status complete(gathering *run)
{
    const crease_parts *const parts = run->parts;
    crease_status status = CREASE_OK;
    for (size_t p = 0; p < parts->part_count; p++)
        if (p != run->part)
            narrow_by_boxes(run, &parts->items[p]);
    for (int narrowing = 1; narrowing >= 0; narrowing--)
        for (size_t p = 0; p < parts->part_count && status == CREASE_OK && !run->full; p++)
            if (p != run->part)
                status = look_through(run, &parts->items[p], narrowing);
    return status;
}

static crease_status gather(gathering *run, int k)
{
    const crease_part *const own = &run->parts->items[run->part];
    crease_status status = CREASE_ERROR_NO_MEMORY;
    run->room = run->count = own->count;
    run->full = own->count > run->most;
    if (run->full)
        return CREASE_OK;
    run->records = crease_allocate(run->context, own->count, sizeof *run->records);
    run->block = crease_allocate(run->context, CREASE_BLOCK, sizeof *run->block);
    run->places = crease_allocate(run->context, CREASE_BLOCK, 3 * sizeof *run->places);
    run->wanted = crease_allocate(run->context, CREASE_BLOCK, sizeof *run->wanted);
    if (run->records && run->block && run->places && run->wanted)
        status = crease_parts_get(run->context, run->parts, own->first, own->count, run->records);
    if (status == CREASE_OK)
        status = find_reaches(run, k);
    return status == CREASE_OK ? complete(run) : status;
}

/* ---------------------------------------------------------------------------------- holding -- */

static int compare_keys(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

/* Numbers and places in the records, in the order of the numbers. */
static crease_status order_records(const gathering *run, uint64_t **out)
{
    uint64_t *const keys = *out = crease_allocate(run->context, run->count, sizeof *keys);
    if (!keys)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < run->count; i++)
        keys[i] = (uint64_t)run->records[i].number << 32 | i;
    qsort(keys, run->count, sizeof *keys, compare_keys);
    return CREASE_OK;
}

static crease_status allocate(const gathering *run, crease_held *out)
{
    crease_context *const context = run->context;
    out->points = crease_allocate(context, run->count, 3 * sizeof *out->points);
    out->numbers = crease_allocate(context, run->count, sizeof *out->numbers);
    out->own = crease_allocate(context, run->count, sizeof *out->own);
    out->variance = crease_allocate(context, run->count, sizeof *out->variance);
    out->places = crease_allocate(context, run->parts->items[run->part].count, sizeof *out->places);
    return out->points && out->numbers && out->own && out->variance && out->places
        ? CREASE_OK
        : CREASE_ERROR_NO_MEMORY;
}

/* The points by ascending number. */
static crease_status hold(const gathering *run, crease_held *out)
{
    const size_t own = run->parts->items[run->part].count;
    uint64_t *keys = NULL;
    crease_status status = order_records(run, &keys);
    if (status == CREASE_OK)
        status = allocate(run, out);
    for (size_t i = 0; i < run->count && status == CREASE_OK; i++) {
        const size_t from = keys[i] & UINT32_MAX;
        const crease_record *const record = &run->records[from];
        memcpy(out->points + 3 * i, record->point, sizeof record->point);
        out->numbers[i] = record->number;
        out->own[i] = from < own;
        out->variance[i] = record->variance;
        if (from < own)
            out->places[from] = (uint32_t)i;
    }
    free(keys);
    out->piece = (crease_piece){run->count, out->points, out->numbers, out->own};
    return status;
}

crease_status crease_held_load(crease_context *context, const crease_parts *parts, size_t part,
    int k, size_t most, crease_held *out, bool *fits)
{
    gathering run = {.context = context, .parts = parts, .part = part, .most = most};
    *out = (crease_held){0};
    crease_status status = gather(&run, k);
    crease_reaches_free(&run.reaches);
    free(run.touching);
    free(run.asking);
    free(run.block);
    free(run.places);
    free(run.wanted);
    *fits = !run.full;
    if (status == CREASE_OK && *fits)
        status = hold(&run, out);
    free(run.records);
    if (status == CREASE_OK && *fits)
        status = crease_tree_create(context, out->points, out->piece.count, &out->tree);
    if (status != CREASE_OK)
        crease_held_free(out);
    return status;
}

void crease_held_free(crease_held *held)
{
    crease_tree_free(held->tree);
    free(held->points);
    free(held->variance);
    free(held->numbers);
    free(held->own);
    free(held->places);
    *held = (crease_held){0};
}

crease_status crease_held_store(
    crease_context *context, const crease_parts *parts, size_t part, const crease_held *held)
{
    const crease_part *const own = &parts->items[part];
    crease_record *const block = crease_allocate(context, CREASE_BLOCK, sizeof *block);
    crease_status status = block ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    for (size_t at = 0; at < own->count && status == CREASE_OK; at += CREASE_BLOCK) {
        const size_t count = own->count - at < CREASE_BLOCK ? own->count - at : CREASE_BLOCK;
        status = crease_parts_get(context, parts, own->first + at, count, block);
        for (size_t i = 0; i < count && status == CREASE_OK; i++)
            block[i].variance = held->variance[held->places[at + i]];
        if (status == CREASE_OK)
            status = crease_parts_put(context, parts, own->first + at, count, block);
    }
    free(block);
    return status;
}
