/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Step 2 of the paper: the positive standardised variance. */
#ifndef CREASE_DETECT_STANDARDISE_H
#define CREASE_DETECT_STANDARDISE_H

#include <stdbool.h>
#include <stddef.h>

/* Standard scores of count values: mean 0, standard deviation (1 / (count - 1)) 1. positive: then
 * shifted by the lowest, so that the lowest is 0; the paper does not state the shift. Values that
 * are all equal become 0. out may be values. */
void crease_standardise(const double *values, size_t count, bool positive, double *out);

#endif
