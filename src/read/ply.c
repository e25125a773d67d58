/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* PLY: the element `vertex`, wherever it stands; other elements are passed over.
 * Based on: Turk. The PLY polygon file format. 1994. */
#include "base/memory.h"
#include "read/formats.h"
#include "read/ply_header.h"
#include "read/table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool is_last(const crease_ply *file, const crease_ply_element *part)
{
    return part == &file->elements[file->element_count - 1];
}

static crease_status fail_surplus(const crease_ply *file, const crease_ply_element *vertices)
{
    return crease_fail(file->context, CREASE_ERROR_FORMAT,
        "%s: holds more than the %llu points that its header promises; mend the header",
        file->source->name, (unsigned long long)vertices->count);
}

/* ------------------------------------------------------------------------------------- ascii -- */

static crease_status fill_from_table(
    crease_ply *file, crease_ply_element *vertices, const crease_table *table)
{
    crease_columns *columns = &vertices->properties;
    if (table->rows < vertices->count)
        return crease_fail(file->context, CREASE_ERROR_TRUNCATED,
            "%s: has %zu of the %llu points that its header promises; get the whole file",
            file->source->name, table->rows, (unsigned long long)vertices->count);
    if (table->rows > vertices->count && is_last(file, vertices))
        return fail_surplus(file, vertices);
    crease_status status =
        crease_columns_allocate(file->context, file->source, columns, vertices->count);
    if (status == CREASE_OK)
        status = crease_table_fill(file->context, file->source, table, columns);
    return status;
}

static crease_status read_ascii(crease_ply *file, crease_ply_element *vertices, crease_cloud **out)
{
    crease_status status = crease_ply_skip_lines(file, vertices);
    if (status != CREASE_OK)
        return status;
    crease_table table = {.begin = file->cursor.at,
        .end = file->cursor.end,
        .first_line = file->source->line ? file->source->line : file->cursor.line + 1,
        .data = crease_table_data,
        .separator = ' '};
    status = crease_table_count(file->context, &table);
    if (status == CREASE_OK)
        status = fill_from_table(file, vertices, &table);
    if (status == CREASE_OK)
        status = crease_columns_finish(file->context, file->source, file->options,
            &vertices->properties, crease_table_place(&table), out);
    crease_table_free(&table);
    return status;
}

/* ------------------------------------------------------------------------------------ binary -- */

static crease_status fill_vertices(crease_ply *file, crease_ply_element *vertices)
{
    bool lists = false;
    crease_columns *columns = &vertices->properties;
    const size_t size = crease_ply_least_size(vertices, &lists);
    if (!crease_ply_fits(file, vertices->count, size))
        return crease_ply_fail_truncated(file, vertices);
    crease_status status =
        crease_columns_allocate(file->context, file->source, columns, vertices->count);
    if (status != CREASE_OK)
        return status;
    if (lists)
        return crease_ply_pass_rows(file, vertices, true, NULL, NULL);
    crease_columns_pack(columns);
    status = crease_columns_fill(
        file->context, columns, (const unsigned char *)file->cursor.at, crease_ply_order(file));
    file->cursor.at += columns->rows * size;
    return status;
}

/* The vertices begin at `first` and take, without lists, `size` bytes each. */
typedef struct layout {
    size_t first, size;
} layout;

static size_t find_byte(const void *user, size_t row)
{
    const layout *const points = user;
    return points->first + row * points->size;
}

static crease_status read_binary(crease_ply *file, crease_ply_element *vertices, crease_cloud **out)
{
    crease_status status = CREASE_OK;
    for (const crease_ply_element *part = file->elements; part < vertices && status == CREASE_OK;
         part++)
        status = crease_ply_skip(file, part);
    bool lists = false;
    layout points = {
        .first = (size_t)(file->cursor.at - file->source->bytes) + file->source->bytes_before,
        .size = crease_ply_least_size(vertices, &lists)};
    if (lists)
        points.size = 0;
    if (status == CREASE_OK)
        status = fill_vertices(file, vertices);
    if (status != CREASE_OK)
        return status;
    if (crease_ply_left(file) && is_last(file, vertices)) {
        if (points.size && crease_ply_left(file) >= points.size)
            return fail_surplus(file, vertices);
        crease_warn(file->context, "%s: the %zu bytes behind its last point are not read",
            file->source->name, crease_ply_left(file));
    }
    const crease_place place = {
        .unit = lists ? "points from byte" : "byte", .find = find_byte, .user = &points};
    return crease_columns_finish(
        file->context, file->source, file->options, &vertices->properties, place, out);
}

/* ------------------------------------------------------------------------------------- whole -- */

static crease_status read_file(crease_ply *file, crease_cloud **out)
{
    crease_status status = crease_ply_read_header(file);
    if (status != CREASE_OK)
        return status;
    crease_ply_element *const vertices = crease_ply_find(file, "vertex");
    if (!vertices)
        return crease_fail(file->context, CREASE_ERROR_FORMAT,
            "%s: its header names no element 'vertex'; there are no points in it",
            file->source->name);
    status = crease_columns_settle(file->context, file->source, &vertices->properties);
    if (status != CREASE_OK)
        return status;
    return file->coding == CREASE_PLY_ASCII ? read_ascii(file, vertices, out)
                                            : read_binary(file, vertices, out);
}

crease_status crease_ply_read(crease_context *context, const crease_source *source,
    const crease_read_options *options, crease_cloud **out)
{
    crease_ply *const file = crease_ply_open(context, source, options);
    if (!file)
        return CREASE_ERROR_NO_MEMORY;
    const crease_status status = read_file(file, out);
    crease_ply_close(file);
    return status;
}

/* ------------------------------------------------------------------------------------ layout -- */

static crease_status find_layout(crease_ply *file, crease_layout *out)
{
    crease_status status = crease_ply_read_header(file);
    if (status != CREASE_OK)
        return status;
    bool lists = true;
    const crease_ply_element *const first = &file->elements[0];
    const bool vertices = file->element_count > 0 && crease_span_is(first->name, "vertex");
    const size_t size = vertices ? crease_ply_least_size(first, &lists) : 0;
    const bool text = file->coding == CREASE_PLY_ASCII;
    if (!vertices || (lists && !text) || size == 0)
        return crease_fail(file->context, CREASE_ERROR_UNSUPPORTED,
            "%s: only a PLY file that begins with its points, without lists where it is binary, "
            "can "
            "be read in parts; write it so on a machine that holds it",
            file->source->name);
    const char *const begin = file->source->bytes;
    const size_t header = (size_t)(file->cursor.at - begin);
    *out = (crease_layout){.counted = true,
        .count = first->count,
        .size = size,
        .first = header,
        .is_row = text ? crease_table_data : NULL,
        .lead = header,
        .line = file->cursor.line + 1,
        .columns = first->properties.count,
        .numeral = {(size_t)(first->digits.at - begin), (size_t)(first->digits.end - begin)},
        .alone = file->element_count == 1};
    return CREASE_OK;
}

crease_status crease_ply_layout(
    crease_context *context, const crease_source *head, crease_layout *out)
{
    const crease_read_options options = crease_read_options_default();
    crease_ply *const file = crease_ply_open(context, head, &options);
    if (!file)
        return CREASE_ERROR_NO_MEMORY;
    const crease_status status = find_layout(file, out);
    crease_ply_close(file);
    return status;
}
