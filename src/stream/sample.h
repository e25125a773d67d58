/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Some points of a file, evenly from its beginning to its end. */
#ifndef CREASE_STREAM_SAMPLE_H
#define CREASE_STREAM_SAMPLE_H

#include "base/context.h"
#include "read/rows.h"

/* At most `most` points, without their fields: of every so many one, drawn by the context's seed;
 * all when there are no more. at_once: rows that are read together. *total: points of the file. */
crease_status crease_sample_take(crease_context *context, crease_rows *rows, size_t at_once,
    size_t most, crease_cloud **out, size_t *total);
/* The number of the point that is drawn from one of `most` layers of a file of so many rows; most:
 * 1..rows. */
size_t crease_sample_number(const crease_context *context, size_t rows, size_t most, size_t layer);

#endif
