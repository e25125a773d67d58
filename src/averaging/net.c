/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Based on: Sharp edge preservation using bicubic B-spline surfaces. ScienceAsia. Steps 4 and 5 of
 * Algorithm 1. */
#include "averaging/net.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

/* Weights are standard deviations of the variance; on flat ground rounding leaves less than this.
 */
static const double ROUNDING = 1e-9;

static double at(double low, double high, size_t i, size_t count)
{
    const double t = (double)i / (double)(count - 1);
    return (1.0 - t) * low + t * high;
}

crease_status crease_net_create(crease_context *context, const double *points, size_t count,
    size_t rows, size_t columns, crease_net *out)
{
    *out = (crease_net){.rows = rows, .columns = columns};
    out->points = crease_allocate(context, rows * columns, 3 * sizeof *out->points);
    if (!out->points)
        return CREASE_ERROR_NO_MEMORY;
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (size_t i = 0; i < count; i++)
        for (size_t c = 0; c < 2; c++) {
            low[c] = fmin(low[c], points[3 * i + c]);
            high[c] = fmax(high[c], points[3 * i + c]);
        }
    for (int c = 0; c < 2; c++)
        if (!(high[c] > low[c])) {
            crease_net_free(out);
            return crease_fail(context, CREASE_ERROR_DEGENERATE,
                "net: seen along z the points have no extent in %c; choose another orientation",
                "xy"[c]);
        }
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < columns; j++) {
            double *const p = out->points + 3 * (i * columns + j);
            p[0] = at(low[0], high[0], i, rows);
            p[1] = at(low[1], high[1], j, columns);
        }
    return CREASE_OK;
}

void crease_net_free(crease_net *net)
{
    free(net->points);
    *net = (crease_net){0};
}

static double weighted_height(
    const double *points, const double *weights, const uint32_t *nearest, int k)
{
    double sum = 0.0, total = 0.0, plain = 0.0;
    for (int i = 0; i < k; i++) {
        const double z = points[3 * (size_t)nearest[i] + 2], w = weights[nearest[i]];
        sum += w;
        total += z * w;
        plain += z;
    }
    return sum > ROUNDING ? total / sum : plain / k;
}

crease_status crease_net_average(crease_context *context, crease_net *net, const crease_tree *tree,
    const double *points, const double *weights, int k, int passes)
{
    const size_t size = net->rows * net->columns, width = (size_t)k;
    uint32_t *nearest = crease_allocate(context, size, width * sizeof *nearest);
    if (!nearest)
        return CREASE_ERROR_NO_MEMORY;
    crease_status status = CREASE_OK;
    for (int pass = 0; pass < passes && status == CREASE_OK; pass++) {
        status = crease_tree_nearest(context, tree, net->points, size, k, nearest, NULL);
        for (size_t i = 0; i < size && status == CREASE_OK; i++)
            net->points[3 * i + 2] = weighted_height(points, weights, nearest + i * width, k);
    }
    free(nearest);
    return status;
}
