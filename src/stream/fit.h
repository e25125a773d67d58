/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A sheet of a file whose points this process or others go through, some rows at a time. */
#ifndef CREASE_STREAM_FIT_H
#define CREASE_STREAM_FIT_H

#include "crease/crease_stream.h"
#include "fit/sum.h"

/* Is told the distances of points from the sheet, batch after batch of the file. */
typedef void crease_fit_told(void *user, const double *distances, size_t count);

/* Who goes through the points. What is found is that of batches of at_once rows each, in the order
 * of the file. */
typedef struct crease_fit_hands {
    void *user;
    /* Before all others, where it is not NULL. */
    crease_status (*begin)(void *user, size_t rows, size_t at_once);
    /* Widens the sum, and the box in the summary. */
    crease_status (*widen)(void *user, crease_sheet_sum *sum, crease_fit_stream_summary *summary);
    crease_status (*add)(void *user, crease_sheet_sum *sum);
    crease_status (*measure)(
        void *user, crease_sheet_sum *sum, crease_fit_told *take, void *taking);
} crease_fit_hands;

/* crease_sheet_fit_stream(). hands: NULL: this process. */
crease_status crease_sheet_fit_stream_by(crease_context *context, const char *input,
    const crease_fit_stream_options *options, const crease_fit_hands *hands,
    crease_fit_stream_summary *summary, crease_cloud **sample, crease_sheet **out);
/* Extends a box to the points of a cloud. */
void crease_fit_enclose(const crease_cloud *batch, double low[3], double high[3]);

#endif
