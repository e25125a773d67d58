/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Step 7 of Algorithm 1: which control points lie at the sharp edge. */
#ifndef CREASE_AVERAGING_MARK_H
#define CREASE_AVERAGING_MARK_H

#include "averaging/net.h"

/* marks[i] = 1 when the mean of the standardised variance (mean 0, deviation 1) of the k data
 * points nearest to control point i is above the threshold e, else 0. marks: rows x columns. */
crease_status crease_mark(crease_context *context, const crease_net *net, const crease_tree *tree,
    const double *standardised, int k, double threshold, uint8_t *marks);

#endif
