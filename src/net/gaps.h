/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Where in the rectangle of a sheet there are no points. */
#ifndef CREASE_NET_GAPS_H
#define CREASE_NET_GAPS_H

#include "net/samples.h"

/* A raster over the domain. A bin is near when it, or one of the eight around it, holds a point. */
typedef struct crease_gaps {
    size_t count[2];
    double low[2], step[2], spacing; /* of the points */
    size_t empty;                    /* bins that are not near */
    bool *near;                      /* count[0] x count[1], the second index fastest */
} crease_gaps;

/* The samples must be placed. Errors: NO_MEMORY. */
crease_status crease_gaps_create(crease_context *context, const crease_samples *samples,
    const crease_layout *layout, crease_gaps *out);
void crease_gaps_free(crease_gaps *gaps);
/* Whether points are missing there. */
bool crease_gaps_at(const crease_gaps *gaps, double u, double v);

#endif
