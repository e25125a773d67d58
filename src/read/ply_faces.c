/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The faces of a PLY file: the lists `vertex_indices` of its element `face`. */
#include "read/formats.h"
#include "read/ply_header.h"

#include <string.h>

typedef struct faces {
    crease_ply *file;
    crease_facets *facets;
} faces;

static bool is_corners(const crease_column *property)
{
    return property->role == CREASE_ROLE_LIST &&
        (strcmp(property->name, "vertex_indices") == 0 ||
            strcmp(property->name, "vertex_index") == 0);
}

static bool has_corners(const crease_ply_element *part)
{
    for (size_t i = 0; part && i < part->properties.count; i++)
        if (is_corners(&part->properties.items[i]))
            return true;
    return false;
}

/* ------------------------------------------------------------------------------------- ascii -- */

static crease_status fail_line(const faces *run, const char *what)
{
    return crease_fail(run->file->context, CREASE_ERROR_FORMAT,
        "%s: line %zu: %s; mend the file, or read its vertices alone with --mesh-points 0",
        run->file->source->name, run->file->cursor.line, what);
}

static crease_status take_list(const faces *run, crease_span *line, bool corners)
{
    crease_span word;
    crease_polygon polygon = {0};
    crease_status status = CREASE_OK;
    uint64_t count = 0, vertex = 0;
    if (!crease_span_word(line, &word) || !crease_span_count(word, &count))
        return fail_line(run, "the count of a list is no whole number");
    for (uint64_t i = 0; i < count && status == CREASE_OK; i++) {
        if (!crease_span_word(line, &word))
            return fail_line(run, "a face ends before its list does");
        if (corners && !crease_span_count(word, &vertex))
            return fail_line(run, "a corner of a face is no whole number");
        if (corners)
            status = crease_facets_add(run->file->context, run->facets, &polygon, (double)vertex);
    }
    return status;
}

static crease_status read_line(const faces *run, const crease_ply_element *part, crease_span line)
{
    crease_status status = CREASE_OK;
    crease_span word;
    for (size_t i = 0; i < part->properties.count && status == CREASE_OK; i++) {
        const crease_column *const property = &part->properties.items[i];
        if (property->role == CREASE_ROLE_LIST)
            status = take_list(run, &line, is_corners(property));
        else if (!crease_span_word(&line, &word))
            status = fail_line(run, "a face ends before its last property");
    }
    return status;
}

static crease_status read_lines(const faces *run, const crease_ply_element *part)
{
    crease_span line;
    crease_status status = crease_ply_skip_lines(run->file, part);
    for (uint64_t i = 0; i < part->count && status == CREASE_OK;) {
        if (!crease_cursor_line(&run->file->cursor, &line))
            return crease_ply_fail_truncated(run->file, part);
        if (line.at == line.end)
            continue;
        status = read_line(run, part, line);
        i++;
    }
    return status;
}

/* ------------------------------------------------------------------------------------ binary -- */

static crease_status add_list(
    void *user, const crease_column *list, const unsigned char *values, size_t count)
{
    const faces *const run = user;
    const size_t size = crease_cell_size(list->item);
    crease_polygon polygon = {0};
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < count && is_corners(list) && status == CREASE_OK; i++)
        status = crease_facets_add(run->file->context, run->facets, &polygon,
            crease_cell_load(values + i * size, list->item, crease_ply_order(run->file)));
    return status;
}

static crease_status read_records(faces *run, const crease_ply_element *part)
{
    crease_status status = CREASE_OK;
    bool lists = false;
    for (const crease_ply_element *before = run->file->elements;
         before < part && status == CREASE_OK; before++)
        status = crease_ply_skip(run->file, before);
    if (status == CREASE_OK &&
        !crease_ply_fits(run->file, part->count, crease_ply_least_size(part, &lists)))
        status = crease_ply_fail_truncated(run->file, part);
    return status == CREASE_OK ? crease_ply_pass_rows(run->file, part, false, add_list, run)
                               : status;
}

crease_status crease_ply_faces(
    crease_context *context, const crease_source *source, crease_facets *facets)
{
    const crease_read_options options = crease_read_options_default();
    crease_ply *const file = crease_ply_open(context, source, &options);
    faces run = {.file = file, .facets = facets};
    crease_status status = file ? crease_ply_read_header(file) : CREASE_ERROR_NO_MEMORY;
    const crease_ply_element *const part =
        status == CREASE_OK ? crease_ply_find(file, "face") : NULL;
    if (has_corners(part))
        status =
            file->coding == CREASE_PLY_ASCII ? read_lines(&run, part) : read_records(&run, part);
    if (file)
        crease_ply_close(file);
    return status;
}
