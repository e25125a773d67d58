/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Some rows are read as a small file of their own: the header, with their number in place of that
 * of all rows, and their bytes. So every reader has to know one form of its format only. Text has
 * its rows counted first, and read once for what only all of them tell. */
#include "read/rows.h"

#include "base/memory.h"
#include "read/formats.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { HEAD_ROOM = 1 << 20, DIGITS = 24, AT_ONCE = 1 << 14 };

struct crease_rows {
    const char *path;
    crease_read_options options;
    int file;
    char *head; /* HEAD_ROOM bytes at most */
    size_t head_size, file_size;
    crease_layout layout;
    crease_reader *read;
    crease_lines lines; /* of text */
    crease_survey survey;
};

static crease_status fail_count(
    crease_context *context, const crease_rows *rows, crease_status status, size_t found)
{
    return crease_fail(context, status, "%s: its header promises %llu points but %s%zu follow; %s",
        rows->path, (unsigned long long)rows->layout.count,
        status == CREASE_ERROR_FORMAT ? "at least " : "", found,
        status == CREASE_ERROR_FORMAT ? "mend the header" : "get the whole file");
}

static crease_status fail_many(crease_context *context, const crease_rows *rows)
{
    return crease_fail(context, CREASE_ERROR_ARGUMENT,
        "%s: has %llu points; at most %u fit one cloud, split it", rows->path,
        (unsigned long long)rows->layout.count, UINT32_MAX);
}

/* Where the rows of text are, and how many. Their size is that of their text and of what becomes of
 * it. */
static crease_status find_lines(crease_context *context, crease_rows *rows)
{
    crease_layout *const layout = &rows->layout;
    if (layout->counted && layout->count > UINT32_MAX)
        return fail_many(context, rows);
    const size_t most = layout->counted ? (size_t)layout->count : UINT32_MAX;
    const crease_status status = crease_lines_find(context, rows->path, rows->file,
        (crease_mark){layout->first, layout->line}, layout->is_row, most, &rows->lines);
    if (status != CREASE_OK)
        return status;
    if (rows->lines.rows < most && layout->counted)
        return fail_count(context, rows, CREASE_ERROR_TRUNCATED, rows->lines.rows);
    if (rows->lines.rows > most && layout->counted && layout->alone)
        return fail_count(context, rows, CREASE_ERROR_FORMAT, rows->lines.rows);
    layout->count = layout->counted ? layout->count : rows->lines.rows;
    if (layout->count > UINT32_MAX)
        return fail_many(context, rows);
    const size_t text = layout->count ? (rows->lines.end - layout->first) / layout->count + 1 : 1;
    layout->size = text + layout->columns * sizeof(double);
    return CREASE_OK;
}

/* Reads all rows once for what only all of them tell. */
static crease_status make_survey(crease_context *context, crease_rows *rows)
{
    crease_status status = CREASE_OK;
    rows->survey.normals = true;
    rows->survey.bytes = crease_allocate(context, rows->layout.columns, sizeof(bool));
    if (!rows->survey.bytes)
        return CREASE_ERROR_NO_MEMORY;
    memset(rows->survey.bytes, 1, rows->layout.columns * sizeof(bool));
    for (size_t at = 0; at < rows->layout.count && status == CREASE_OK; at += AT_ONCE) {
        const size_t left = rows->layout.count - at;
        crease_cloud *cloud = NULL;
        status = crease_rows_read(context, rows, at, left < AT_ONCE ? left : AT_ONCE, &cloud);
        crease_cloud_free(cloud);
        if (status == CREASE_OK && crease_cancelled(context))
            status = crease_fail_cancelled(context);
    }
    rows->survey.made = true;
    return status;
}

static crease_status check_size(crease_context *context, const crease_rows *rows)
{
    const crease_layout *const layout = &rows->layout;
    const size_t room = rows->file_size > layout->first ? rows->file_size - layout->first : 0;
    if (layout->count > UINT32_MAX)
        return fail_many(context, rows);
    if (layout->count > room / layout->size)
        return crease_fail(context, CREASE_ERROR_TRUNCATED,
            "%s: byte %zu: ends before the %llu points that its header promises; get the whole "
            "file",
            rows->path, rows->file_size, (unsigned long long)layout->count);
    if (layout->alone && room - layout->count * layout->size >= layout->size)
        return crease_fail(context, CREASE_ERROR_FORMAT,
            "%s: holds more than the %llu points that its header promises; mend the header",
            rows->path, (unsigned long long)layout->count);
    return CREASE_OK;
}

static crease_status open_rows(crease_context *context, crease_rows *rows)
{
    rows->head = crease_allocate(context, HEAD_ROOM + 1, 1);
    if (!rows->head)
        return CREASE_ERROR_NO_MEMORY;
    rows->file = open(rows->path, O_RDONLY | O_CLOEXEC);
    if (rows->file < 0)
        return crease_source_refuse(context, rows->path, errno);
    if (!crease_source_peek(rows->path, rows->head, HEAD_ROOM, &rows->head_size, &rows->file_size))
        return crease_fail(context, CREASE_ERROR_UNSUPPORTED,
            "%s: is no regular file, which alone can be read in parts; save it as one", rows->path);
    if (rows->file_size == 0)
        return crease_fail(context, CREASE_ERROR_TRUNCATED,
            "%s: is empty; write the cloud again or name another file", rows->path);
    const crease_format *const format =
        crease_format_find(rows->path, rows->head, rows->head_size, rows->file_size);
    const crease_source head = {
        .name = rows->path, .path = rows->path, .bytes = rows->head, .size = rows->head_size};
    rows->read = format ? format->read : NULL;
    crease_status status = CREASE_OK;
    if (rows->read == crease_las_read)
        status = crease_las_layout(context, &head, &rows->layout);
    else if (rows->read == crease_ply_read)
        status = crease_ply_layout(context, &head, &rows->layout);
    else if (rows->read == crease_xyz_read)
        status = crease_xyz_layout(context, &head, &rows->layout);
    else
        status = crease_fail(context, CREASE_ERROR_UNSUPPORTED,
            "%s: only PLY, LAS and rows of text (XYZ, CSV) can be read in parts; write it as one "
            "of "
            "these on a machine that holds it",
            rows->path);
    if (status == CREASE_OK && rows->layout.first > rows->head_size)
        status = crease_fail(context, CREASE_ERROR_UNSUPPORTED,
            "%s: its header of %zu bytes is too long for reading in parts; write it without so "
            "much "
            "in it",
            rows->path, rows->layout.first);
    if (status != CREASE_OK || !rows->layout.is_row)
        return status == CREASE_OK ? check_size(context, rows) : status;
    status = find_lines(context, rows);
    return status == CREASE_OK && rows->layout.asks ? make_survey(context, rows) : status;
}

crease_status crease_rows_open(crease_context *context, const char *path,
    const crease_read_options *options, crease_rows **out)
{
    *out = NULL;
    crease_rows *const rows = crease_allocate(context, 1, sizeof *rows);
    if (!rows)
        return CREASE_ERROR_NO_MEMORY;
    rows->path = path;
    rows->options = *options;
    rows->file = -1;
    const crease_status status = open_rows(context, rows);
    if (status == CREASE_OK)
        *out = rows;
    else
        crease_rows_close(rows);
    return status;
}

void crease_rows_close(crease_rows *rows)
{
    if (!rows)
        return;
    if (rows->file >= 0)
        close(rows->file);
    crease_lines_free(&rows->lines);
    free(rows->survey.bytes);
    free(rows->head);
    free(rows);
}

size_t crease_rows_count(const crease_rows *rows)
{
    return rows->layout.count;
}

size_t crease_rows_size(const crease_rows *rows)
{
    return rows->layout.size;
}

/* That of a file of so many rows; returns its length. */
static size_t write_header(const crease_rows *rows, size_t count, char *out)
{
    const crease_layout *const layout = &rows->layout;
    const size_t before = layout->numeral[0], after = layout->first - layout->numeral[1];
    if (rows->read == crease_las_read) {
        memcpy(out, rows->head, layout->first);
        crease_las_set_count(out, layout, (uint32_t)count);
        return layout->first;
    }
    memcpy(out, rows->head, before);
    const size_t digits = (size_t)snprintf(out + before, DIGITS, "%zu", count);
    memcpy(out + before + digits, rows->head + layout->numeral[1], after);
    return before + digits + after;
}

/* The header right before the rows, which begin at `lead`; returns where it begins. */
static size_t put_before(const crease_rows *rows, size_t count, size_t lead, char *bytes)
{
    char digits[DIGITS];
    const crease_layout *const layout = &rows->layout;
    if (rows->read == crease_ply_read) {
        const size_t width = (size_t)snprintf(digits, DIGITS, "%zu", count);
        const size_t begin =
            lead - layout->first + (layout->numeral[1] - layout->numeral[0]) - width;
        write_header(rows, count, bytes + begin);
        return begin;
    }
    const bool ended = rows->head[layout->lead - 1] == '\n';
    const size_t begin = lead - layout->lead - !ended;
    memcpy(bytes + begin, rows->head, layout->lead);
    bytes[lead - 1] = '\n';
    return begin;
}

static crease_status read_text(
    crease_context *context, crease_rows *rows, size_t first, size_t count, crease_cloud **out)
{
    const size_t lead = rows->layout.lead + DIGITS;
    char *bytes = NULL;
    size_t size = 0;
    crease_source source = {.name = rows->path,
        .path = rows->path,
        .rows_before = first,
        .survey = rows->survey.bytes ? &rows->survey : NULL};
    crease_status status = crease_lines_read(
        context, &rows->lines, rows->file, first, count, lead, &bytes, &size, &source.line);
    if (status == CREASE_OK) {
        const size_t begin = put_before(rows, count, lead, bytes);
        source.bytes = bytes + begin;
        source.size = lead - begin + size;
        status = rows->read(context, &source, &rows->options, out);
    }
    free(bytes);
    return status;
}

static crease_status read_binary(
    crease_context *context, crease_rows *rows, size_t first, size_t count, crease_cloud **out)
{
    const crease_layout *const layout = &rows->layout;
    const size_t size = count * layout->size;
    char *const bytes = crease_allocate(context, layout->first + DIGITS + size + 1, 1);
    if (!bytes)
        return CREASE_ERROR_NO_MEMORY;
    size_t got = 0;
    const size_t begin = write_header(rows, count, bytes);
    const size_t from = layout->first + first * layout->size;
    const crease_source source = {.name = rows->path,
        .path = rows->path,
        .bytes = bytes,
        .size = begin + size,
        .rows_before = first,
        .bytes_before = from - begin};
    const crease_status status =
        crease_source_get(rows->file, bytes + begin, size, from, &got) && got == size
        ? rows->read(context, &source, &rows->options, out)
        : crease_fail(context, CREASE_ERROR_CANNOT_READ,
              "%s: byte %zu: cannot be read; check the file", rows->path, from);
    free(bytes);
    return status;
}

crease_status crease_rows_read(
    crease_context *context, crease_rows *rows, size_t first, size_t count, crease_cloud **out)
{
    *out = NULL;
    return (rows->layout.is_row ? read_text : read_binary)(context, rows, first, count, out);
}
