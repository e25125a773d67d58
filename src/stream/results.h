/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What was found of every point, on disk: part by part as it is found, then in the order of the
 * input. */
#ifndef CREASE_STREAM_RESULTS_H
#define CREASE_STREAM_RESULTS_H

#include "base/context.h"

typedef struct crease_result {
    uint32_t number;
    float variance;
    int32_t region;
    uint32_t feature;
} crease_result;

/* The results of one part, their numbers ascending. */
typedef struct crease_run {
    size_t first, count;  /* in the scratch file */
    crease_result *items; /* those at hand */
    size_t at, end, read;
} crease_run;

/* Bytes for each part while they are read. */
enum { CREASE_RUN_RESULTS = 512, CREASE_RUN_SIZE = CREASE_RUN_RESULTS * 16 + 64 };

typedef struct crease_results {
    int file;
    crease_run *runs;
    size_t run_count, room;
    size_t count;
    crease_result *memory;
} crease_results;

/* runs: how many parts there will be. */
crease_status crease_results_create(
    crease_context *context, const char *scratch, size_t runs, crease_results *out);
void crease_results_free(crease_results *results);
/* Adds those of a part. */
crease_status crease_results_add(
    crease_context *context, crease_results *results, const crease_result *items, size_t count);
/* Those of points first .. first + count - 1, which follow those of the call before. */
crease_status crease_results_next(crease_context *context, crease_results *results, size_t first,
    size_t count, crease_result *out);

#endif
