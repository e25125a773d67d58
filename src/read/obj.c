/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Wavefront OBJ: the vertices with their colours, and the normals where there is one for each; and
 * the faces. */
#include "base/memory.h"
#include "read/formats.h"
#include "read/table.h"

#include <stdlib.h>

typedef struct obj {
    crease_context *context;
    const crease_source *source;
    crease_table vertices, normals;
    crease_columns columns, normal_columns;
} obj;

/* What stands behind the keyword, or NULL on lines of another one. */
static const char *behind(const char *line, const char *end, const char *keyword)
{
    crease_span rest = {line, end}, word;
    return crease_span_word(&rest, &word) && crease_span_is(word, keyword)
        ? crease_skip_blanks(rest.at, end)
        : NULL;
}

static const char *vertex_data(const char *line, const char *end)
{
    return behind(line, end, "v");
}

static const char *normal_data(const char *line, const char *end)
{
    return behind(line, end, "vn");
}

/* Number of columns of the first vertex. */
static size_t count_columns(const crease_source *source)
{
    crease_cursor cursor = {.at = source->bytes, .end = source->bytes + source->size};
    crease_span line;
    while (crease_cursor_line(&cursor, &line)) {
        const char *data = vertex_data(line.at, line.end);
        if (data)
            return crease_span_words((crease_span){data, line.end});
    }
    return 0;
}

/* x y z, then a weight (which says nothing without curves), then a colour. */
static crease_status add_columns(obj *file)
{
    static const char *const names[] = {"x", "y", "z", "red", "green", "blue", "alpha"};
    const size_t count = count_columns(file->source);
    if (count < 3 || count == 5 || count > 7)
        return crease_fail(file->context, CREASE_ERROR_FORMAT,
            "%s: its vertices have %zu numbers; lines 'v x y z' are needed, with 'r g b' behind if "
            "any",
            file->source->name, count);
    for (size_t i = 0; i < count; i++) {
        const crease_status status =
            crease_columns_add_named(file->context, &file->columns, names[i], CREASE_TYPE_FLOAT64);
        if (status != CREASE_OK)
            return status;
    }
    if (count == 4)
        file->columns.items[3].role = CREASE_ROLE_SKIPPED;
    return CREASE_OK;
}

static crease_status read_table(obj *file, const crease_table *table, crease_columns *columns)
{
    crease_status status = crease_columns_settle(file->context, file->source, columns);
    if (status == CREASE_OK)
        status = crease_columns_allocate(file->context, file->source, columns, table->rows);
    if (status == CREASE_OK)
        status = crease_table_fill(file->context, file->source, table, columns);
    return status;
}

/* Normals are read as points of their own, and become the normals of the vertices. */
static crease_status read_normals(obj *file)
{
    static const char *const names[] = {"x", "y", "z"};
    crease_status status = crease_table_count(file->context, &file->normals);
    if (status != CREASE_OK || !file->normals.rows || file->normals.rows != file->vertices.rows)
        return status;
    for (size_t i = 0; i < 3 && status == CREASE_OK; i++)
        status = crease_columns_add_named(
            file->context, &file->normal_columns, names[i], CREASE_TYPE_FLOAT64);
    if (status == CREASE_OK)
        status = read_table(file, &file->normals, &file->normal_columns);
    if (status != CREASE_OK)
        return status;
    file->columns.normals = file->normal_columns.points;
    file->normal_columns.points = NULL;
    return CREASE_OK;
}

static crease_status read_file(obj *file, const crease_read_options *options, crease_cloud **out)
{
    crease_status status = add_columns(file);
    if (status == CREASE_OK)
        status = crease_table_count(file->context, &file->vertices);
    if (status == CREASE_OK)
        status = read_table(file, &file->vertices, &file->columns);
    if (status == CREASE_OK)
        status = read_normals(file);
    if (status != CREASE_OK)
        return status;
    return crease_columns_finish(file->context, file->source, options, &file->columns,
        crease_table_place(&file->vertices), out);
}

crease_status crease_obj_read(crease_context *context, const crease_source *source,
    const crease_read_options *options, crease_cloud **out)
{
    const crease_table lines = {.begin = source->bytes,
        .end = source->bytes + source->size,
        .first_line = 1,
        .separator = ' '};
    obj file = {.context = context, .source = source, .vertices = lines, .normals = lines};
    file.vertices.data = vertex_data;
    file.normals.data = normal_data;
    const crease_status status = read_file(&file, options, out);
    crease_table_free(&file.vertices);
    crease_table_free(&file.normals);
    crease_columns_free(&file.columns);
    crease_columns_free(&file.normal_columns);
    return status;
}

/* ------------------------------------------------------------------------------------- faces -- */

/* "7/2/1" is vertex 7 and "-1" the last one so far, both counted from 0 here; -1: neither. */
static double vertex_of(crease_span word, size_t so_far)
{
    const bool back = *word.at == '-';
    crease_span digits = {word.at + back, word.at + back};
    uint64_t number = 0;
    while (digits.end < word.end && *digits.end != '/')
        digits.end++;
    if (!crease_span_count(digits, &number))
        return -1;
    return back ? (double)so_far - (double)number : (double)number - 1;
}

static crease_status add_face(
    crease_context *context, crease_facets *facets, crease_span corners, size_t so_far)
{
    crease_status status = CREASE_OK;
    crease_polygon polygon = {0};
    crease_span word;
    while (status == CREASE_OK && crease_span_word(&corners, &word) && *word.at != '#')
        status = crease_facets_add(context, facets, &polygon, vertex_of(word, so_far));
    return status;
}

crease_status crease_obj_faces(
    crease_context *context, const crease_source *source, crease_facets *facets)
{
    crease_cursor cursor = {.at = source->bytes, .end = source->bytes + source->size};
    crease_status status = CREASE_OK;
    crease_span line;
    size_t vertices = 0;
    while (status == CREASE_OK && crease_cursor_line(&cursor, &line)) {
        const char *const corners = behind(line.at, line.end, "f");
        vertices += vertex_data(line.at, line.end) != NULL;
        if (corners)
            status = add_face(context, facets, (crease_span){corners, line.end}, vertices);
    }
    return status;
}
