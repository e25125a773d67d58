/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A cloud on disk, cut into parts along the Morton curve. */
#ifndef CREASE_STREAM_PARTS_H
#define CREASE_STREAM_PARTS_H

#include "base/context.h"
#include "read/rows.h"

/* A point in the scratch file. */
typedef struct crease_record {
    double point[3];
    double variance;
    uint32_t number;  /* in the order of the input */
    uint32_t padding; /* 0 */
} crease_record;

typedef struct crease_part {
    size_t first, count;    /* records in the scratch file, along the Morton curve */
    size_t first_block;     /* of all blocks */
    double low[3], high[3]; /* box around its points */
} crease_part;

/* CREASE_BLOCK records of a part, or those that are left of it: the box around them. */
typedef struct crease_block {
    double low[3], high[3];
} crease_block;

typedef struct crease_parts {
    int file;
    crease_part *items;
    size_t part_count;
    crease_block *blocks;
    size_t count; /* points in all */
    double low[3], high[3];
    bool wide_normals; /* some normal is no single number */
} crease_parts;

enum { CREASE_BLOCK = 1 << 12 };

/* Bytes that cutting takes for each point of the largest part, and for itself. */
enum { CREASE_CUT_POINT = 130, CREASE_CUT_FIXED = 3 << 20 };

static inline size_t crease_part_blocks(const crease_part *part)
{
    return (part->count + CREASE_BLOCK - 1) / CREASE_BLOCK;
}

/* Cuts the points of the rows, so many of which are read at once, into part_count parts of nearly
 * equal size. scratch: a folder. */
crease_status crease_parts_create(crease_context *context, crease_rows *rows, size_t at_once,
    size_t part_count, const char *scratch, crease_parts *out);
void crease_parts_free(crease_parts *parts);
/* Records begin .. begin + count - 1 of the scratch file. */
crease_status crease_parts_get(crease_context *context, const crease_parts *parts, size_t begin,
    size_t count, crease_record *out);
crease_status crease_parts_put(crease_context *context, const crease_parts *parts, size_t begin,
    size_t count, const crease_record *from);

#endif
