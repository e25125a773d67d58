/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Smooth regions in words and in the report. */
#ifndef CREASE_CLI_REGION_H
#define CREASE_CLI_REGION_H

#include "report.h"

enum { REGION_TYPES = 6 };

/** How many there are of each crease_region_type. */
typedef struct region_counts {
    size_t of[REGION_TYPES];
} region_counts;

/** "3 planes, 1 cylinder", or "none". */
void region_counts_text(const region_counts *counts, char *text, size_t size);
/** Adds a member for each type, such as "planes". */
void region_counts_describe(cJSON *object, const region_counts *counts);
/** Adds the type of a region and the parameters that it has, under their names. */
void region_describe(cJSON *object, const crease_region *region);

#endif
