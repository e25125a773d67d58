/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The control net of Algorithm 1: steps 4 and 5. */
#ifndef CREASE_AVERAGING_NET_H
#define CREASE_AVERAGING_NET_H

#include "base/context.h"

/* Rows of control points. In the net of step 4 a row has one x, a column one y. */
typedef struct crease_net {
    size_t rows, columns;
    double *points; /* rows x columns x 3 */
} crease_net;

/* Step 4: a regular grid over the x-y box of the points, with z = 0. rows along x, columns along
 * y. */
crease_status crease_net_create(crease_context *context, const double *points, size_t count,
    size_t rows, size_t columns, crease_net *out);
void crease_net_free(crease_net *net);

/* Step 5: z of every control point becomes sum z_i w_i / sum w_i over its k nearest data points,
 * `passes` times. The neighbours are found anew in every pass, since the net moves. Where all w_i
 * are zero, but for rounding (flat ground), the plain mean is taken, the limit of equal weights. */
crease_status crease_net_average(crease_context *context, crease_net *net, const crease_tree *tree,
    const double *points, const double *weights, int k, int passes);

#endif
