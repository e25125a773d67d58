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

/* The score from which on a point of a cloud is significant: what noise alone would give is taken
 * from the scores themselves. They grow with the square of an angle, as variances of normals do.
 * Infinite when no point is significant. O(count). */
double crease_threshold_find(const double *scores, size_t count, const crease_threshold_rule *rule);

#endif
