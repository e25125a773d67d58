/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "read/lines.h"

#include "base/memory.h"
#include "read/source.h"

#include <stdlib.h>
#include <string.h>

enum { STEP = 1024, ROOM = 1 << 20, FIRST_MARKS = 64 };

static crease_status add_mark(crease_context *context, crease_lines *lines, crease_mark mark)
{
    if (lines->mark_count == lines->room) {
        const size_t room = lines->room ? 2 * lines->room : FIRST_MARKS;
        crease_mark *const grown =
            crease_reallocate(context, lines->marks, room, sizeof *lines->marks);
        if (!grown)
            return CREASE_ERROR_NO_MEMORY;
        lines->marks = grown;
        lines->room = room;
    }
    lines->marks[lines->mark_count++] = mark;
    return CREASE_OK;
}

/* Takes the whole lines of some text, all of it when it is the last; `at` goes behind them. */
static crease_status take_lines(crease_context *context, crease_lines *lines, const char *text,
    size_t size, bool last, size_t most, crease_mark *at)
{
    const char *const end = text + size;
    crease_status status = CREASE_OK;
    while (text < end && lines->rows <= most && status == CREASE_OK) {
        const char *const stop = memchr(text, '\n', (size_t)(end - text));
        if (!stop && !last)
            break;
        const char *const line_end = stop ? stop : end, *const next = stop ? stop + 1 : end;
        const bool row = lines->is_row(text, line_end) != NULL;
        if (row && lines->rows % STEP == 0)
            status = add_mark(context, lines, *at);
        at->byte += (size_t)(next - text);
        at->line++;
        lines->rows += row;
        if (row && lines->rows <= most)
            lines->end = at->byte;
        text = next;
    }
    return status;
}

static crease_status go_through(
    crease_context *context, crease_lines *lines, int file, size_t most, crease_mark at, char *text)
{
    crease_status status = CREASE_OK;
    for (bool last = false; !last && lines->rows <= most && status == CREASE_OK;) {
        size_t size = 0;
        const size_t from = at.byte;
        if (!crease_source_get(file, text, ROOM, from, &size))
            return crease_fail(context, CREASE_ERROR_CANNOT_READ,
                "%s: byte %zu: cannot be read; check the file", lines->name, from);
        last = size < ROOM;
        status = take_lines(context, lines, text, size, last, most, &at);
        if (status == CREASE_OK && at.byte == from && size == ROOM)
            status = crease_fail(context, CREASE_ERROR_UNSUPPORTED,
                "%s: line %zu: has more than a million characters; is it a cloud?", lines->name,
                at.line);
        if (status == CREASE_OK && crease_cancelled(context))
            status = crease_fail_cancelled(context);
    }
    return status;
}

crease_status crease_lines_find(crease_context *context, const char *name, int file,
    crease_mark from, crease_row_test *is_row, size_t most, crease_lines *out)
{
    *out = (crease_lines){.name = name, .is_row = is_row, .end = from.byte};
    char *const text = crease_allocate(context, ROOM, 1);
    const crease_status status =
        text ? go_through(context, out, file, most, from, text) : CREASE_ERROR_NO_MEMORY;
    free(text);
    if (status != CREASE_OK)
        crease_lines_free(out);
    return status;
}

void crease_lines_free(crease_lines *lines)
{
    free(lines->marks);
    *lines = (crease_lines){.rows = 0};
}

/* Goes behind the lines of so many rows. */
static const char *pass_rows(
    const crease_lines *lines, const char *at, const char *end, size_t rows, size_t *line)
{
    while (rows > 0 && at < end) {
        const char *const stop = memchr(at, '\n', (size_t)(end - at));
        rows -= lines->is_row(at, stop ? stop : end) != NULL;
        at = stop ? stop + 1 : end;
        ++*line;
    }
    return at;
}

crease_status crease_lines_read(crease_context *context, const crease_lines *lines, int file,
    size_t first, size_t count, size_t lead, char **text, size_t *size, size_t *line)
{
    const size_t begin = first / STEP, next = (first + count + STEP - 1) / STEP;
    const crease_mark from =
        begin < lines->mark_count ? lines->marks[begin] : (crease_mark){lines->end, 1};
    const size_t end = next < lines->mark_count ? lines->marks[next].byte : lines->end;
    size_t got = 0, unused = 0;
    *line = from.line;
    *text = crease_allocate(context, lead + (end - from.byte) + 1, 1);
    if (!*text)
        return CREASE_ERROR_NO_MEMORY;
    char *const room = *text + lead;
    if (!crease_source_get(file, room, end - from.byte, from.byte, &got) || got < end - from.byte) {
        free(*text);
        *text = NULL;
        return crease_fail(context, CREASE_ERROR_CANNOT_READ,
            "%s: byte %zu: cannot be read; check the file", lines->name, from.byte);
    }
    const char *const wanted = pass_rows(lines, room, room + got, first - begin * STEP, line);
    const char *const behind = pass_rows(lines, wanted, room + got, count, &unused);
    *size = (size_t)(behind - wanted);
    memmove(room, wanted, *size);
    room[*size] = '\0';
    return CREASE_OK;
}
