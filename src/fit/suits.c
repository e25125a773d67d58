/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Whether a sheet can follow a cloud. Seen along the sheet's z the points fall into square cells of
 * some forty points each; where a surface lies over another, the heights in a cell fall apart in
 * two, or, where walls join the two, reach far.
 */
#include "averaging/orient.h"
#include "base/memory.h"
#include "cloud/cloud.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CELL_POINTS = 40, LEAST_POINTS = 6, LEAST_CELLS = 8, MOST_CELLS = 1 << 24 };

static const double layered_share = 0.2; /* of the cells, up to which a sheet will do */
static const double least_layer = 0.05;  /* of a cell's points; else they are outliers */
static const double least_apart = 0.82;  /* of the variance, between the layers; 0.75: a V */
static const double tail = 0.15;         /* of a cell's points above and below the rest, ... */
static const double least_rise = 1.2;    /* ... which rises by more sides of the cell: no sheet */
static const double rounding = 1e-5;     /* of a cell's side: heights that differ less are equal */

typedef struct cells {
    double low[2], side;
    size_t columns, rows;
    size_t *first;  /* of each cell's points, and the end */
    double *points; /* by cell, three coordinates each */
} cells;

static void lay_out(cells *grid, const double *local, size_t count)
{
    double high[2];
    for (size_t c = 0; c < 2; c++) {
        grid->low[c] = high[c] = local[c];
        for (size_t i = 1; i < count; i++) {
            grid->low[c] = fmin(grid->low[c], local[3 * i + c]);
            high[c] = fmax(high[c], local[3 * i + c]);
        }
    }
    const double width = high[0] - grid->low[0], height = high[1] - grid->low[1];
    const double wanted = fmin(fmax((double)count / CELL_POINTS, 1.0), MOST_CELLS);
    grid->side = fmax(sqrt(width * height / wanted), fmax(width, height) / wanted);
    grid->columns = grid->side > 0.0 ? (size_t)(width / grid->side) + 1 : 1;
    grid->rows = grid->side > 0.0 ? (size_t)(height / grid->side) + 1 : 1;
}

static size_t cell_of(const cells *grid, const double place[3])
{
    if (!(grid->side > 0.0))
        return 0;
    const size_t column = (size_t)((place[0] - grid->low[0]) / grid->side);
    const size_t row = (size_t)((place[1] - grid->low[1]) / grid->side);
    return (row < grid->rows ? row : grid->rows - 1) * grid->columns +
        (column < grid->columns ? column : grid->columns - 1);
}

/* Sorts the points by cell. */
static crease_status fill(crease_context *context, cells *grid, const double *local, size_t count)
{
    const size_t cell_count = grid->columns * grid->rows;
    grid->first = crease_allocate(context, cell_count + 2, sizeof *grid->first);
    grid->points = crease_allocate(context, count, 3 * sizeof *grid->points);
    if (!grid->first || !grid->points)
        return CREASE_ERROR_NO_MEMORY;
    size_t *const next = grid->first + 1; /* where the next point of a cell goes */
    for (size_t i = 0; i < count; i++)
        next[cell_of(grid, local + 3 * i) + 1]++;
    for (size_t cell = 1; cell <= cell_count; cell++)
        next[cell] += next[cell - 1];
    for (size_t i = 0; i < count; i++)
        memcpy(grid->points + 3 * next[cell_of(grid, local + 3 * i)]++, local + 3 * i,
            3 * sizeof *local);
    return CREASE_OK;
}

/* Turns the points' heights into those above their regression plane and gathers them. */
static void level(const double *points, size_t count, double *heights)
{
    double mean[3] = {0}, xx = 0.0, xy = 0.0, yy = 0.0, xz = 0.0, yz = 0.0;
    for (size_t i = 0; i < 3 * count; i++)
        mean[i % 3] += points[i] / (double)count;
    for (size_t i = 0; i < count; i++) {
        const double x = points[3 * i] - mean[0], y = points[3 * i + 1] - mean[1];
        const double z = points[3 * i + 2] - mean[2];
        xx += x * x, xy += x * y, yy += y * y, xz += x * z, yz += y * z;
    }
    const double det = xx * yy - xy * xy;
    const bool flat = det > 1e-9 * (xx + yy) * (xx + yy);
    const double a = flat ? (xz * yy - yz * xy) / det : 0.0;
    const double b = flat ? (yz * xx - xz * xy) / det : 0.0;
    for (size_t i = 0; i < count; i++)
        heights[i] = points[3 * i + 2] - a * points[3 * i] - b * points[3 * i + 1];
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Whether the heights, which get sorted, fall apart into two groups. */
static bool is_layered(double *heights, size_t count, double side)
{
    double sum = 0.0, square = 0.0, below = 0.0, best = 0.0;
    const double n = (double)count, least = fmax(2.0, least_layer * n);
    qsort(heights, count, sizeof *heights, ascending);
    const double middle = heights[count / 2];
    for (size_t i = 0; i < count; i++) {
        sum += heights[i] - middle;
        square += (heights[i] - middle) * (heights[i] - middle);
    }
    for (size_t i = 0; i + 1 < count; i++) {
        const double low = (double)(i + 1), high = n - low;
        below += heights[i] - middle;
        const double step = below / low - (sum - below) / high;
        if (low >= least && high >= least)
            best = fmax(best, low * high / n * step * step);
    }
    const double spread = square - sum * sum / n;
    return best > least_apart * spread && spread > n * pow(rounding * side, 2.0);
}

/* Whether the heights, ascending, reach farther than those of a sheet, which a plane follows: as
 * where walls and bores lie between the top and the bottom of a block. */
static bool is_tall(const double *heights, size_t count, double side)
{
    const size_t aside = (size_t)(tail * (double)count);
    return heights[count - 1 - aside] - heights[aside] > least_rise * side;
}

/* Few cells say nothing. heights: room for those of all points. */
static bool has_few_layers(const cells *grid, double *heights)
{
    size_t layered = 0, count = 0;
    for (size_t cell = 0; cell < grid->columns * grid->rows; cell++) {
        const size_t begin = grid->first[cell], size = grid->first[cell + 1] - begin;
        if (size < LEAST_POINTS)
            continue;
        level(grid->points + 3 * begin, size, heights);
        layered += is_layered(heights, size, grid->side) || is_tall(heights, size, grid->side);
        count++;
    }
    return count < LEAST_CELLS || (double)layered <= layered_share * (double)count;
}

crease_status crease_sheet_suits(crease_context *context, const crease_cloud *cloud, bool *suits)
{
    const size_t count = crease_cloud_count(cloud);
    crease_oriented oriented;
    cells grid = {0};
    *suits = false;
    crease_status status =
        crease_orient_find(context, crease_cloud_points(cloud), count, &oriented);
    if (status != CREASE_OK)
        return status;
    double *const local = crease_allocate(context, count, 3 * sizeof *local);
    if (!local)
        return CREASE_ERROR_NO_MEMORY;
    crease_frame_enter(&oriented.frame, crease_cloud_points(cloud), count, local);
    lay_out(&grid, local, count);
    status = fill(context, &grid, local, count);
    if (status == CREASE_OK)
        *suits = has_few_layers(&grid, local);
    free(grid.first);
    free(grid.points);
    free(local);
    return status;
}
