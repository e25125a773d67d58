/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* OFF of Geomview, ascii and binary (big endian), with normals (N), colours (C) and texture
 * coordinates (ST): the vertices and the faces. */
#include "base/memory.h"
#include "read/binary.h"
#include "read/colour.h"
#include "read/formats.h"
#include "read/table.h"

#include <stdio.h>
#include <string.h>

typedef struct off {
    crease_context *context;
    const crease_source *source;
    const crease_read_options *options;
    crease_cursor cursor;
    bool normals, colours, texture, binary;
    uint64_t vertices, faces;
    const char *faces_at; /* binary: behind the vertices */
    crease_columns columns;
} off;

static crease_status fail(const off *file, const char *what, crease_span word)
{
    char text[CREASE_EXCERPT_SIZE];
    return crease_fail(file->context, CREASE_ERROR_FORMAT, "%s: line %zu: %s '%s'; mend the header",
        file->source->name, file->cursor.line, what, crease_span_excerpt(word, text));
}

static crease_status fail_truncated(const off *file)
{
    return crease_fail(file->context, CREASE_ERROR_TRUNCATED,
        "%s: byte %zu: ends before the %llu vertices that its header promises; get the whole file",
        file->source->name, file->source->size, (unsigned long long)file->vertices);
}

/* ------------------------------------------------------------------------------------ header -- */

/* Takes the next line that holds a word in front of any comment; false at the end. */
static bool next_line(crease_cursor *cursor, crease_span *line)
{
    while (crease_cursor_line(cursor, line))
        if (line->at < line->end && *line->at != '#')
            return true;
    return false;
}

static bool take(crease_span *word, const char *prefix)
{
    const size_t length = strlen(prefix);
    const bool there =
        (size_t)(word->end - word->at) > length && memcmp(word->at, prefix, length) == 0;
    word->at += there ? length : 0;
    return there;
}

/* [ST][C][N]OFF */
static crease_status read_keyword(off *file, crease_span word)
{
    crease_span rest = word;
    file->texture = take(&rest, "ST");
    file->colours = take(&rest, "C");
    file->normals = take(&rest, "N");
    return crease_span_is(rest, "OFF") ? CREASE_OK
                                       : fail(file, "is no OFF, COFF, NOFF of 3 dimensions:", word);
}

static crease_status read_counts(off *file, crease_span line)
{
    crease_span vertices = line, faces = line;
    if (!crease_span_word(&line, &vertices) || !crease_span_count(vertices, &file->vertices))
        return fail(file, "the count of vertices is no whole number:", vertices);
    if (!crease_span_word(&line, &faces) || !crease_span_count(faces, &file->faces))
        return fail(file, "the count of faces is no whole number:", faces);
    return CREASE_OK;
}

static crease_status read_binary_counts(off *file)
{
    if (file->cursor.end - file->cursor.at < 12)
        return fail_truncated(file);
    const unsigned char *at = (const unsigned char *)file->cursor.at;
    const double vertices = crease_cell_load(at, CREASE_TYPE_INT32, CREASE_ORDER_BIG);
    if (vertices < 0)
        return crease_fail(file->context, CREASE_ERROR_FORMAT,
            "%s: byte %zu: promises %.0f vertices; the file is damaged, get it again",
            file->source->name, (size_t)(file->cursor.at - file->source->bytes), vertices);
    const double faces = crease_cell_load(at + 4, CREASE_TYPE_INT32, CREASE_ORDER_BIG);
    file->vertices = (uint64_t)vertices;
    file->faces = faces > 0 ? (uint64_t)faces : 0;
    file->cursor.at += 12;
    return CREASE_OK;
}

static crease_status read_header(off *file)
{
    crease_span line, word = {NULL, NULL};
    if (!next_line(&file->cursor, &line) || !crease_span_word(&line, &word))
        return fail_truncated(file);
    const crease_status status = read_keyword(file, word);
    if (status != CREASE_OK)
        return status;
    crease_span rest = line;
    if (crease_span_word(&rest, &word) && *word.at != '#') {
        file->binary = crease_span_is_like(word, "binary");
        return file->binary ? read_binary_counts(file) : read_counts(file, line);
    }
    return next_line(&file->cursor, &line) ? read_counts(file, line) : fail_truncated(file);
}

/* ----------------------------------------------------------------------------------- columns -- */

static crease_status add_columns(
    off *file, const char *const *names, size_t count, int cell, bool wanted)
{
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < count && wanted && status == CREASE_OK; i++)
        status = crease_columns_add_named(file->context, &file->columns, names[i], cell);
    return status;
}

/* Columns in the order of the format; `colours` values of the colour. */
static crease_status lay_out(off *file, int cell, size_t colours)
{
    static const char *const points[] = {"x", "y", "z"}, *const normals[] = {"nx", "ny", "nz"};
    static const char *const colour[] = {"red", "green", "blue", "alpha"};
    static const char *const texture[] = {"s", "t"};
    crease_status status = add_columns(file, points, 3, cell, true);
    if (status == CREASE_OK)
        status = add_columns(file, normals, 3, cell, file->normals);
    if (status == CREASE_OK)
        status = add_columns(file, colour, colours, cell, true);
    if (status == CREASE_OK)
        status = add_columns(file, texture, 2, cell, file->texture);
    if (status == CREASE_OK)
        status = crease_columns_settle(file->context, file->source, &file->columns);
    return status;
}

/* ------------------------------------------------------------------------------------- ascii -- */

/* The first vertex tells whether its colour has 3 values, 4, or there is none after all. */
static crease_status find_columns(off *file)
{
    crease_cursor ahead = file->cursor;
    crease_span line = {NULL, NULL};
    const size_t others = 3 + (file->normals ? 3u : 0u) + (file->texture ? 2u : 0u);
    const size_t count =
        file->vertices && next_line(&ahead, &line) ? crease_span_words(line) : others;
    const size_t colours = count > others ? count - others : 0;
    if (count < others || (colours != 0 && colours != 3 && colours != 4))
        return crease_fail(file->context, CREASE_ERROR_FORMAT,
            "%s: line %zu: a vertex has %zu numbers; %zu are needed, with a colour of 3 or 4 if "
            "any",
            file->source->name, ahead.line, count, others);
    return lay_out(file, CREASE_TYPE_FLOAT64, colours);
}

static crease_status check_rows(const off *file, size_t rows)
{
    if (rows < file->vertices)
        return fail_truncated(file);
    if (rows > file->vertices && !file->faces)
        return crease_fail(file->context, CREASE_ERROR_FORMAT,
            "%s: holds more than the %llu vertices that its header promises; mend the header",
            file->source->name, (unsigned long long)file->vertices);
    return CREASE_OK;
}

static crease_status read_table(off *file, crease_table *table, crease_cloud **out)
{
    crease_status status = crease_table_count(file->context, table);
    if (status == CREASE_OK)
        status = check_rows(file, table->rows);
    if (status == CREASE_OK)
        status =
            crease_columns_allocate(file->context, file->source, &file->columns, file->vertices);
    if (status == CREASE_OK)
        status = crease_table_fill(file->context, file->source, table, &file->columns);
    if (status == CREASE_OK)
        status = crease_colours_narrow(file->context, &file->columns, NULL);
    if (status != CREASE_OK)
        return status;
    return crease_columns_finish(
        file->context, file->source, file->options, &file->columns, crease_table_place(table), out);
}

static crease_status read_ascii(off *file, crease_cloud **out)
{
    crease_table table = {.begin = file->cursor.at,
        .end = file->cursor.end,
        .first_line = file->cursor.line + 1,
        .data = crease_table_data_uncommented,
        .separator = ' '};
    crease_status status = find_columns(file);
    if (status == CREASE_OK)
        status = read_table(file, &table, out);
    crease_table_free(&table);
    return status;
}

/* ------------------------------------------------------------------------------------ binary -- */

static size_t find_byte(const void *user, size_t row)
{
    const off *const file = user;
    return (size_t)(file->cursor.at - file->source->bytes) + row * file->columns.items[0].stride;
}

static crease_status read_binary(off *file, crease_cloud **out)
{
    crease_status status = lay_out(file, CREASE_TYPE_FLOAT32, file->colours ? 4 : 0);
    if (status != CREASE_OK)
        return status;
    const size_t size = crease_columns_pack(&file->columns);
    if (file->vertices > (size_t)(file->cursor.end - file->cursor.at) / size)
        return fail_truncated(file);
    file->faces_at = file->cursor.at + file->vertices * size;
    status = crease_columns_allocate(file->context, file->source, &file->columns, file->vertices);
    if (status == CREASE_OK)
        status = crease_columns_fill(file->context, &file->columns,
            (const unsigned char *)file->cursor.at, CREASE_ORDER_BIG);
    if (status != CREASE_OK)
        return status;
    return crease_columns_finish(file->context, file->source, file->options, &file->columns,
        (crease_place){.unit = "byte", .find = find_byte, .user = file}, out);
}

static crease_status read_file(off *file, crease_cloud **out)
{
    const crease_status status = read_header(file);
    if (status != CREASE_OK)
        return status;
    return file->binary ? read_binary(file, out) : read_ascii(file, out);
}

static off open_file(
    crease_context *context, const crease_source *source, const crease_read_options *options)
{
    return (off){.context = context,
        .source = source,
        .options = options,
        .cursor = {.at = source->bytes, .end = source->bytes + source->size}};
}

crease_status crease_off_read(crease_context *context, const crease_source *source,
    const crease_read_options *options, crease_cloud **out)
{
    off file = open_file(context, source, options);
    const crease_status status = read_file(&file, out);
    crease_columns_free(&file.columns);
    return status;
}

/* ------------------------------------------------------------------------------------- faces -- */

static crease_status fail_faces(const off *file)
{
    return crease_fail(file->context, CREASE_ERROR_TRUNCATED,
        "%s: byte %zu: ends before the %llu faces that its header promises; get the whole file, or "
        "read "
        "its vertices alone with --mesh-points 0",
        file->source->name, file->source->size, (unsigned long long)file->faces);
}

/* "3 0 1 2", and a colour that says nothing here. */
static crease_status add_line(off *file, crease_span line, crease_facets *facets)
{
    crease_polygon polygon = {0};
    crease_status status = CREASE_OK;
    crease_span word = line;
    uint64_t corners = 0, vertex = 0;
    if (!crease_span_word(&line, &word) || !crease_span_count(word, &corners))
        return fail(file, "the count of a face's corners is no whole number:", word);
    for (uint64_t i = 0; i < corners && status == CREASE_OK; i++)
        status = crease_span_word(&line, &word) && crease_span_count(word, &vertex)
            ? crease_facets_add(file->context, facets, &polygon, (double)vertex)
            : fail(file, "a corner of a face is no whole number:", word);
    return status;
}

static crease_status add_lines(off *file, crease_facets *facets)
{
    crease_span line;
    crease_status status = CREASE_OK;
    for (uint64_t i = 0; i < file->vertices + file->faces && status == CREASE_OK; i++) {
        if (!next_line(&file->cursor, &line))
            return i < file->vertices ? fail_truncated(file) : fail_faces(file);
        if (i >= file->vertices)
            status = add_line(file, line, facets);
    }
    return status;
}

/* The next whole number of four bytes; -1 at the end of the file. */
static double take_number(off *file)
{
    if (file->cursor.end - file->cursor.at < 4)
        return -1;
    file->cursor.at += 4;
    return crease_cell_load(
        (const unsigned char *)file->cursor.at - 4, CREASE_TYPE_INT32, CREASE_ORDER_BIG);
}

/* Corners, their number before them, and a colour, the number of its values before it. */
static crease_status add_record(off *file, crease_facets *facets)
{
    crease_polygon polygon = {0};
    crease_status status = CREASE_OK;
    const double corners = take_number(file);
    if (corners < 0 || corners > (double)(file->cursor.end - file->cursor.at) / 4)
        return fail_faces(file);
    for (double i = 0; i < corners && status == CREASE_OK; i++)
        status = crease_facets_add(file->context, facets, &polygon, take_number(file));
    const double colours = take_number(file);
    if (status == CREASE_OK &&
        (colours < 0 || colours > (double)(file->cursor.end - file->cursor.at) / 4))
        return fail_faces(file);
    file->cursor.at += status == CREASE_OK ? 4 * (size_t)colours : 0;
    return status;
}

crease_status crease_off_faces(
    crease_context *context, const crease_source *source, crease_facets *facets)
{
    const crease_read_options options = crease_read_options_default();
    off file = open_file(context, source, &options);
    crease_cloud *cloud = NULL;
    crease_status status = read_header(&file);
    if (status == CREASE_OK && file.binary)
        status = read_binary(&file, &cloud);
    if (status == CREASE_OK && !file.binary)
        status = add_lines(&file, facets);
    file.cursor.at = file.binary ? file.faces_at : file.cursor.at;
    for (uint64_t i = 0; i < file.faces && file.binary && status == CREASE_OK; i++)
        status = add_record(&file, facets);
    crease_cloud_free(cloud);
    crease_columns_free(&file.columns);
    return status;
}
