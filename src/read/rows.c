/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Some rows are read as a small file of their own: the header, with their number in place of that
 * of all rows, and their bytes. So every reader has to know one form of its format only. */
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

enum { HEAD_ROOM = 1 << 20, DIGITS = 24 };

struct crease_rows {
    const char *path;
    crease_read_options options;
    int file;
    char *head; /* HEAD_ROOM bytes at most */
    size_t head_size, file_size;
    crease_layout layout;
    bool las;
};

static crease_status check_size(crease_context *context, const crease_rows *rows)
{
    const crease_layout *const layout = &rows->layout;
    const size_t room = rows->file_size > layout->first ? rows->file_size - layout->first : 0;
    if (layout->count > UINT32_MAX)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "%s: has %llu points; at most %u fit one cloud, split it", rows->path,
            (unsigned long long)layout->count, UINT32_MAX);
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
    rows->las = format && format->read == crease_las_read;
    crease_status status = CREASE_OK;
    if (rows->las)
        status = crease_las_layout(context, &head, &rows->layout);
    else if (format && format->read == crease_ply_read)
        status = crease_ply_layout(context, &head, &rows->layout);
    else
        status = crease_fail(context, CREASE_ERROR_UNSUPPORTED,
            "%s: only binary PLY and LAS files can be read in parts; write it as one of these on a "
            "machine that holds it",
            rows->path);
    if (status == CREASE_OK && rows->layout.first > rows->head_size)
        status = crease_fail(context, CREASE_ERROR_UNSUPPORTED,
            "%s: its header of %zu bytes is too long for reading in parts; write it without so "
            "much "
            "in it",
            rows->path, rows->layout.first);
    return status == CREASE_OK ? check_size(context, rows) : status;
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

static bool read_at(int file, char *to, size_t size, size_t from)
{
    while (size > 0) {
        const ssize_t got = pread(file, to, size, (off_t)from);
        if (got == 0 || (got < 0 && errno != EINTR))
            return false;
        to += got > 0 ? got : 0;
        from += got > 0 ? (size_t)got : 0;
        size -= got > 0 ? (size_t)got : 0;
    }
    return true;
}

/* That of a file of so many rows; returns its length. */
static size_t write_header(const crease_rows *rows, size_t count, char *out)
{
    const crease_layout *const layout = &rows->layout;
    const size_t before = layout->numeral[0], after = layout->first - layout->numeral[1];
    if (rows->las) {
        memcpy(out, rows->head, layout->first);
        crease_las_set_count(out, layout, (uint32_t)count);
        return layout->first;
    }
    memcpy(out, rows->head, before);
    const size_t digits = (size_t)snprintf(out + before, DIGITS, "%zu", count);
    memcpy(out + before + digits, rows->head + layout->numeral[1], after);
    return before + digits + after;
}

crease_status crease_rows_read(
    crease_context *context, crease_rows *rows, size_t first, size_t count, crease_cloud **out)
{
    const crease_layout *const layout = &rows->layout;
    const size_t size = count * layout->size;
    *out = NULL;
    char *const bytes = crease_allocate(context, layout->first + DIGITS + size + 1, 1);
    if (!bytes)
        return CREASE_ERROR_NO_MEMORY;
    const size_t begin = write_header(rows, count, bytes);
    const size_t from = layout->first + first * layout->size;
    const crease_source source = {.name = rows->path,
        .path = rows->path,
        .bytes = bytes,
        .size = begin + size,
        .rows_before = first,
        .bytes_before = from - begin};
    const crease_status status = read_at(rows->file, bytes + begin, size, from)
        ? (rows->las ? crease_las_read : crease_ply_read)(context, &source, &rows->options, out)
        : crease_fail(context, CREASE_ERROR_CANNOT_READ,
              "%s: byte %zu: cannot be read; check the file", rows->path, from);
    free(bytes);
    return status;
}
