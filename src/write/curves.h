/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#ifndef CREASE_WRITE_CURVES_H
#define CREASE_WRITE_CURVES_H

#include "base/context.h"

/* Numbers that belong to each curve, as further columns of a CSV file. */
typedef struct crease_curve_columns {
    size_t count;
    const char *const *names; /* count */
    const double *values;     /* curve by curve, count for each */
} crease_curve_columns;

/* crease_curves_write() with columns. */
crease_status crease_curves_write_columns(crease_context *context,
    const crease_curve *const *curves, size_t count, double tolerance,
    const crease_curve_columns *columns, const char *path);

#endif
