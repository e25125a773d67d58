/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Going over the elements of a PLY file. */
#include "read/ply_header.h"

crease_status crease_ply_skip_lines(crease_ply *file, const crease_ply_element *until)
{
    crease_span line;
    for (const crease_ply_element *part = file->elements; part < until; part++)
        for (uint64_t i = 0; i < part->count && part->properties.count;) {
            if (!crease_cursor_line(&file->cursor, &line))
                return crease_ply_fail_truncated(file, part);
            i += line.at < line.end;
        }
    return CREASE_OK;
}

crease_order crease_ply_order(const crease_ply *file)
{
    return file->coding == CREASE_PLY_BIG ? CREASE_ORDER_BIG : CREASE_ORDER_LITTLE;
}

size_t crease_ply_least_size(const crease_ply_element *part, bool *lists)
{
    size_t size = 0;
    *lists = false;
    for (size_t i = 0; i < part->properties.count; i++) {
        size += crease_cell_size(part->properties.items[i].cell);
        *lists = *lists || part->properties.items[i].role == CREASE_ROLE_LIST;
    }
    return size;
}

size_t crease_ply_left(const crease_ply *file)
{
    return (size_t)(file->cursor.end - file->cursor.at);
}

bool crease_ply_fits(const crease_ply *file, uint64_t count, size_t size)
{
    return !size || count <= crease_ply_left(file) / size;
}

/* Who is told of lists. */
typedef struct listener {
    crease_ply_list_body *body;
    void *user;
} listener;

/* Reads one property of one row at the cursor and goes behind it. */
static crease_status pass_property(crease_ply *file, const crease_ply_element *part,
    const crease_column *property, size_t row, bool store, listener told)
{
    const size_t size = crease_cell_size(property->cell);
    if (crease_ply_left(file) < size)
        return crease_ply_fail_truncated(file, part);
    const unsigned char *const from = (const unsigned char *)file->cursor.at;
    file->cursor.at += size;
    if (store && property->values)
        crease_column_copy(property, row, from, crease_ply_order(file));
    if (property->role != CREASE_ROLE_LIST)
        return CREASE_OK;
    const double count = crease_cell_load(from, property->cell, crease_ply_order(file));
    if (count < 0)
        return crease_fail(file->context, CREASE_ERROR_FORMAT,
            "%s: byte %zu: list '%s' has %.0f entries; the file is damaged, get it again",
            file->source->name, (size_t)((const char *)from - file->source->bytes), property->name,
            count);
    const size_t item = crease_cell_size(property->item);
    if (count > (double)(crease_ply_left(file) / item))
        return crease_ply_fail_truncated(file, part);
    const unsigned char *const values = (const unsigned char *)file->cursor.at;
    file->cursor.at += (size_t)count * item;
    return told.body ? told.body(told.user, property, values, (size_t)count) : CREASE_OK;
}

crease_status crease_ply_pass_rows(crease_ply *file, const crease_ply_element *part, bool store,
    crease_ply_list_body *body, void *user)
{
    const listener told = {body, user};
    for (uint64_t row = 0; row < part->count; row++)
        for (size_t i = 0; i < part->properties.count; i++) {
            const crease_status status =
                pass_property(file, part, &part->properties.items[i], (size_t)row, store, told);
            if (status != CREASE_OK)
                return status;
        }
    return CREASE_OK;
}

crease_status crease_ply_skip(crease_ply *file, const crease_ply_element *part)
{
    bool lists = false;
    const size_t size = crease_ply_least_size(part, &lists);
    if (!crease_ply_fits(file, part->count, size))
        return crease_ply_fail_truncated(file, part);
    if (lists)
        return crease_ply_pass_rows(file, part, false, NULL, NULL);
    file->cursor.at += (size_t)(part->count * size);
    return CREASE_OK;
}
