/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The columns of a file of points: what each is called, how the file holds it, where its values go,
 * and the cloud that they make together. Every reader goes: add columns, settle, allocate, fill,
 * finish. */
#ifndef CREASE_READ_COLUMNS_H
#define CREASE_READ_COLUMNS_H

#include "read/source.h"
#include "read/span.h"

/* How a file holds one value: a crease_type, or one of those that become FLOAT64. */
enum { CREASE_CELL_INT64 = CREASE_TYPE_FLOAT64 + 1, CREASE_CELL_UINT64, CREASE_CELL_COUNT };

/* No file of points has more; readers refuse it before they add so many. */
enum { CREASE_MOST_COLUMNS = 2048 };

/* Bytes of a cell. */
size_t crease_cell_size(int cell);

typedef enum crease_role {
    CREASE_ROLE_X,
    CREASE_ROLE_Y,
    CREASE_ROLE_Z,
    CREASE_ROLE_NX,
    CREASE_ROLE_NY,
    CREASE_ROLE_NZ,
    CREASE_ROLE_FIELD,
    CREASE_ROLE_SKIPPED, /* passed over: padding, text */
    CREASE_ROLE_LIST     /* passed over: a count and so many values */
} crease_role;

typedef struct crease_column {
    char *name;
    crease_role role;
    int cell;              /* type in the file; of a list: of its count */
    int item;              /* of a list: type of its values */
    size_t offset;         /* binary files: of the first value from the first byte of the points */
    size_t stride;         /* binary files: from one point's value to the next one's */
    crease_type type;      /* type of values: FLOAT64 for coordinates and normals */
    unsigned char *values; /* of the first point; NULL when passed over */
    size_t step;           /* bytes from one value to the next */
} crease_column;

typedef struct crease_columns {
    crease_column *items;
    size_t count, room;
    size_t rows;
    double *points, *normals; /* rows x 3 */
    crease_type coordinate_type;
} crease_columns;

/* Appends a column; white space in the name becomes '_'. The role is found from the name, unless
 * it is SKIPPED or LIST. */
crease_status crease_columns_add(
    crease_context *context, crease_columns *columns, crease_span name, int cell, crease_role role);
/* Adds a column under a name of our own. */
crease_status crease_columns_add_named(
    crease_context *context, crease_columns *columns, const char *name, int cell);
/* Ends the adding: x, y and z are there, no name is there twice, incomplete normals are fields. */
crease_status crease_columns_settle(
    crease_context *context, const crease_source *source, crease_columns *columns);
/* Gives every column its memory. */
crease_status crease_columns_allocate(
    crease_context *context, const crease_source *source, crease_columns *columns, uint64_t rows);
void crease_columns_free(crease_columns *columns);

/* Stores a number as the column's type; false when it does not fit. */
bool crease_column_store(const crease_column *column, size_t row, double value);

/* Where the rows are in the file, for sentences: row 7 is at "line 12" or "byte 140". */
typedef struct crease_place {
    const char *unit;
    size_t (*find)(const void *user, size_t row);
    const void *user;
} crease_place;

/* Checks the coordinates and moves everything into a cloud. */
crease_status crease_columns_finish(crease_context *context, const crease_source *source,
    const crease_read_options *options, crease_columns *columns, crease_place place,
    crease_cloud **out);

#endif
