/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A whole file in memory. Read, not mapped: a mapped file that another program shortens meanwhile
 * would end the host program by a signal. */
#ifndef CREASE_READ_SOURCE_H
#define CREASE_READ_SOURCE_H

#include "base/context.h"

typedef struct crease_source {
    const char *name; /* for sentences: the path, or "standard input" */
    const char *path; /* as given */
    char *bytes;      /* size of them, and a zero byte behind */
    size_t size;
    size_t rows_before, bytes_before; /* of the points: when the bytes are a header and some of the
                                         rows of a file, for sentences */
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

#endif
