/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "fit/isolate.h"

#include "base/memory.h"
#include "base/select.h"
#include "fit/group.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NEIGHBOURS = 8 };

static const double FAR = 4.0;

/* Small groups: fewer points than the root of their number, far from all others. */
static crease_status leave_out_groups(
    crease_context *context, const double *points, size_t count, double cube, double *keep)
{
    size_t *sizes = crease_allocate(context, count, sizeof *sizes), largest = 0;
    const crease_status status = sizes
        ? crease_group_sizes(context, points, keep, count, cube, sizes)
        : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK) {
        for (size_t i = 0; i < count; i++)
            largest = sizes[i] > largest ? sizes[i] : largest;
        for (size_t i = 0; i < count; i++)
            if (sizes[i] < largest && (double)sizes[i] < sqrt((double)count))
                keep[i] = 0.0;
    }
    free(sizes);
    return status;
}

crease_status crease_isolate(
    crease_context *context, const double *points, size_t count, double *keep, double *spacing)
{
    const size_t k = count < NEIGHBOURS + 1 ? count : NEIGHBOURS + 1;
    double usual = 0.0;
    crease_tree *tree = NULL;
    uint32_t *nearest = crease_allocate(context, count, k * sizeof *nearest);
    double *squares = crease_allocate(context, count, k * sizeof *squares);
    double *sorted = crease_allocate(context, count, sizeof *sorted);
    crease_status status = nearest && squares && sorted ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK)
        status = crease_tree_create(context, points, count, &tree);
    if (status == CREASE_OK)
        status = crease_tree_nearest(context, tree, points, count, (int)k, nearest, squares);
    if (status == CREASE_OK) {
        for (size_t i = 0; i < count; i++)
            keep[i] = sorted[i] = sqrt(squares[i * k + k - 1]);
        usual = crease_select(sorted, count, count / 2);
        *spacing = usual * sqrt(3.14159265358979324 / (double)(k - 1));
        for (size_t i = 0; i < count; i++)
            keep[i] = usual > 0.0 && keep[i] > FAR * usual ? 0.0 : 1.0;
    }
    if (status == CREASE_OK && usual > 0.0)
        status = leave_out_groups(context, points, count, FAR * usual, keep);
    crease_tree_free(tree);
    free(nearest);
    free(squares);
    free(sorted);
    return status;
}
