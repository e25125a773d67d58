/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Distances of points from a surface, summed up. */
#ifndef CREASE_CLI_DEVIATION_H
#define CREASE_CLI_DEVIATION_H

#include "report.h"

typedef struct deviation_summary {
    double mean;           /* signed */
    double rms, p95, most; /* of their sizes */
} deviation_summary;

/** All zero for no deviations. */
deviation_summary deviation_summarise(const double *deviations, size_t count);
/** Adds the numbers to an object of the report. */
void deviation_describe(cJSON *object, deviation_summary summary);

#endif
