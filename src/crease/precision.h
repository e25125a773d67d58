/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* How well the points determine where a crease is and how far it bends: as well as the fits of its
 * two models, whose errors are independent. */
#ifndef CREASE_CREASE_PRECISION_H
#define CREASE_CREASE_PRECISION_H

#include "crease/chain.h"
#include "crease/survey.h"

typedef struct crease_precision {
    double position; /* standard error across the crease, of both directions together */
    double bend;     /* standard error, radians */
} crease_precision;

/* Root mean square over the points of a chain. */
crease_precision crease_precision_estimate(const crease_survey *survey, const crease_chain *chain);

#endif
