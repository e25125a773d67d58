/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Regions and creases of a sample of a file. */
#ifndef CREASE_STREAM_OVERVIEW_H
#define CREASE_STREAM_OVERVIEW_H

#include "crease/crease_stream.h"
#include "stream/labelling.h"

/* Of the memory that streaming may take, what it takes besides the points. */
enum { CREASE_STREAM_FIXED = 4 << 20 };
/* Bytes for each point of a cloud that is held, to find its regions. */
enum { CREASE_STREAM_HELD = 500 };

/* Draws `most` points of the file, see sample.h; *total: points of the file. */
typedef crease_status crease_overview_draw(
    crease_context *context, void *user, size_t most, crease_cloud **sample, size_t *total);

typedef struct crease_overview {
    crease_regions *regions;
    crease_network *network;
    crease_labelling labelling; /* of all points, by these */
    size_t sampled, total;      /* points */
} crease_overview;

/* How many points of a file of so many rows are drawn at first. memory: see the options. */
size_t crease_overview_most(size_t rows, size_t memory);
/* Rows that are read together, of so many bytes each in the file. */
size_t crease_overview_at_once(size_t row_size, size_t memory);
/* Finds the regions and creases of so many points, or of half as many for as long as these take
 * more memory than there is. */
crease_status crease_overview_find(crease_context *context, const crease_stream_options *options,
    size_t most, crease_overview_draw *draw, void *user, crease_overview *out);
/* Whether the options suit, and the output is one that can be written. */
crease_status crease_stream_check(
    crease_context *context, const crease_stream_options *options, const char *output);
/* Hands regions and network over. */
void crease_overview_release(
    crease_overview *overview, crease_regions **regions, crease_network **network);
/* Frees all that is left of it. */
void crease_overview_free(crease_overview *overview);

#endif
