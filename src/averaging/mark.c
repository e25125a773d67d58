/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Based on: Sharp edge preservation using bicubic B-spline surfaces. ScienceAsia. Step 7 of
 * Algorithm 1. The paper does not say which of its two standardised values are averaged here: with
 * those shifted to be positive e = 0.20 would mark nearly everything, so they are the others. */
#include "averaging/mark.h"

#include "base/memory.h"

#include <stdlib.h>

crease_status crease_mark(crease_context *context, const crease_net *net, const crease_tree *tree,
    const double *standardised, int k, double threshold, uint8_t *marks)
{
    const size_t size = net->rows * net->columns, width = (size_t)k;
    uint32_t *nearest = crease_allocate(context, size, width * sizeof *nearest);
    if (!nearest)
        return CREASE_ERROR_NO_MEMORY;
    const crease_status status =
        crease_tree_nearest(context, tree, net->points, size, k, nearest, NULL);
    for (size_t i = 0; i < size && status == CREASE_OK; i++) {
        double sum = 0.0;
        for (size_t j = 0; j < width; j++)
            sum += standardised[nearest[i * width + j]];
        marks[i] = sum / k > threshold;
    }
    free(nearest);
    return status;
}
