/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "mesh/border.h"

#include "base/memory.h"
#include "spline/surface.h"

#include <math.h>
#include <stdlib.h>

/* Control point number i of a border. */
static const double *border_point(const crease_grid *grids, const crease_border *border, size_t i)
{
    const crease_surface *const s = grids[border->surface].surface;
    const size_t row = border->highest ? s->count[border->direction] - 1 : 0;
    return s->control_points +
        3 * (border->direction == 0 ? row * s->count[1] + i : i * s->count[1] + row);
}

static size_t border_count(const crease_grid *grids, const crease_border *border)
{
    return grids[border->surface].surface->count[1 - border->direction];
}

/* Sum of the coordinates of both ends. */
static double end_key(const crease_grid *grids, const crease_border *border)
{
    const double *const a = border_point(grids, border, 0);
    const double *const b = border_point(grids, border, border_count(grids, border) - 1);
    return (a[0] + b[0]) + (a[1] + b[1]) + (a[2] + b[2]);
}

static int compare_borders(const void *left, const void *right)
{
    const crease_border *const a = left;
    const crease_border *const b = right;
    if (a->key != b->key)
        return a->key < b->key ? -1 : 1;
    if (a->surface != b->surface)
        return a->surface < b->surface ? -1 : 1;
    return (2 * a->direction + a->highest) - (2 * b->direction + b->highest);
}

static bool same_points(const crease_grid *grids, const crease_border *a, const crease_border *b,
    bool reversed, double tolerance)
{
    const size_t count = border_count(grids, a);
    for (size_t i = 0; i < count; i++) {
        const double *const p = border_point(grids, a, i);
        const double *const q = border_point(grids, b, reversed ? count - 1 - i : i);
        for (int c = 0; c < 3; c++)
            if (!(fabs(p[c] - q[c]) <= tolerance))
                return false;
    }
    return true;
}

/* Breaks as shares of the domain agree. */
static bool same_breaks(const crease_axis *a, const crease_axis *b, bool reversed)
{
    if (a->span_count != b->span_count)
        return false;
    const size_t n = a->span_count;
    const double first = a->breaks[n] - a->breaks[0];
    const double second = b->breaks[n] - b->breaks[0];
    for (size_t i = 0; i <= n; i++) {
        const double along = (a->breaks[i] - a->breaks[0]) / first;
        const double other = reversed ? (b->breaks[n] - b->breaks[n - i]) / second
                                      : (b->breaks[i] - b->breaks[0]) / second;
        if (!(fabs(along - other) <= 1e-9))
            return false;
    }
    return true;
}

static bool coincide(const crease_grid *grids, const crease_border *a, const crease_border *b,
    bool reversed, double tolerance)
{
    const int along[2] = {1 - a->direction, 1 - b->direction};
    const crease_grid *const first = &grids[a->surface];
    const crease_grid *const second = &grids[b->surface];
    return first->surface->order[along[0]] == second->surface->order[along[1]] &&
        border_count(grids, a) == border_count(grids, b) &&
        same_points(grids, a, b, reversed, tolerance) &&
        same_breaks(&first->axes[along[0]], &second->axes[along[1]], reversed);
}

/* Appends the matches of sorted borders; *out NULL: only counts them. */
static size_t collect(const crease_grid *grids, const crease_border *borders, size_t count,
    double tolerance, crease_match *out)
{
    size_t found = 0;
    for (size_t i = 0; i < count; i++)
        for (size_t j = i + 1; j < count && borders[j].key - borders[i].key <= 6.0 * tolerance;
             j++) {
            const bool forward = coincide(grids, &borders[i], &borders[j], false, tolerance);
            if (!forward && !coincide(grids, &borders[i], &borders[j], true, tolerance))
                continue;
            if (out)
                out[found] = (crease_match){borders[i], borders[j], !forward};
            found++;
        }
    return found;
}

crease_status crease_borders_match(crease_context *context, const crease_grid *grids, size_t count,
    double tolerance, crease_match **out, size_t *match_count)
{
    *out = NULL;
    crease_border *borders = crease_allocate(context, 4 * count, sizeof *borders);
    if (!borders)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < 4 * count; i++) {
        borders[i] =
            (crease_border){.surface = i / 4, .direction = (int)(i / 2 % 2), .highest = i % 2 != 0};
        borders[i].key = end_key(grids, &borders[i]);
    }
    qsort(borders, 4 * count, sizeof *borders, compare_borders);
    *match_count = collect(grids, borders, 4 * count, tolerance, NULL);
    *out = crease_allocate(context, *match_count, sizeof **out);
    if (*out)
        collect(grids, borders, 4 * count, tolerance, *out);
    free(borders);
    return *out ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
}
