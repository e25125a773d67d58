/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* PLY: the element `vertex`, wherever it stands; other elements are passed over.
 * Based on: Turk. The PLY polygon file format. 1994. */
#include "base/memory.h"
#include "read/binary.h"
#include "read/formats.h"
#include "read/table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_ELEMENTS = 64 };

typedef enum coding { CODING_NONE, CODING_ASCII, CODING_LITTLE, CODING_BIG } coding;

typedef struct element {
    crease_span name;
    uint64_t count;
    crease_span digits; /* of the count */
    crease_columns properties;
} element;

typedef struct ply {
    crease_context *context;
    const crease_source *source;
    const crease_read_options *options;
    crease_cursor cursor;
    coding coding;
    element elements[MOST_ELEMENTS];
    size_t element_count;
} ply;

/* ------------------------------------------------------------------------------------ header -- */

static bool find_type(crease_span word, int *cell)
{
    static const struct {
        const char *names[4];
        int cell;
    } types[] = {{{"char", "int8", "int8_t"}, CREASE_TYPE_INT8},
        {{"uchar", "uint8", "uint8_t", "byte"}, CREASE_TYPE_UINT8},
        {{"short", "int16", "int16_t"}, CREASE_TYPE_INT16},
        {{"ushort", "uint16", "uint16_t"}, CREASE_TYPE_UINT16},
        {{"int", "int32", "int32_t"}, CREASE_TYPE_INT32},
        {{"uint", "uint32", "uint32_t"}, CREASE_TYPE_UINT32},
        {{"float", "float32"}, CREASE_TYPE_FLOAT32}, {{"double", "float64"}, CREASE_TYPE_FLOAT64},
        {{"long", "int64", "int64_t"}, CREASE_CELL_INT64},
        {{"ulong", "uint64", "uint64_t"}, CREASE_CELL_UINT64}};
    for (size_t i = 0; i < sizeof types / sizeof types[0]; i++)
        for (size_t j = 0; j < 4 && types[i].names[j]; j++)
            if (crease_span_is_like(word, types[i].names[j])) {
                *cell = types[i].cell;
                return true;
            }
    return false;
}

static crease_status fail_header(const ply *file, const char *what, crease_span word)
{
    char text[CREASE_EXCERPT_SIZE];
    return crease_fail(file->context, CREASE_ERROR_FORMAT, "%s: line %zu: %s '%s'; mend the header",
        file->source->name, file->cursor.line, what, crease_span_excerpt(word, text));
}

static crease_status read_type(ply *file, crease_span *line, int *cell)
{
    crease_span word;
    if (!crease_span_word(line, &word) || !find_type(word, cell))
        return fail_header(file, "unknown type of a property:", word);
    return CREASE_OK;
}

static crease_status read_list_types(ply *file, crease_span *line, int *cell, int *item)
{
    const crease_span whole = *line;
    crease_status status = read_type(file, line, cell);
    if (status == CREASE_OK && (*cell == CREASE_TYPE_FLOAT32 || *cell == CREASE_TYPE_FLOAT64))
        status = fail_header(file, "the count of a list is no whole number:", whole);
    return status == CREASE_OK ? read_type(file, line, item) : status;
}

static crease_status read_property(ply *file, crease_span line)
{
    if (!file->element_count)
        return fail_header(file, "a property before the first element:", line);
    crease_columns *properties = &file->elements[file->element_count - 1].properties;
    if (properties->count == CREASE_MOST_COLUMNS)
        return fail_header(file, "more than 2048 properties:", line);
    crease_span rest = line, word;
    int cell = 0, item = 0;
    const bool list = crease_span_word(&rest, &word) && crease_span_is(word, "list");
    const crease_status status =
        list ? read_list_types(file, &rest, &cell, &item) : read_type(file, &line, &cell);
    if (status != CREASE_OK)
        return status;
    if (!crease_span_word(list ? &rest : &line, &word))
        return fail_header(file, "a property without a name:", line);
    const crease_status added = crease_columns_add(
        file->context, properties, word, cell, list ? CREASE_ROLE_LIST : CREASE_ROLE_FIELD);
    if (added == CREASE_OK && list)
        properties->items[properties->count - 1].item = item;
    return added;
}

static crease_status read_element(ply *file, crease_span line)
{
    if (file->element_count == MOST_ELEMENTS)
        return fail_header(file, "more than 64 elements:", line);
    element *const made = &file->elements[file->element_count];
    crease_span count = line;
    if (!crease_span_word(&line, &made->name))
        return fail_header(file, "an element without a name:", line);
    if (!crease_span_word(&line, &count) || !crease_span_count(count, &made->count))
        return fail_header(file, "the count of an element is no whole number:", count);
    made->digits = count;
    made->digits.end = line.at;
    file->element_count++;
    return CREASE_OK;
}

static crease_status read_format(ply *file, crease_span line)
{
    static const char *const names[] = {"", "ascii", "binary_little_endian", "binary_big_endian"};
    crease_span word = line;
    crease_span_word(&line, &word);
    for (int i = CODING_ASCII; i <= CODING_BIG; i++)
        if (crease_span_is_like(word, names[i])) {
            file->coding = (coding)i;
            return CREASE_OK;
        }
    return fail_header(file, "unknown format:", word);
}

static crease_status read_header_line(ply *file, crease_span line, crease_span word)
{
    if (crease_span_is(word, "format"))
        return read_format(file, line);
    if (crease_span_is(word, "element"))
        return read_element(file, line);
    if (crease_span_is(word, "property"))
        return read_property(file, line);
    if (crease_span_is(word, "comment") || crease_span_is(word, "obj_info"))
        return CREASE_OK;
    return fail_header(file, "unknown word in the header:", word);
}

static crease_status read_header(ply *file)
{
    crease_span line, word = {NULL, NULL};
    if (!crease_cursor_line(&file->cursor, &line) || !crease_span_is(line, "ply"))
        return crease_fail(file->context, CREASE_ERROR_FORMAT,
            "%s: line 1: does not begin with 'ply'; it is no PLY file, or give it its right "
            "extension",
            file->source->name);
    while (crease_cursor_line(&file->cursor, &line)) {
        if (!crease_span_word(&line, &word))
            continue;
        if (crease_span_is(word, "end_header"))
            return file->coding ? CREASE_OK
                                : fail_header(file, "no line with the format before", word);
        const crease_status status = read_header_line(file, line, word);
        if (status != CREASE_OK)
            return status;
    }
    return crease_fail(file->context, CREASE_ERROR_TRUNCATED,
        "%s: line %zu: ends before end_header; get the whole file", file->source->name,
        file->cursor.line);
}

static element *find_vertices(ply *file)
{
    for (size_t i = 0; i < file->element_count; i++)
        if (crease_span_is(file->elements[i].name, "vertex"))
            return &file->elements[i];
    return NULL;
}

static crease_status fail_truncated(const ply *file, const element *part)
{
    char text[CREASE_EXCERPT_SIZE];
    return crease_fail(file->context, CREASE_ERROR_TRUNCATED,
        "%s: byte %zu: ends before the %llu of element '%s' that its header promises; get the "
        "whole file",
        file->source->name, file->source->size, (unsigned long long)part->count,
        crease_span_excerpt(part->name, text));
}

static bool is_last(const ply *file, const element *part)
{
    return part == &file->elements[file->element_count - 1];
}

static crease_status fail_surplus(const ply *file, const element *vertices)
{
    return crease_fail(file->context, CREASE_ERROR_FORMAT,
        "%s: holds more than the %llu points that its header promises; mend the header",
        file->source->name, (unsigned long long)vertices->count);
}

/* ------------------------------------------------------------------------------------- ascii -- */

/* Passes over the lines of the elements before the vertices. */
static crease_status skip_lines(ply *file, const element *vertices)
{
    crease_span line;
    for (const element *part = file->elements; part < vertices; part++)
        for (uint64_t i = 0; i < part->count && part->properties.count;) {
            if (!crease_cursor_line(&file->cursor, &line))
                return fail_truncated(file, part);
            i += line.at < line.end;
        }
    return CREASE_OK;
}

static crease_status fill_from_table(ply *file, element *vertices, const crease_table *table)
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

static crease_status read_ascii(ply *file, element *vertices, crease_cloud **out)
{
    crease_status status = skip_lines(file, vertices);
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

static crease_order order_of(const ply *file)
{
    return file->coding == CODING_BIG ? CREASE_ORDER_BIG : CREASE_ORDER_LITTLE;
}

/* The least bytes that one of an element takes: its lists empty. */
static size_t least_size(const element *part, bool *lists)
{
    size_t size = 0;
    *lists = false;
    for (size_t i = 0; i < part->properties.count; i++) {
        size += crease_cell_size(part->properties.items[i].cell);
        *lists = *lists || part->properties.items[i].role == CREASE_ROLE_LIST;
    }
    return size;
}

static size_t left(const ply *file)
{
    return (size_t)(file->cursor.end - file->cursor.at);
}

static bool fits(const ply *file, uint64_t count, size_t size)
{
    return !size || count <= left(file) / size;
}

/* Reads one property of one row at the cursor and goes behind it; column NULL: only passes over. */
static crease_status pass_property(
    ply *file, const element *part, const crease_column *property, size_t row, bool store)
{
    const size_t size = crease_cell_size(property->cell);
    if (left(file) < size)
        return fail_truncated(file, part);
    const unsigned char *const from = (const unsigned char *)file->cursor.at;
    file->cursor.at += size;
    if (store && property->values)
        crease_column_copy(property, row, from, order_of(file));
    if (property->role != CREASE_ROLE_LIST)
        return CREASE_OK;
    const double count = crease_cell_load(from, property->cell, order_of(file));
    if (count < 0)
        return crease_fail(file->context, CREASE_ERROR_FORMAT,
            "%s: byte %zu: list '%s' has %.0f entries; the file is damaged, get it again",
            file->source->name, (size_t)((const char *)from - file->source->bytes), property->name,
            count);
    const size_t item = crease_cell_size(property->item);
    if (count > (double)(left(file) / item))
        return fail_truncated(file, part);
    file->cursor.at += (size_t)count * item;
    return CREASE_OK;
}

/* Goes row by row over an element that has lists. */
static crease_status pass_rows(ply *file, const element *part, bool store)
{
    for (uint64_t row = 0; row < part->count; row++)
        for (size_t i = 0; i < part->properties.count; i++) {
            const crease_status status =
                pass_property(file, part, &part->properties.items[i], (size_t)row, store);
            if (status != CREASE_OK)
                return status;
        }
    return CREASE_OK;
}

static crease_status skip_element(ply *file, const element *part)
{
    bool lists = false;
    const size_t size = least_size(part, &lists);
    if (!fits(file, part->count, size))
        return fail_truncated(file, part);
    if (lists)
        return pass_rows(file, part, false);
    file->cursor.at += (size_t)(part->count * size);
    return CREASE_OK;
}

static crease_status fill_vertices(ply *file, element *vertices)
{
    bool lists = false;
    crease_columns *columns = &vertices->properties;
    const size_t size = least_size(vertices, &lists);
    if (!fits(file, vertices->count, size))
        return fail_truncated(file, vertices);
    crease_status status =
        crease_columns_allocate(file->context, file->source, columns, vertices->count);
    if (status != CREASE_OK)
        return status;
    if (lists)
        return pass_rows(file, vertices, true);
    crease_columns_pack(columns);
    status = crease_columns_fill(
        file->context, columns, (const unsigned char *)file->cursor.at, order_of(file));
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

static crease_status read_binary(ply *file, element *vertices, crease_cloud **out)
{
    crease_status status = CREASE_OK;
    for (const element *part = file->elements; part < vertices && status == CREASE_OK; part++)
        status = skip_element(file, part);
    bool lists = false;
    layout points = {
        .first = (size_t)(file->cursor.at - file->source->bytes) + file->source->bytes_before,
        .size = least_size(vertices, &lists)};
    if (lists)
        points.size = 0;
    if (status == CREASE_OK)
        status = fill_vertices(file, vertices);
    if (status != CREASE_OK)
        return status;
    if (left(file) && is_last(file, vertices)) {
        if (points.size && left(file) >= points.size)
            return fail_surplus(file, vertices);
        crease_warn(file->context, "%s: the %zu bytes behind its last point are not read",
            file->source->name, left(file));
    }
    const crease_place place = {
        .unit = lists ? "points from byte" : "byte", .find = find_byte, .user = &points};
    return crease_columns_finish(
        file->context, file->source, file->options, &vertices->properties, place, out);
}

/* ------------------------------------------------------------------------------------- whole -- */

static crease_status read_file(ply *file, crease_cloud **out)
{
    crease_status status = read_header(file);
    if (status != CREASE_OK)
        return status;
    element *const vertices = find_vertices(file);
    if (!vertices)
        return crease_fail(file->context, CREASE_ERROR_FORMAT,
            "%s: its header names no element 'vertex'; there are no points in it",
            file->source->name);
    status = crease_columns_settle(file->context, file->source, &vertices->properties);
    if (status != CREASE_OK)
        return status;
    return file->coding == CODING_ASCII ? read_ascii(file, vertices, out)
                                        : read_binary(file, vertices, out);
}

static ply *open_file(
    crease_context *context, const crease_source *source, const crease_read_options *options)
{
    ply *const file = crease_allocate(context, 1, sizeof *file);
    if (!file)
        return NULL;
    file->context = context;
    file->source = source;
    file->options = options;
    file->cursor = (crease_cursor){.at = source->bytes, .end = source->bytes + source->size};
    return file;
}

static void close_file(ply *file)
{
    for (size_t i = 0; i < file->element_count; i++)
        crease_columns_free(&file->elements[i].properties);
    free(file);
}

crease_status crease_ply_read(crease_context *context, const crease_source *source,
    const crease_read_options *options, crease_cloud **out)
{
    ply *const file = open_file(context, source, options);
    if (!file)
        return CREASE_ERROR_NO_MEMORY;
    const crease_status status = read_file(file, out);
    close_file(file);
    return status;
}

/* ------------------------------------------------------------------------------------ layout -- */

static crease_status find_layout(ply *file, crease_layout *out)
{
    crease_status status = read_header(file);
    if (status != CREASE_OK)
        return status;
    bool lists = true;
    const element *const first = &file->elements[0];
    const bool vertices = file->element_count > 0 && crease_span_is(first->name, "vertex");
    const size_t size = vertices ? least_size(first, &lists) : 0;
    const bool text = file->coding == CODING_ASCII;
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
    ply *const file = open_file(context, head, &options);
    if (!file)
        return CREASE_ERROR_NO_MEMORY;
    const crease_status status = find_layout(file, out);
    close_file(file);
    return status;
}
