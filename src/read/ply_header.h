/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The header of a PLY file, and going over its elements.
 * Based on: Turk. The PLY polygon file format. 1994. */
#ifndef CREASE_READ_PLY_HEADER_H
#define CREASE_READ_PLY_HEADER_H

#include "read/binary.h"
#include "read/columns.h"

enum { CREASE_PLY_MOST_ELEMENTS = 64 };

typedef enum crease_ply_coding {
    CREASE_PLY_NONE,
    CREASE_PLY_ASCII,
    CREASE_PLY_LITTLE,
    CREASE_PLY_BIG
} crease_ply_coding;

typedef struct crease_ply_element {
    crease_span name;
    uint64_t count;
    crease_span digits; /* of the count */
    crease_columns properties;
} crease_ply_element;

typedef struct crease_ply {
    crease_context *context;
    const crease_source *source;
    const crease_read_options *options;
    crease_cursor cursor;
    crease_ply_coding coding;
    crease_ply_element elements[CREASE_PLY_MOST_ELEMENTS];
    size_t element_count;
} crease_ply;

/* NULL when memory runs out. */
crease_ply *crease_ply_open(
    crease_context *context, const crease_source *source, const crease_read_options *options);
void crease_ply_close(crease_ply *file);

/* The elements with their properties; the cursor is then behind the header. Errors: FORMAT,
 * TRUNCATED, NO_MEMORY. */
crease_status crease_ply_read_header(crease_ply *file);
/* The first element of this name, or NULL. */
crease_ply_element *crease_ply_find(crease_ply *file, const char *name);
crease_status crease_ply_fail_truncated(const crease_ply *file, const crease_ply_element *part);

/* ------------------------------------------------------------------- behind the header: text -- */

/* Goes over the lines of the elements before this one. Errors: TRUNCATED. */
crease_status crease_ply_skip_lines(crease_ply *file, const crease_ply_element *until);

/* ----------------------------------------------------------------- behind the header: binary -- */

crease_order crease_ply_order(const crease_ply *file);
/* Bytes behind the cursor. */
size_t crease_ply_left(const crease_ply *file);
/* Whether so many records of this size are there. */
bool crease_ply_fits(const crease_ply *file, uint64_t count, size_t size);
/* The least bytes that one of an element takes: its lists empty. */
size_t crease_ply_least_size(const crease_ply_element *part, bool *lists);
/* Called for each list that is gone over, with its first value. */
typedef crease_status crease_ply_list_body(
    void *user, const crease_column *list, const unsigned char *values, size_t count);
/* Goes row by row over an element that has lists; store: into its columns; body: NULL, or told of
 * the lists. Errors: TRUNCATED, FORMAT, those of the body. */
crease_status crease_ply_pass_rows(crease_ply *file, const crease_ply_element *part, bool store,
    crease_ply_list_body *body, void *user);
/* Goes over an element. Errors: TRUNCATED, FORMAT. */
crease_status crease_ply_skip(crease_ply *file, const crease_ply_element *part);

#endif
