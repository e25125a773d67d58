/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A file of points that is read some rows at a time, for clouds larger than memory. */
#ifndef CREASE_READ_ROWS_H
#define CREASE_READ_ROWS_H

#include "base/context.h"

typedef struct crease_rows crease_rows;

/* Opens a PLY or LAS file or rows of text. Errors: those of crease_cloud_read(), and UNSUPPORTED
 * for files that cannot be read in parts. */
crease_status crease_rows_open(crease_context *context, const char *path,
    const crease_read_options *options, crease_rows **out);
void crease_rows_close(crease_rows *rows);
/* How many rows the file has. */
size_t crease_rows_count(const crease_rows *rows);
/* Bytes that each takes while it is read. */
size_t crease_rows_size(const crease_rows *rows);
/* Reads rows first .. first + count - 1; with skip_invalid the cloud may have fewer points. */
crease_status crease_rows_read(
    crease_context *context, crease_rows *rows, size_t first, size_t count, crease_cloud **out);

#endif
