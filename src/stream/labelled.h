/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The rows of the input with what was found of their points, as they are written: a PLY file. */
#ifndef CREASE_STREAM_LABELLED_H
#define CREASE_STREAM_LABELLED_H

#include "read/rows.h"
#include "stream/results.h"
#include "write/output.h"

typedef struct crease_labelled {
    crease_output *output;
    const char *path; /* for sentences */
    size_t count;     /* points of the file, 0: its header is somebody else's */
    crease_type normal_type;
    size_t at_once;         /* rows that are read together */
    crease_result *results; /* room for those of so many rows, for whoever finds them */
    float *variance;
    uint8_t *features;
    int32_t *regions;
    bool begun;
} crease_labelled;

crease_status crease_labelled_create(
    crease_context *context, const crease_labelled *like, crease_labelled *out);
void crease_labelled_free(crease_labelled *labelled);
/* Adds rows of the input with labelled->results; the first ones begin the file. */
crease_status crease_labelled_add(
    crease_context *context, crease_labelled *labelled, const crease_cloud *rows);

#endif
