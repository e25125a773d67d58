/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* STL, ascii and binary: the corners of the triangles, each place once, in the order in which they
 * come first; and the triangles. */
#include "base/memory.h"
#include "cloud/weld.h"
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
    uint32_t *points;  /* of each corner */
    uint32_t *corners; /* of each point: the corner that showed it first */
    size_t corner_count;
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

static size_t find_corner(const void *user, size_t row)
{
    const stl *const file = user;
    return file->place.find(file->place.user, file->corners[row]);
}

static crease_status merge(stl *file, crease_cloud **out)
{
    const size_t corners = file->columns.rows;
    file->points = crease_allocate(file->context, corners, sizeof *file->points);
    file->corners = crease_allocate(file->context, corners, sizeof *file->corners);
    if (!file->points || !file->corners)
        return CREASE_ERROR_NO_MEMORY;
    const crease_status status = crease_weld(
        file->context, file->columns.points, corners, file->points, &file->columns.rows);
    if (status != CREASE_OK)
        return status;
    for (size_t i = corners; i-- > 0;)
        file->corners[file->points[i]] = (uint32_t)i;
    file->corner_count = corners;
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

static crease_status read_file(stl *file, crease_cloud **out)
{
    return is_text(file->source) ? read_ascii(file, out) : read_binary(file, out);
}

static void close_file(stl *file)
{
    free(file->points);
    free(file->corners);
    crease_columns_free(&file->columns);
}

crease_status crease_stl_read(crease_context *context, const crease_source *source,
    const crease_read_options *options, crease_cloud **out)
{
    stl file = {.context = context, .source = source, .options = options};
    const crease_status status = read_file(&file, out);
    close_file(&file);
    return status;
}

crease_status crease_stl_faces(
    crease_context *context, const crease_source *source, crease_facets *facets)
{
    const crease_read_options options = crease_read_options_default();
    stl file = {.context = context, .source = source, .options = &options};
    crease_cloud *cloud = NULL;
    crease_status status = read_file(&file, &cloud);
    crease_polygon polygon = {0};
    for (size_t i = 0; i < file.corner_count && status == CREASE_OK; i++) {
        if (i % 3 == 0)
            polygon = (crease_polygon){0};
        status = crease_facets_add(context, facets, &polygon, file.points[i]);
    }
    crease_cloud_free(cloud);
    close_file(&file);
    return status;
}
