/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A whole file in memory. Read, not mapped: a mapped file that another program shortens meanwhile
 * would end the host program by a signal. */
#ifndef CREASE_READ_SOURCE_H
#define CREASE_READ_SOURCE_H

#include "base/context.h"

/* What only all rows of a text file tell. Rows that are read while it is made restrict it; then it
 * holds for all. */
typedef struct crease_survey {
    bool made;
    bool normals; /* columns without names are unit vectors */
    bool *bytes;  /* of each column: it has whole numbers 0..255 alone */
} crease_survey;

typedef struct crease_source {
    const char *name; /* for sentences: the path, or "standard input" */
    const char *path; /* as given */
    char *bytes;      /* size of them, and a zero byte behind */
    size_t size;
    size_t rows_before, bytes_before; /* of the points: when the bytes are a header and some of the
                                         rows of a file, for sentences */
    size_t line; /* of the first of these rows in a text file; 0: the bytes are a whole file */
    crease_survey *survey; /* XYZ: of the whole file, when the bytes are some of its rows */
} crease_source;

/* Reads the file, or standard input when the path is "-". Release by crease_source_free().
 * Errors: NO_SUCH_FILE, CANNOT_READ, NO_MEMORY. */
crease_status crease_source_open(crease_context *context, const char *path, crease_source *out);
void crease_source_free(crease_source *source);

/* The sentence about a file that cannot be opened or read, by errno. Errors: NO_SUCH_FILE,
 * CANNOT_READ. */
crease_status crease_source_refuse(crease_context *context, const char *name, int error);

/* The first bytes of a regular file, at most `room`, and the file's size; false when it cannot be
 * read. */
bool crease_source_peek(
    const char *path, char *head, size_t room, size_t *head_size, size_t *file_size);

/* As many bytes from byte `from` on as there are up to `room`; false when they cannot be read. */
bool crease_source_get(int file, char *to, size_t room, size_t from, size_t *size);

#endif
