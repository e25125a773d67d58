/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "fit/isolate.h"

#include "base/memory.h"
#include "base/select.h"
#include "fit/group.h"
#include "space/kdtree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NEIGHBOURS = 8, MOST_SAMPLED = 65536 };

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

/* Of each place, the distance to the eighth neighbour; a place is its own first. */
static crease_status measure(crease_context *context, const crease_tree *tree, const double *places,
    size_t count, double *out)
{
    const size_t most = crease_tree_count(tree), k = most < NEIGHBOURS + 1 ? most : NEIGHBOURS + 1;
    uint32_t *nearest = crease_allocate(context, count, k * sizeof *nearest);
    double *squares = crease_allocate(context, count, k * sizeof *squares);
    crease_status status = nearest && squares ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK)
        status = crease_tree_nearest(context, tree, places, count, (int)k, nearest, squares);
    for (size_t i = 0; i < count && status == CREASE_OK; i++)
        out[i] = sqrt(squares[i * k + k - 1]);
    free(nearest);
    free(squares);
    return status;
}

/* Points whose eighth neighbour is certainly within the distance: any nine that follow each other
 * along the tree and have no larger box. */
static void mark_dense(const crease_tree *tree, double distance, double *keep)
{
    const double *const coordinates[3] = {tree->x, tree->y, tree->z};
    for (size_t i = 0; i + NEIGHBOURS < tree->count; i++) {
        double square = 0.0;
        for (int c = 0; c < 3; c++) {
            double low = coordinates[c][i], high = low;
            for (size_t k = i + 1; k <= i + NEIGHBOURS; k++) {
                const double x = coordinates[c][k];
                low = x < low ? x : low;
                high = x > high ? x : high;
            }
            square += (high - low) * (high - low);
        }
        for (size_t k = i; k <= i + NEIGHBOURS && square <= distance * distance; k++)
            keep[tree->index[k]] = 1.0;
    }
}

/* Measures the points that are not marked. */
static crease_status mark_others(crease_context *context, const crease_tree *tree,
    const double *points, double distance, double *keep)
{
    const size_t count = crease_tree_count(tree);
    size_t others = 0;
    for (size_t i = 0; i < count; i++)
        others += keep[i] > 0.0 ? 0 : 1;
    double *places = crease_allocate(context, others, 4 * sizeof *places);
    if (!places)
        return CREASE_ERROR_NO_MEMORY;
    double *const eighth = places + 3 * others;
    for (size_t i = 0, k = 0; i < count; i++)
        if (!(keep[i] > 0.0))
            memcpy(places + 3 * k++, points + 3 * i, 3 * sizeof *places);
    const crease_status status = measure(context, tree, places, others, eighth);
    for (size_t i = 0, k = 0; i < count && status == CREASE_OK; i++)
        if (!(keep[i] > 0.0))
            keep[i] = eighth[k++] > distance ? 0.0 : 1.0;
    free(places);
    return status;
}

/* Leaves out points that stand alone. What is usual is taken from a sample of many points. */
static crease_status leave_out_single(
    crease_context *context, const double *points, size_t count, double *keep, double *usual)
{
    const size_t sampled = count < (size_t)MOST_SAMPLED ? count : (size_t)MOST_SAMPLED;
    crease_tree *tree = NULL;
    double *places = crease_allocate(context, sampled, 4 * sizeof *places);
    crease_status status =
        places ? crease_tree_create(context, points, count, &tree) : CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < sampled && status == CREASE_OK; i++)
        memcpy(places + 3 * i, points + 3 * (i * count / sampled), 3 * sizeof *places);
    if (status == CREASE_OK)
        status = measure(context, tree, places, sampled, places + 3 * sampled);
    if (status == CREASE_OK) {
        *usual = crease_select(places + 3 * sampled, sampled, sampled / 2);
        for (size_t i = 0; i < count; i++)
            keep[i] = *usual > 0.0 ? 0.0 : 1.0;
        if (*usual > 0.0) {
            mark_dense(tree, FAR * *usual, keep);
            status = mark_others(context, tree, points, FAR * *usual, keep);
        }
    }
    crease_tree_free(tree);
    free(places);
    return status;
}

crease_status crease_isolate(
    crease_context *context, const double *points, size_t count, double *keep, double *spacing)
{
    const size_t k = count < NEIGHBOURS + 1 ? count : NEIGHBOURS + 1;
    double usual = 0.0;
    const crease_status status = leave_out_single(context, points, count, keep, &usual);
    *spacing = usual * sqrt(3.14159265358979324 / (double)(k - 1));
    return status == CREASE_OK && usual > 0.0
        ? leave_out_groups(context, points, count, FAR * usual, keep)
        : status;
}
