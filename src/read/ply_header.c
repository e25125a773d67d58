/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "read/ply_header.h"

#include "base/memory.h"

#include <stdlib.h>

crease_ply *crease_ply_open(
    crease_context *context, const crease_source *source, const crease_read_options *options)
{
    crease_ply *const file = crease_allocate(context, 1, sizeof *file);
    if (!file)
        return NULL;
    file->context = context;
    file->source = source;
    file->options = options;
    file->cursor = (crease_cursor){.at = source->bytes, .end = source->bytes + source->size};
    return file;
}

void crease_ply_close(crease_ply *file)
{
    for (size_t i = 0; i < file->element_count; i++)
        crease_columns_free(&file->elements[i].properties);
    free(file);
}

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

static crease_status fail_header(const crease_ply *file, const char *what, crease_span word)
{
    char text[CREASE_EXCERPT_SIZE];
    return crease_fail(file->context, CREASE_ERROR_FORMAT, "%s: line %zu: %s '%s'; mend the header",
        file->source->name, file->cursor.line, what, crease_span_excerpt(word, text));
}

static crease_status read_type(crease_ply *file, crease_span *line, int *cell)
{
    crease_span word;
    if (!crease_span_word(line, &word) || !find_type(word, cell))
        return fail_header(file, "unknown type of a property:", word);
    return CREASE_OK;
}

static crease_status read_list_types(crease_ply *file, crease_span *line, int *cell, int *item)
{
    const crease_span whole = *line;
    crease_status status = read_type(file, line, cell);
    if (status == CREASE_OK && (*cell == CREASE_TYPE_FLOAT32 || *cell == CREASE_TYPE_FLOAT64))
        status = fail_header(file, "the count of a list is no whole number:", whole);
    return status == CREASE_OK ? read_type(file, line, item) : status;
}

static crease_status read_property(crease_ply *file, crease_span line)
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

static crease_status read_element(crease_ply *file, crease_span line)
{
    if (file->element_count == CREASE_PLY_MOST_ELEMENTS)
        return fail_header(file, "more than 64 elements:", line);
    crease_ply_element *const made = &file->elements[file->element_count];
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

static crease_status read_format(crease_ply *file, crease_span line)
{
    static const char *const names[] = {"", "ascii", "binary_little_endian", "binary_big_endian"};
    crease_span word = line;
    crease_span_word(&line, &word);
    for (int i = CREASE_PLY_ASCII; i <= CREASE_PLY_BIG; i++)
        if (crease_span_is_like(word, names[i])) {
            file->coding = (crease_ply_coding)i;
            return CREASE_OK;
        }
    return fail_header(file, "unknown format:", word);
}

static crease_status read_header_line(crease_ply *file, crease_span line, crease_span word)
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

crease_status crease_ply_read_header(crease_ply *file)
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

crease_ply_element *crease_ply_find(crease_ply *file, const char *name)
{
    for (size_t i = 0; i < file->element_count; i++)
        if (crease_span_is(file->elements[i].name, name))
            return &file->elements[i];
    return NULL;
}

crease_status crease_ply_fail_truncated(const crease_ply *file, const crease_ply_element *part)
{
    char text[CREASE_EXCERPT_SIZE];
    return crease_fail(file->context, CREASE_ERROR_TRUNCATED,
        "%s: byte %zu: ends before the %llu of element '%s' that its header promises; get the "
        "whole file",
        file->source->name, file->source->size, (unsigned long long)part->count,
        crease_span_excerpt(part->name, text));
}
