/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Based on: Sharp edge preservation using bicubic B-spline surfaces. ScienceAsia. Steps 8 and 9 of
 * Algorithm 1, and Example 1. */
#include "averaging/repeat.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

crease_status crease_net_transpose(crease_context *context, crease_net *net, uint8_t *marks)
{
    const size_t rows = net->rows, columns = net->columns;
    double *points = crease_allocate(context, rows * columns, 3 * sizeof *points);
    uint8_t *old = crease_duplicate(context, marks, rows * columns, 1);
    if (!points || !old) {
        free(points);
        free(old);
        return CREASE_ERROR_NO_MEMORY;
    }
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < columns; j++) {
            const size_t from = i * columns + j, to = j * rows + i;
            memcpy(points + 3 * to, net->points + 3 * from, 3 * sizeof *points);
            marks[to] = old[from];
        }
    free(old);
    free(net->points);
    *net = (crease_net){.rows = columns, .columns = rows, .points = points};
    return CREASE_OK;
}

size_t crease_marked_rows(
    const uint8_t *marks, size_t rows, size_t columns, int threshold, bool *passes)
{
    size_t passed = 0;
    for (size_t i = 0; i < rows; i++) {
        int sum = 0;
        for (size_t j = 0; j < columns; j++)
            sum += marks[i * columns + j];
        passes[i] = sum > threshold;
        passed += passes[i];
    }
    return passed;
}

crease_status crease_net_repeat(crease_context *context, const crease_net *net, const bool *passes,
    size_t times, crease_net *out)
{
    size_t rows = 0;
    for (size_t i = 0; i < net->rows; i++)
        rows += passes[i] ? times : 1;
    *out = (crease_net){.rows = rows, .columns = net->columns};
    out->points = crease_allocate(context, rows * net->columns, 3 * sizeof *out->points);
    if (!out->points)
        return CREASE_ERROR_NO_MEMORY;
    const size_t width = 3 * net->columns;
    double *to = out->points;
    for (size_t i = 0; i < net->rows; i++)
        for (size_t copy = 0; copy < (passes[i] ? times : 1); copy++, to += width)
            memcpy(to, net->points + i * width, width * sizeof *to);
    return CREASE_OK;
}
