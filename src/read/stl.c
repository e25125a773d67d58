/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* STL, ascii and binary: the corners of the triangles, each place once, in the order in which they
 * come first. */
#include "base/memory.h"
#include "read/binary.h"
#include "read/formats.h"
#include "read/table.h"

#include <stdlib.h>
#include <string.h>

enum { HEADER = 84, TRIANGLE = 50, NORMAL = 12, CORNER = 12, LOOKED_AT = 512 };

typedef struct stl {
    crease_context *context;
    const crease_source *source;
    const crease_read_options *options;
    crease_columns columns;
    uint32_t *corners;  /* of each point: the corner that showed it first */
    crease_place place; /* of the corners */
} stl;

static uint64_t count_of(const char *head)
{
    return (uint64_t)crease_cell_load(
        (const unsigned char *)head + HEADER - 4, CREASE_TYPE_UINT32, CREASE_ORDER_LITTLE);
}

bool crease_stl_is_binary(const char *head, size_t head_size, size_t file_size)
{
    return head_size >= HEADER && file_size == HEADER + TRIANGLE * count_of(head);
}

/* ------------------------------------------------------------------------------------ merging --
 */

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

static void merge_corners(stl *file, uint32_t *slots, size_t mask)
{
    double *const points = file->columns.points;
    uint32_t count = 0;
    for (size_t i = 0; i < file->columns.rows; i++) {
        uint64_t key[3];
        key_of(points + 3 * i, key);
        const size_t slot = find_slot(points, slots, mask, key);
        if (slots[slot])
            continue;
        memmove(points + 3 * (size_t)count, points + 3 * i, 3 * sizeof *points);
        file->corners[count] = (uint32_t)i;
        slots[slot] = ++count;
    }
    file->columns.rows = count;
}

static size_t find_corner(const void *user, size_t row)
{
    const stl *const file = user;
    return file->place.find(file->place.user, file->corners[row]);
}

static crease_status merge(stl *file, crease_cloud **out)
{
    size_t size = 16;
    while (size < 2 * file->columns.rows)
        size *= 2;
    file->corners = crease_allocate(file->context, file->columns.rows, sizeof *file->corners);
    uint32_t *slots = file->corners ? crease_allocate(file->context, size, sizeof *slots) : NULL;
    if (!slots)
        return CREASE_ERROR_NO_MEMORY;
    merge_corners(file, slots, size - 1);
    free(slots);
    const crease_place place = {.unit = file->place.unit, .find = find_corner, .user = file};
    return crease_columns_finish(
        file->context, file->source, file->options, &file->columns, place, out);
}

static crease_status add_columns(stl *file, int cell, uint64_t rows)
{
    static const char *const names[] = {"x", "y", "z"};
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < 3 && status == CREASE_OK; i++)
        status = crease_columns_add_named(file->context, &file->columns, names[i], cell);
    if (status == CREASE_OK)
        status = crease_columns_settle(file->context, file->source, &file->columns);
    if (status == CREASE_OK)
        status = crease_columns_allocate(file->context, file->source, &file->columns, rows);
    return status;
}

/* ------------------------------------------------------------------------------------- ascii -- */

static const char *corner_data(const char *line, const char *end)
{
    crease_span rest = {line, end}, word;
    return crease_span_word(&rest, &word) && crease_span_is_like(word, "vertex")
        ? crease_skip_blanks(rest.at, end)
        : NULL;
}

/* The last line that is not blank begins with endsolid. */
static bool is_ended(const crease_source *source)
{
    const char *end = source->bytes + source->size;
    while (end > source->bytes && (crease_is_blank(end[-1]) || end[-1] == '\n'))
        end--;
    const char *begin = end;
    while (begin > source->bytes && begin[-1] != '\n')
        begin--;
    crease_span line = {begin, end}, word;
    return crease_span_word(&line, &word) && crease_span_is_like(word, "endsolid");
}

static crease_status read_corners(stl *file, crease_table *table, crease_cloud **out)
{
    crease_status status = crease_table_count(file->context, table);
    if (status == CREASE_OK && (table->rows % 3 || !is_ended(file->source)))
        status = crease_fail(file->context, CREASE_ERROR_TRUNCATED,
            "%s: byte %zu: ends before its triangles do (no 'endsolid'); get the whole file",
            file->source->name, file->source->size);
    if (status == CREASE_OK)
        status = add_columns(file, CREASE_TYPE_FLOAT64, table->rows);
    if (status == CREASE_OK)
        status = crease_table_fill(file->context, file->source, table, &file->columns);
    file->place = crease_table_place(table);
    return status == CREASE_OK ? merge(file, out) : status;
}

static crease_status read_ascii(stl *file, crease_cloud **out)
{
    crease_table table = {.begin = file->source->bytes,
        .end = file->source->bytes + file->source->size,
        .first_line = 1,
        .data = corner_data,
        .separator = ' '};
    const crease_status status = read_corners(file, &table, out);
    crease_table_free(&table);
    return status;
}

/* ------------------------------------------------------------------------------------ binary -- */

static size_t corner_byte(const void *user, size_t corner)
{
    (void)user;
    return HEADER + corner / 3 * TRIANGLE + NORMAL + corner % 3 * CORNER;
}

static crease_status check_size(const stl *file, uint64_t promised)
{
    const uint64_t held = (file->source->size - HEADER) / TRIANGLE;
    if (held == promised)
        return CREASE_OK;
    return crease_fail(file->context,
        held < promised ? CREASE_ERROR_TRUNCATED : CREASE_ERROR_FORMAT,
        "%s: holds %llu triangles where its header promises %llu; %s", file->source->name,
        (unsigned long long)held, (unsigned long long)promised,
        held < promised ? "get the whole file" : "the file is damaged, get it again");
}

static crease_status read_binary(stl *file, crease_cloud **out)
{
    if (file->source->size < HEADER)
        return crease_fail(file->context, CREASE_ERROR_TRUNCATED,
            "%s: byte %zu: ends within the header of an STL file; get the whole file",
            file->source->name, file->source->size);
    const uint64_t promised = count_of(file->source->bytes);
    crease_status status = check_size(file, promised);
    if (status == CREASE_OK)
        status = add_columns(file, CREASE_TYPE_FLOAT32, 3 * promised);
    if (status != CREASE_OK)
        return status;
    const unsigned char *bytes = (const unsigned char *)file->source->bytes;
    for (size_t i = 0; i < 3 * file->columns.rows; i++)
        file->columns.points[i] = crease_cell_load(
            bytes + corner_byte(NULL, i / 3) + i % 3 * 4, CREASE_TYPE_FLOAT32, CREASE_ORDER_LITTLE);
    file->place = (crease_place){.unit = "byte", .find = corner_byte};
    return merge(file, out);
}

/* "solid" in front is no proof: some binary files begin so. Text has no control characters. */
static bool is_text(const crease_source *source)
{
    if (source->size < 5 || memcmp(source->bytes, "solid", 5) != 0 ||
        crease_stl_is_binary(source->bytes, source->size, source->size))
        return false;
    for (size_t i = 0; i < source->size && i < LOOKED_AT; i++)
        if (source->bytes[i] >= 0 && source->bytes[i] < '\t')
            return false;
    return true;
}

crease_status crease_stl_read(crease_context *context, const crease_source *source,
    const crease_read_options *options, crease_cloud **out)
{
    stl file = {.context = context, .source = source, .options = options};
    const crease_status status = is_text(source) ? read_ascii(&file, out) : read_binary(&file, out);
    free(file.corners);
    crease_columns_free(&file.columns);
    return status;
}
