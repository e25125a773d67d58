/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Adding points to a sheet in two steps, which different processes may do: what of a point depends
 * on that point and the sheet found so far alone, and the sum. Internal view of crease_sum.h. */
#ifndef CREASE_FIT_SUM_H
#define CREASE_FIT_SUM_H

#include "crease/crease_sum.h"
#include "fit/fitting.h"

/* Numbers that are observed of each point: all places first, two each, then all weights, tilts and
 * heights. */
enum { CREASE_OBSERVED = 5 };

typedef struct crease_sum_box {
    double low[2], high[2];
} crease_sum_box;

struct crease_sheet_sum {
    crease_sheet_options options;
    crease_cloud *cloud; /* the sample */
    crease_samples sample;
    crease_fitting fitting;
    crease_height below; /* the sheet that feet and weights are taken from */
    crease_layout below_layout;
    crease_surface *surface; /* solved last, or NULL */
    crease_closest *closest; /* on it, unless a round has begun since */
    crease_sum_box all;      /* the rectangle of all points */
    double scale;            /* standard deviation of the points */
    double mean;             /* distance of the sample from the sheet below */
    size_t count;
    bool open;  /* points may be added */
    bool exact; /* the sample's sheet goes through its points */
    bool wants_more;
};

/* Begins a round, unless one has begun. */
crease_status crease_sheet_sum_begin(crease_context *context, crease_sheet_sum *sum);
/* numbers: CREASE_OBSERVED for each of the points, count x 3. Once a round has begun. */
crease_status crease_sheet_sum_observe(crease_context *context, const crease_sheet_sum *sum,
    const double *points, size_t count, double *numbers);
/* Adds what was observed. After the same calls in the same order the sum is the same bytes as by
 * crease_sheet_sum_add() of the same points. */
crease_status crease_sheet_sum_take(
    crease_context *context, crease_sheet_sum *sum, const double *numbers, size_t count);

/* Makes the sheet solved last ready for distances. */
crease_status crease_sheet_sum_make_ready(crease_context *context, crease_sheet_sum *sum);

/* What another process of the same build needs to widen, observe and measure; free() the bytes. */
crease_status crease_sheet_sum_pack(
    crease_context *context, const crease_sheet_sum *sum, char **bytes, size_t *size);
/* A sum that can do these, and nothing else. */
crease_status crease_sheet_sum_unpack(
    crease_context *context, const char *bytes, crease_sheet_sum **out);

#endif
