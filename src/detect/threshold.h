/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The decision which points are features. */
#ifndef CREASE_DETECT_THRESHOLD_H
#define CREASE_DETECT_THRESHOLD_H

#include <stddef.h>
#include <stdint.h>

typedef struct crease_threshold_rule {
    double least; /* score of the weakest edge that is to be found where there is no noise */
    double most;  /* no score is greater */
    int k;        /* neighbours that the scores come from */
    double rate;  /* expected share of points found that noise explains: the decision keeps below */
} crease_threshold_rule;

/* ln(score) in bins of 1/50 from e^-92, which stands for zero, to 1 and more: all that the decision
 * looks at. Those of several pieces of a cloud can be added. */
enum { CREASE_HISTOGRAM_BINS = 4600 };
typedef struct crease_histogram {
    uint64_t bin[CREASE_HISTOGRAM_BINS];
} crease_histogram;

/* Counts one score. */
void crease_threshold_count(
    crease_histogram *histogram, double score, const crease_threshold_rule *rule);
/* The score from which on a point of a cloud is significant: what noise alone would give is taken
 * from the scores themselves. They grow with the square of an angle, as variances of normals do.
 * Infinite when no point is significant. count: of all scores. */
double crease_threshold_find(
    const crease_histogram *histogram, size_t count, const crease_threshold_rule *rule);

#endif
