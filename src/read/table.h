/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Rows of text, one point a line, read by all threads: the lines are cut into chunks whose borders
 * depend on the text alone; a first pass counts the rows of each chunk, a second one reads them to
 * their places. */
#ifndef CREASE_READ_TABLE_H
#define CREASE_READ_TABLE_H

#include "read/columns.h"
#include "read/lines.h"

typedef struct crease_chunk crease_chunk;

typedef struct crease_table {
    const char *begin, *end; /* the lines */
    size_t first_line;       /* number of the first of them in the file */
    crease_row_test *data;
    char separator;       /* between cells; ' ' is any white space */
    bool comma;           /* a decimal comma is allowed */
    size_t rows;          /* found by crease_table_count */
    crease_chunk *chunks; /* belongs to the table */
    size_t chunk_count;
} crease_table;

/* Every line that is not blank. */
const char *crease_table_data(const char *line, const char *end);
/* The same without those that begin with '#'. */
const char *crease_table_data_uncommented(const char *line, const char *end);

/* Counts the rows. */
crease_status crease_table_count(crease_context *context, crease_table *table);
/* Reads the first columns->rows rows. Errors: FORMAT, with the first line that is wrong. */
crease_status crease_table_fill(crease_context *context, const crease_source *source,
    const crease_table *table, const crease_columns *columns);
/* Line number of a row. */
size_t crease_table_line(const crease_table *table, size_t row);
crease_place crease_table_place(const crease_table *table);
void crease_table_free(crease_table *table);

#endif
