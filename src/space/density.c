/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "space/density.h"

#include "base/memory.h"
#include "base/select.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { AROUND = 8, SAMPLED = 4000 };

static const double PI = 3.14159265358979323846;

crease_status crease_density_spacings(crease_context *context, const double *points, size_t count,
    const double *shares, size_t share_count, double *spacings)
{
    const size_t step = count / SAMPLED + 1, samples = (count - 1) / step + 1;
    crease_tree *tree = NULL;
    double *const queries = crease_allocate(context, samples, 3 * sizeof *queries);
    double *const squared = crease_allocate(context, samples, AROUND * sizeof *squared);
    uint32_t *const near = crease_allocate(context, samples, AROUND * sizeof *near);
    crease_status status = queries && squared && near ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < samples && status == CREASE_OK; i++)
        memcpy(queries + 3 * i, points + 3 * i * step, 3 * sizeof *queries);
    if (status == CREASE_OK)
        status = crease_tree_create(context, points, count, &tree);
    if (status == CREASE_OK)
        status = crease_tree_nearest(context, tree, queries, samples, AROUND, near, squared);
    for (size_t i = 0; i < samples && status == CREASE_OK; i++)
        squared[i] = squared[AROUND * i + AROUND - 1];
    for (size_t i = 0; i < share_count && status == CREASE_OK; i++) {
        const size_t rank = (size_t)(shares[i] * (double)(samples - 1));
        spacings[i] = sqrt(PI * crease_select(squared, samples, rank) / AROUND);
    }
    crease_tree_free(tree);
    free(queries);
    free(squared);
    free(near);
    return status;
}
