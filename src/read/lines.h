/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Where the rows of a text file are: a mark for every thousandth, found by going through it once.
 */
#ifndef CREASE_READ_LINES_H
#define CREASE_READ_LINES_H

#include "base/context.h"

/* The first cell of a line that is a row, or NULL for lines that are none. */
typedef const char *crease_row_test(const char *line, const char *end);

typedef struct crease_mark {
    size_t byte, line;
} crease_mark;

typedef struct crease_lines {
    const char *name; /* of the file, for sentences */
    crease_row_test *is_row;
    size_t rows;
    size_t end; /* byte behind the last row's line */
    crease_mark *marks;
    size_t mark_count, room;
} crease_lines;

/* Goes through a file from a byte on, which begins a line of this number, to the end or until there
 * are more than `most` rows: then *out has one more than that. Errors: CANNOT_READ, UNSUPPORTED (a
 * line of more than a million characters), NO_MEMORY, CANCELLED. */
crease_status crease_lines_find(crease_context *context, const char *name, int file,
    crease_mark from, crease_row_test *is_row, size_t most, crease_lines *out);
void crease_lines_free(crease_lines *lines);
/* The text of rows first .. first + count - 1 behind `lead` bytes that stay zero. line: the number
 * of its first line. Errors: CANNOT_READ, NO_MEMORY. */
crease_status crease_lines_read(crease_context *context, const crease_lines *lines, int file,
    size_t first, size_t count, size_t lead, char **text, size_t *size, size_t *line);

#endif
