/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* PCD of the Point Cloud Library, version 0.7 and before: ascii, binary, binary_compressed. A field
 * of COUNT n becomes n fields name_0 ...; a packed `rgb` becomes red, green and blue. */
#include "base/memory.h"
#include "read/binary.h"
#include "read/colour.h"
#include "read/formats.h"
#include "read/lzf.h"
#include "read/table.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef enum coding { CODING_ASCII, CODING_BINARY, CODING_COMPRESSED } coding;

typedef struct pcd {
    crease_context *context;
    const crease_source *source;
    const crease_read_options *options;
    crease_cursor cursor;
    /* What stands behind the words of the header; at NULL where the word was not there. */
    crease_span fields, size, type, count, width, height, points, data;
    coding coding;
    uint64_t rows;
    size_t record, padding; /* bytes of a point, and how many of them are padding */
    crease_columns columns;
} pcd;

/* ------------------------------------------------------------------------------------ header -- */

/* Number of the line on which a word of the header stands. */
static size_t line_of(const pcd *file, crease_span word)
{
    size_t line = 1;
    for (const char *at = file->source->bytes; at < word.at; at++)
        line += *at == '\n';
    return line;
}

static crease_status fail_header(const pcd *file, const char *what, crease_span word)
{
    char text[CREASE_EXCERPT_SIZE];
    return crease_fail(file->context, CREASE_ERROR_FORMAT, "%s: line %zu: %s '%s'; mend the header",
        file->source->name, line_of(file, word), what, crease_span_excerpt(word, text));
}

static crease_span *find_entry(pcd *file, crease_span word)
{
    const struct {
        const char *name;
        crease_span *entry;
    } entries[] = {{"fields", &file->fields}, {"columns", &file->fields}, {"size", &file->size},
        {"type", &file->type}, {"count", &file->count}, {"width", &file->width},
        {"height", &file->height}, {"points", &file->points}, {"data", &file->data}};
    for (size_t i = 0; i < sizeof entries / sizeof entries[0]; i++)
        if (crease_span_is_like(word, entries[i].name))
            return entries[i].entry;
    return NULL;
}

static crease_status read_lines(pcd *file)
{
    crease_span line, word;
    while (!file->data.at) {
        if (!crease_cursor_line(&file->cursor, &line))
            return crease_fail(file->context, CREASE_ERROR_TRUNCATED,
                "%s: line %zu: ends before DATA; get the whole file", file->source->name,
                file->cursor.line);
        if (!crease_span_word(&line, &word) || *word.at == '#')
            continue;
        crease_span *entry = find_entry(file, word);
        if (entry)
            *entry = line;
        else if (!crease_span_is_like(word, "version") && !crease_span_is_like(word, "viewpoint"))
            return fail_header(file, "unknown word in the header:", word);
    }
    return CREASE_OK;
}

static crease_status read_coding(pcd *file)
{
    static const char *const names[] = {"ascii", "binary", "binary_compressed"};
    crease_span line = file->data, word;
    crease_span_word(&line, &word);
    for (int i = CODING_ASCII; i <= CODING_COMPRESSED; i++)
        if (crease_span_is_like(word, names[i])) {
            file->coding = (coding)i;
            return CREASE_OK;
        }
    return fail_header(file, "unknown kind of DATA:", word);
}

static bool read_count(crease_span line, uint64_t otherwise, uint64_t *count)
{
    crease_span word;
    *count = otherwise;
    return !line.at || (crease_span_word(&line, &word) && crease_span_count(word, count));
}

static crease_status read_rows(pcd *file)
{
    uint64_t width = 0, height = 0, product = 0;
    if (!read_count(file->width, 0, &width))
        return fail_header(file, "WIDTH is no whole number:", file->width);
    if (!read_count(file->height, 1, &height))
        return fail_header(file, "HEIGHT is no whole number:", file->height);
    if (__builtin_mul_overflow(width, height, &product) || product > INT64_MAX)
        return fail_header(file, "WIDTH is too large:", file->width);
    if (!read_count(file->points, product, &file->rows))
        return fail_header(file, "POINTS is no whole number:", file->points);
    if (!file->points.at && !file->width.at)
        return fail_header(file, "there is neither POINTS nor WIDTH before DATA", file->data);
    if (file->width.at && file->rows != product)
        return fail_header(file, "POINTS is not WIDTH times HEIGHT:", file->points);
    return CREASE_OK;
}

/* ------------------------------------------------------------------------------------ fields -- */

static bool find_cell(crease_span type, uint64_t size, int *cell)
{
    static const struct {
        const char *type;
        uint64_t size;
        int cell;
    } cells[] = {{"i", 1, CREASE_TYPE_INT8}, {"u", 1, CREASE_TYPE_UINT8},
        {"i", 2, CREASE_TYPE_INT16}, {"u", 2, CREASE_TYPE_UINT16}, {"i", 4, CREASE_TYPE_INT32},
        {"u", 4, CREASE_TYPE_UINT32}, {"f", 4, CREASE_TYPE_FLOAT32}, {"f", 8, CREASE_TYPE_FLOAT64},
        {"i", 8, CREASE_CELL_INT64}, {"u", 8, CREASE_CELL_UINT64}};
    for (size_t i = 0; i < sizeof cells / sizeof cells[0]; i++)
        if (size == cells[i].size && crease_span_is_like(type, cells[i].type)) {
            *cell = cells[i].cell;
            return true;
        }
    return false;
}

/* Adds the columns of one field. Offset and stride are those of points one after the other. */
static crease_status add_field(pcd *file, crease_span name, int cell, uint64_t count)
{
    const bool padding = crease_span_is(name, "_");
    const size_t size = crease_cell_size(cell);
    char numbered[256];
    crease_span called = name;
    for (uint64_t i = 0; i < count; i++) {
        if (count > 1) {
            const int length = snprintf(numbered, sizeof numbered, "%.*s_%u",
                (int)(name.end - name.at < 200 ? name.end - name.at : 200), name.at, (unsigned)i);
            called = (crease_span){numbered, numbered + length};
        }
        const crease_status status = crease_columns_add(file->context, &file->columns, called, cell,
            padding ? CREASE_ROLE_SKIPPED : CREASE_ROLE_FIELD);
        if (status != CREASE_OK)
            return status;
        crease_column *column = &file->columns.items[file->columns.count - 1];
        column->offset = file->record + (size_t)i * size;
        column->stride = (size_t)count * size;
    }
    file->record += (size_t)count * size;
    file->padding += padding ? (size_t)count * size : 0;
    return CREASE_OK;
}

static crease_status read_fields(pcd *file)
{
    crease_span fields = file->fields, sizes = file->size, types = file->type;
    crease_span counts = file->count, name, word, type = fields;
    while (fields.at && crease_span_word(&fields, &name)) {
        uint64_t size = 4, count = 1;
        int cell = 0;
        if (!crease_span_word(&sizes, &word) || !crease_span_count(word, &size))
            return fail_header(file, "there is no SIZE for field", name);
        if (!crease_span_word(&types, &type) || !find_cell(type, size, &cell))
            return fail_header(file, "there is no such TYPE and SIZE, of field", name);
        if (counts.at && (!crease_span_word(&counts, &word) || !crease_span_count(word, &count)))
            return fail_header(file, "there is no COUNT for field", name);
        if (count > CREASE_MOST_COLUMNS || file->columns.count + count > CREASE_MOST_COLUMNS)
            return fail_header(file, "more than 2048 values for a point, with field", name);
        const crease_status status = add_field(file, name, cell, count);
        if (status != CREASE_OK)
            return status;
    }
    return crease_columns_settle(file->context, file->source, &file->columns);
}

static crease_status read_header(pcd *file)
{
    crease_status status = read_lines(file);
    if (status == CREASE_OK)
        status = read_coding(file);
    if (status == CREASE_OK)
        status = read_rows(file);
    return status == CREASE_OK ? read_fields(file) : status;
}

/* -------------------------------------------------------------------------------------- data -- */

static crease_status finish(pcd *file, crease_place place, crease_cloud **out)
{
    const crease_status status = crease_colours_unpack(file->context, &file->columns);
    if (status != CREASE_OK)
        return status;
    return crease_columns_finish(
        file->context, file->source, file->options, &file->columns, place, out);
}

static crease_status check_rows(const pcd *file, uint64_t rows)
{
    if (rows == file->rows)
        return CREASE_OK;
    return crease_fail(file->context,
        rows < file->rows ? CREASE_ERROR_TRUNCATED : CREASE_ERROR_FORMAT,
        "%s: holds %llu points where its header promises %llu; %s", file->source->name,
        (unsigned long long)rows, (unsigned long long)file->rows,
        rows < file->rows ? "get the whole file" : "mend the header");
}

static crease_status read_table(pcd *file, crease_table *table, crease_cloud **out)
{
    crease_status status = crease_table_count(file->context, table);
    if (status == CREASE_OK)
        status = check_rows(file, table->rows);
    if (status == CREASE_OK)
        status = crease_columns_allocate(file->context, file->source, &file->columns, file->rows);
    if (status == CREASE_OK)
        status = crease_table_fill(file->context, file->source, table, &file->columns);
    return status == CREASE_OK ? finish(file, crease_table_place(table), out) : status;
}

static crease_status read_ascii(pcd *file, crease_cloud **out)
{
    crease_table table = {.begin = file->cursor.at,
        .end = file->cursor.end,
        .first_line = file->cursor.line + 1,
        .data = crease_table_data_uncommented,
        .separator = ' '};
    const crease_status status = read_table(file, &table, out);
    crease_table_free(&table);
    return status;
}

static size_t find_byte(const void *user, size_t row)
{
    const pcd *const file = user;
    return (size_t)(file->cursor.at - file->source->bytes) + row * file->record;
}

static crease_status read_binary(pcd *file, crease_cloud **out)
{
    const size_t left = (size_t)(file->cursor.end - file->cursor.at);
    if (left / file->record != file->rows)
        return check_rows(file, left / file->record);
    if (left % file->record)
        crease_warn(file->context, "%s: the %zu bytes behind its last point are not read",
            file->source->name, left % file->record);
    for (size_t i = 0; i < file->columns.count; i++)
        file->columns.items[i].stride = file->record;
    crease_status status =
        crease_columns_allocate(file->context, file->source, &file->columns, file->rows);
    if (status == CREASE_OK)
        status = crease_columns_fill(file->context, &file->columns,
            (const unsigned char *)file->cursor.at, CREASE_ORDER_LITTLE);
    return status == CREASE_OK
        ? finish(file, (crease_place){.unit = "byte", .find = find_byte, .user = file}, out)
        : status;
}

static crease_status fail_compressed(const pcd *file, const char *what)
{
    return crease_fail(file->context, CREASE_ERROR_FORMAT,
        "%s: byte %zu: its compressed data %s; the file is damaged, get it again",
        file->source->name, (size_t)(file->cursor.at - file->source->bytes), what);
}

/* Expanded data hold the values of one field after the other. Programs differ in whether padding
 * is among them; the size tells. */
static bool lay_out_fields(pcd *file, uint64_t expanded)
{
    if (file->rows > UINT32_MAX)
        return false;
    const bool padded = expanded == file->rows * file->record;
    if (!padded && expanded != file->rows * (file->record - file->padding))
        return false;
    size_t before = 0, values = 0;
    for (size_t i = 0; i < file->columns.count; i += values) {
        const size_t field_size = file->columns.items[i].stride;
        const size_t size = crease_cell_size(file->columns.items[i].cell);
        const bool present = padded || file->columns.items[i].role != CREASE_ROLE_SKIPPED;
        values = field_size / size;
        for (size_t k = 0; k < values; k++)
            file->columns.items[i + k].offset = before * (size_t)file->rows + k * size;
        before += present ? field_size : 0;
    }
    return true;
}

static uint32_t read_size(const char *from)
{
    const unsigned char *bytes = (const unsigned char *)from;
    return bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

static crease_status fill_expanded(pcd *file, uint32_t packed, uint32_t expanded)
{
    unsigned char *bytes = crease_allocate(file->context, expanded, 1);
    if (!bytes)
        return CREASE_ERROR_NO_MEMORY;
    crease_status status = CREASE_OK;
    if (!crease_lzf_expand((const unsigned char *)file->cursor.at, packed, bytes, expanded))
        status = fail_compressed(file, "do not expand to the size they give");
    if (status == CREASE_OK)
        status = crease_columns_allocate(file->context, file->source, &file->columns, file->rows);
    if (status == CREASE_OK)
        status = crease_columns_fill(file->context, &file->columns, bytes, CREASE_ORDER_LITTLE);
    free(bytes);
    return status;
}

static size_t find_data(const void *user, size_t row)
{
    (void)row;
    const pcd *const file = user;
    return (size_t)(file->cursor.at - file->source->bytes);
}

static crease_status read_compressed(pcd *file, crease_cloud **out)
{
    const size_t left = (size_t)(file->cursor.end - file->cursor.at);
    if (left < 8)
        return crease_fail(file->context, CREASE_ERROR_TRUNCATED,
            "%s: byte %zu: ends before the sizes of its compressed data; get the whole file",
            file->source->name, file->source->size);
    const uint32_t packed = read_size(file->cursor.at);
    const uint32_t expanded = read_size(file->cursor.at + 4);
    file->cursor.at += 8;
    if (packed > left - 8)
        return crease_fail(file->context, CREASE_ERROR_TRUNCATED,
            "%s: byte %zu: ends before the %u bytes of its compressed data; get the whole file",
            file->source->name, file->source->size, packed);
    if (!lay_out_fields(file, expanded))
        return fail_compressed(file, "are not of the size that its header promises");
    if (expanded / CREASE_LZF_MOST_GROWTH > packed)
        return fail_compressed(file, "are too short for what they promise");
    const crease_status status = fill_expanded(file, packed, expanded);
    const crease_place place = {.unit = "data from byte", .find = find_data, .user = file};
    return status == CREASE_OK ? finish(file, place, out) : status;
}

crease_status crease_pcd_read(crease_context *context, const crease_source *source,
    const crease_read_options *options, crease_cloud **out)
{
    pcd file = {.context = context,
        .source = source,
        .options = options,
        .cursor = {.at = source->bytes, .end = source->bytes + source->size}};
    crease_status status = read_header(&file);
    if (status == CREASE_OK && file.coding == CODING_ASCII)
        status = read_ascii(&file, out);
    else if (status == CREASE_OK && file.coding == CODING_BINARY)
        status = read_binary(&file, out);
    else if (status == CREASE_OK)
        status = read_compressed(&file, out);
    crease_columns_free(&file.columns);
    return status;
}
