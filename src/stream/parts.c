/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The rows are read three times: for the bounds and a sample of the points, by whose keys the
 * borders of the parts are chosen; to count the points of every part; and to move them there.
 * Points with the key of a border are told apart by their numbers, so that heaps of equal points
 * are cut, too. Then each part is sorted by itself. */
#include "stream/parts.h"

#include "base/memory.h"
#include "cloud/cloud.h"
#include "space/morton.h"
#include "stream/scratch.h"
#include "write/cloud.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SAMPLES = 1 << 15 };

typedef struct mark {
    uint64_t key;
    uint32_t number;
} mark;

typedef struct cutting {
    crease_context *context;
    crease_rows *rows;
    crease_parts *parts;
    size_t at_once;
    double *sample; /* SAMPLES x 3 at most */
    uint32_t *sample_numbers;
    size_t sample_count;
    crease_morton_frame frame;
    mark *borders;      /* part_count - 1: the first point of each part but the first */
    uint32_t *part_of;  /* of each of the points at hand */
    size_t *counts;     /* points of each part */
    size_t *filled;     /* records of each part that are there */
    crease_record *run; /* the points at hand, part by part */
} cutting;

/* ------------------------------------------------------------------------------------ file -- */

crease_status crease_parts_get(crease_context *context, const crease_parts *parts, size_t begin,
    size_t count, crease_record *out)
{
    return crease_scratch_get(context, parts->file, begin * sizeof *out, out, count * sizeof *out);
}

crease_status crease_parts_put(crease_context *context, const crease_parts *parts, size_t begin,
    size_t count, const crease_record *from)
{
    return crease_scratch_put(
        context, parts->file, begin * sizeof *from, from, count * sizeof *from);
}

/* ----------------------------------------------------------------------------------- passes -- */

typedef crease_status pass(cutting *cut, const crease_cloud *cloud, size_t number);

/* Some rows after the other; numbers count the points that are kept. */
static crease_status read_all(cutting *cut, pass *work)
{
    const size_t rows = crease_rows_count(cut->rows);
    crease_status status = CREASE_OK;
    size_t number = 0;
    for (size_t at = 0; at < rows && status == CREASE_OK; at += cut->at_once) {
        const size_t left = rows - at;
        crease_cloud *cloud = NULL;
        status = crease_rows_read(
            cut->context, cut->rows, at, left < cut->at_once ? left : cut->at_once, &cloud);
        if (status == CREASE_OK)
            status = work(cut, cloud, number);
        number += status == CREASE_OK ? cloud->count : 0;
        crease_cloud_free(cloud);
        crease_progress(cut->context, (double)at / (double)rows);
        if (status == CREASE_OK && crease_cancelled(cut->context))
            status = crease_fail_cancelled(cut->context);
    }
    cut->parts->count = number;
    return status;
}

static void extend(double low[3], double high[3], const double point[3])
{
    for (int axis = 0; axis < 3; axis++) {
        low[axis] = fmin(low[axis], point[axis]);
        high[axis] = fmax(high[axis], point[axis]);
    }
}

static void reset(double low[3], double high[3])
{
    for (int axis = 0; axis < 3; axis++) {
        low[axis] = INFINITY;
        high[axis] = -INFINITY;
    }
}

static crease_status look(cutting *cut, const crease_cloud *cloud, size_t number)
{
    crease_parts *const parts = cut->parts;
    const size_t step = crease_rows_count(cut->rows) / SAMPLES + 1;
    parts->wide_normals =
        parts->wide_normals || crease_cloud_normal_type(cloud) == CREASE_TYPE_FLOAT64;
    for (size_t i = 0; i < cloud->count; i++) {
        extend(parts->low, parts->high, cloud->points + 3 * i);
        if ((number + i) % step == 0 && cut->sample_count < SAMPLES) {
            memcpy(cut->sample + 3 * cut->sample_count, cloud->points + 3 * i, 3 * sizeof(double));
            cut->sample_numbers[cut->sample_count++] = (uint32_t)(number + i);
        }
    }
    return CREASE_OK;
}

static int compare_marks(const void *a, const void *b)
{
    const mark *const x = a, *const y = b;
    if (x->key != y->key)
        return x->key < y->key ? -1 : 1;
    return (x->number > y->number) - (x->number < y->number);
}

static crease_status choose_borders(cutting *cut)
{
    crease_parts *const parts = cut->parts;
    mark *const marks = crease_allocate(cut->context, cut->sample_count, sizeof *marks);
    if (!marks)
        return CREASE_ERROR_NO_MEMORY;
    cut->frame = crease_morton_frame_of(parts->low, parts->high);
    for (size_t i = 0; i < cut->sample_count; i++)
        marks[i] =
            (mark){crease_morton_key(&cut->frame, cut->sample + 3 * i), cut->sample_numbers[i]};
    qsort(marks, cut->sample_count, sizeof *marks, compare_marks);
    for (size_t p = 1; p < parts->part_count && cut->sample_count > 0; p++)
        cut->borders[p - 1] = marks[p * cut->sample_count / parts->part_count];
    free(marks);
    return CREASE_OK;
}

static uint32_t find_part(const cutting *cut, const double point[3], size_t number)
{
    const mark own = {crease_morton_key(&cut->frame, point), (uint32_t)number};
    size_t low = 0, high = cut->parts->part_count - 1; /* borders not after the point */
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (compare_marks(&cut->borders[middle], &own) <= 0)
            low = middle + 1;
        else
            high = middle;
    }
    return (uint32_t)low;
}

static crease_status count_points(cutting *cut, const crease_cloud *cloud, size_t number)
{
    for (size_t i = 0; i < cloud->count; i++)
        cut->counts[find_part(cut, cloud->points + 3 * i, number + i)]++;
    return CREASE_OK;
}

static crease_record record_of(const crease_cloud *cloud, size_t i, size_t number)
{
    crease_record record = {.number = (uint32_t)(number + i)};
    memcpy(record.point, cloud->points + 3 * i, sizeof record.point);
    return record;
}

/* The points at hand, sorted by part, behind those that are there. */
static crease_status move_points(cutting *cut, const crease_cloud *cloud, size_t number)
{
    crease_parts *const parts = cut->parts;
    memset(cut->counts, 0, parts->part_count * sizeof *cut->counts);
    for (size_t i = 0; i < cloud->count; i++) {
        cut->part_of[i] = find_part(cut, cloud->points + 3 * i, number + i);
        cut->counts[cut->part_of[i]]++;
        extend(parts->items[cut->part_of[i]].low, parts->items[cut->part_of[i]].high,
            cloud->points + 3 * i);
    }
    for (size_t p = 0, place = 0; p < parts->part_count; p++) {
        const size_t count = cut->counts[p];
        cut->counts[p] = place;
        place += count;
    }
    for (size_t i = 0; i < cloud->count; i++)
        cut->run[cut->counts[cut->part_of[i]]++] = record_of(cloud, i, number);
    crease_status status = CREASE_OK;
    for (size_t p = 0, begin = 0; p < parts->part_count && status == CREASE_OK; p++) {
        const size_t count = cut->counts[p] - begin;
        status = crease_parts_put(
            cut->context, parts, parts->items[p].first + cut->filled[p], count, cut->run + begin);
        cut->filled[p] += count;
        begin = cut->counts[p];
    }
    return status;
}

/* ---------------------------------------------------------------------------------- sorting -- */

/* A part in memory. */
typedef struct sorting {
    crease_record *records, *sorted; /* sorted: CREASE_BLOCK */
    double *points;
    uint64_t *keys;
    uint32_t *order;
} sorting;

static crease_status write_blocks(const cutting *cut, const crease_part *part, const sorting *sort)
{
    crease_status status = CREASE_OK;
    for (size_t at = 0; at < part->count && status == CREASE_OK; at += CREASE_BLOCK) {
        const size_t left = part->count - at, count = left < CREASE_BLOCK ? left : CREASE_BLOCK;
        crease_block *const block = &cut->parts->blocks[part->first_block + at / CREASE_BLOCK];
        reset(block->low, block->high);
        for (size_t i = 0; i < count; i++) {
            sort->sorted[i] = sort->records[sort->order[at + i]];
            extend(block->low, block->high, sort->sorted[i].point);
        }
        status = crease_parts_put(cut->context, cut->parts, part->first + at, count, sort->sorted);
    }
    return status;
}

static crease_status sort_part(const cutting *cut, const crease_part *part)
{
    crease_context *const context = cut->context;
    const size_t count = part->count;
    sorting sort = {.records = crease_allocate(context, count, sizeof *sort.records),
        .sorted = crease_allocate(context, CREASE_BLOCK, sizeof *sort.sorted),
        .points = crease_allocate(context, count, 3 * sizeof *sort.points),
        .keys = crease_allocate(context, count, sizeof *sort.keys),
        .order = crease_allocate(context, count, sizeof *sort.order)};
    crease_status status = sort.records && sort.sorted && sort.points && sort.keys && sort.order
        ? crease_parts_get(context, cut->parts, part->first, count, sort.records)
        : CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < count && status == CREASE_OK; i++)
        memcpy(sort.points + 3 * i, sort.records[i].point, sizeof sort.records[i].point);
    if (status == CREASE_OK)
        status = crease_morton_sort(context, sort.points, count, sort.keys, sort.order);
    if (status == CREASE_OK)
        status = write_blocks(cut, part, &sort);
    free(sort.records);
    free(sort.sorted);
    free(sort.points);
    free(sort.keys);
    free(sort.order);
    return status;
}

static crease_status sort_parts(cutting *cut)
{
    crease_parts *const parts = cut->parts;
    crease_status status = CREASE_OK;
    size_t blocks = 0;
    for (size_t p = 0; p < parts->part_count; p++) {
        parts->items[p].first_block = blocks;
        blocks += crease_part_blocks(&parts->items[p]);
    }
    parts->blocks = crease_allocate(cut->context, blocks, sizeof *parts->blocks);
    if (!parts->blocks)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t p = 0; p < parts->part_count && status == CREASE_OK; p++)
        status = sort_part(cut, &parts->items[p]);
    return status;
}

/* ------------------------------------------------------------------------------------ whole -- */

static crease_status cut_all(cutting *cut)
{
    crease_parts *const parts = cut->parts;
    reset(parts->low, parts->high);
    crease_status status = read_all(cut, look);
    if (status == CREASE_OK)
        status = choose_borders(cut);
    if (status == CREASE_OK)
        status = read_all(cut, count_points);
    for (size_t p = 0, first = 0; p < parts->part_count; p++) {
        parts->items[p].first = first;
        parts->items[p].count = cut->counts[p];
        first += cut->counts[p];
        reset(parts->items[p].low, parts->items[p].high);
    }
    if (status == CREASE_OK)
        status = read_all(cut, move_points);
    return status;
}

static bool allocate(cutting *cut)
{
    crease_context *const context = cut->context;
    const size_t parts = cut->parts->part_count;
    cut->sample = crease_allocate(context, SAMPLES, 3 * sizeof *cut->sample);
    cut->sample_numbers = crease_allocate(context, SAMPLES, sizeof *cut->sample_numbers);
    cut->borders = crease_allocate(context, parts, sizeof *cut->borders);
    cut->counts = crease_allocate(context, parts, sizeof *cut->counts);
    cut->filled = crease_allocate(context, parts, sizeof *cut->filled);
    cut->part_of = crease_allocate(context, cut->at_once, sizeof *cut->part_of);
    cut->run = crease_allocate(context, cut->at_once, sizeof *cut->run);
    cut->parts->items = crease_allocate(context, parts, sizeof *cut->parts->items);
    return cut->sample && cut->sample_numbers && cut->borders && cut->counts && cut->filled &&
        cut->part_of && cut->run && cut->parts->items;
}

static void free_room(cutting *cut)
{
    free(cut->sample);
    free(cut->sample_numbers);
    free(cut->borders);
    free(cut->counts);
    free(cut->filled);
    free(cut->part_of);
    free(cut->run);
}

crease_status crease_parts_create(crease_context *context, crease_rows *rows, size_t at_once,
    size_t part_count, const char *scratch, crease_parts *out)
{
    *out = (crease_parts){.file = -1, .part_count = part_count};
    cutting cut = {.context = context, .rows = rows, .parts = out, .at_once = at_once};
    crease_stage(context, "cutting");
    crease_status status = allocate(&cut) ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK)
        status = crease_scratch_open(context, scratch, &out->file);
    if (status == CREASE_OK)
        status = cut_all(&cut);
    free_room(&cut);
    if (status == CREASE_OK)
        status = sort_parts(&cut);
    if (status != CREASE_OK)
        crease_parts_free(out);
    return status;
}

void crease_parts_free(crease_parts *parts)
{
    crease_scratch_close(parts->file);
    free(parts->items);
    free(parts->blocks);
    *parts = (crease_parts){.file = -1};
}
