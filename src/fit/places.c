/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Knots as unknowns. To first order, moving a crease by d takes -d K from the sheet beyond it, K
 * being the jump of the slope; turning the frame by a takes a (f_x y - f_y x). With these as
 * further columns of the least-squares problem the control points are eliminated, and what is left
 * is a small system for the steps.
 *
 * Based on: Golub, Pereyra. The differentiation of pseudo-inverses and nonlinear least squares
 * problems whose variables separate. 1973. */
#include "fit/places.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = CREASE_MOST_PLACES, MOST_ROWS = 16 };

static const double LEAST_DETERMINED = 1e-9; /* share of a column not explained by the others */

static size_t line_count(const crease_layout *layout)
{
    return layout->axis[0].line_count + layout->axis[1].line_count;
}

static double slope_jump(const crease_height *height, int direction, double at, double other)
{
    double uv[2], right[3], left[3];
    crease_side sides[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
    uv[direction] = at;
    uv[1 - direction] = other;
    crease_height_at(height, uv, sides, 1, right);
    sides[direction] = CREASE_SIDE_LEFT;
    crease_height_at(height, uv, sides, 1, left);
    return right[1 + direction] - left[1 + direction];
}

void crease_places_columns(const crease_draft *draft, size_t i, size_t count, double *out)
{
    const double *const uv = draft->samples->uv + 2 * i, tilt = draft->samples->tilt[i];
    size_t column = 0;
    for (int d = 0; d < 2; d++)
        for (size_t l = 0; l < draft->layout.axis[d].line_count; l++) {
            const double at = draft->layout.axis[d].lines[l];
            const double beyond = uv[d] > at ? 1.0 : (uv[d] < at ? 0.0 : 0.5);
            out[column++] =
                beyond > 0.0 ? -tilt * beyond * slope_jump(&draft->height, d, at, uv[1 - d]) : 0.0;
        }
    if (column < count) {
        const crease_side sides[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
        double f[3];
        crease_height_at(&draft->height, uv, sides, 1, f);
        out[column] = tilt * (f[1] * uv[1] - f[2] * uv[0]);
    }
}

/* Adds one sample to both products of the columns: with the basis, and with each other. */
static void add_sample(const crease_draft *draft, size_t i, crease_places *e, double *mixed)
{
    const crease_samples *const s = draft->samples;
    const crease_side sides[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
    const size_t order = (size_t)draft->height.order;
    double columns[MOST];
    crease_support support;
    crease_places_columns(draft, i, e->count, columns);
    crease_height_support(&draft->height, s->uv + 2 * i, sides, 0, &support);
    for (size_t c = 0; c < e->count; c++) {
        const double scaled = s->weight[i] * columns[c];
        if (scaled == 0.0)
            continue;
        e->right[c] += scaled * s->residual[i];
        for (size_t k = 0; k < e->count; k++)
            e->reduced[c * MOST + k] += scaled * columns[k];
        for (size_t a = 0; a < order; a++)
            for (size_t b = 0; b < order; b++)
                mixed[c * draft->system.size + (support.first[0] + a) * draft->height.count[1] +
                    support.first[1] + b] +=
                    scaled * s->tilt[i] * support.values[0][a] * support.values[1][b];
    }
}

/* Points by their distance from a line, in half spacings, on either side. */
typedef struct beside {
    size_t points[2][MOST_ROWS];
} beside;

static void count_beside(const crease_draft *draft, int direction, double at, beside *out)
{
    const crease_samples *const s = draft->samples;
    double part[2][2];
    memset(out, 0, sizeof *out);
    crease_layout_between(&draft->layout, direction, at, part[1]);
    crease_layout_between(&draft->layout, direction, nextafter(at, -INFINITY), part[0]);
    for (size_t i = 0; i < s->count; i++) {
        const double p = s->points[3 * i + (size_t)direction], off = p - at;
        const double row = floor(2.0 * fabs(off) / s->spacing + 0.5);
        if (!(s->prior[i] > 0.0) || !(row < MOST_ROWS) || p < part[0][0] || p > part[1][1])
            continue;
        if (off <= 0.0 || row == 0.0)
            out->points[0][(size_t)row]++;
        if (off >= 0.0 || row == 0.0)
            out->points[1][(size_t)row]++;
    }
}

/* Two rows of points lie on a plane wherever the line is: of three rows or more, those with many
 * points, some side must tell. */
static bool rows_tell(const crease_draft *draft, int direction, double at)
{
    beside b;
    size_t fullest = 0;
    count_beside(draft, direction, at, &b);
    for (int side = 0; side < 2; side++)
        for (size_t i = 0; i < MOST_ROWS; i++)
            fullest = b.points[side][i] > fullest ? b.points[side][i] : fullest;
    bool tell = false;
    for (int side = 0; side < 2; side++) {
        size_t rows = 0;
        for (size_t i = 0; i < MOST_ROWS; i++)
            rows += b.points[side][i] > 0 && 3 * b.points[side][i] >= fullest;
        tell = tell || rows > 2;
    }
    return tell;
}

static void hold_undetermined(const crease_draft *draft, const double *whole, crease_places *e)
{
    size_t column = 0;
    for (int d = 0; d < 2; d++)
        for (size_t l = 0; l < draft->layout.axis[d].line_count; l++, column++)
            e->free[column] = rows_tell(draft, d, draft->layout.axis[d].lines[l]);
    if (column < e->count)
        e->free[column] = true;
    for (size_t c = 0; c < e->count; c++)
        e->free[c] = e->free[c] && e->reduced[c * MOST + c] > LEAST_DETERMINED * whole[c];
}

crease_status crease_places_sum(
    crease_context *context, crease_draft *draft, bool turn, crease_places *e)
{
    memset(e, 0, sizeof *e);
    e->lines = line_count(&draft->layout);
    e->count = e->lines + turn;
    const size_t size = draft->system.size;
    double *mixed = crease_allocate(context, size, MOST * sizeof *mixed);
    if (!mixed)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < draft->samples->count; i++)
        if (draft->samples->weight[i] > 0.0)
            add_sample(draft, i, e, mixed);
    crease_status status = CREASE_ERROR_NO_MEMORY;
    double *const solved = e->solved = crease_allocate(context, size, MOST * sizeof *solved);
    if (solved)
        status = crease_system_solve_others(context, &draft->system, mixed, e->count, solved);
    double whole[MOST];
    for (size_t c = 0; c < e->count && status == CREASE_OK; c++) {
        whole[c] = e->reduced[c * MOST + c];
        for (size_t k = 0; k < e->count; k++)
            for (size_t i = 0; i < size; i++)
                e->reduced[c * MOST + k] -= mixed[c * size + i] * solved[k * size + i];
    }
    if (status == CREASE_OK)
        hold_undetermined(draft, whole, e);
    free(mixed);
    return status;
}

size_t crease_places_pack(const crease_places *e, double *matrix, size_t *place)
{
    size_t n = 0;
    for (size_t c = 0; c < e->count; c++)
        if (e->free[c])
            place[n++] = c;
    for (size_t a = 0; a < n; a++)
        for (size_t b = 0; b < n; b++)
            matrix[a * n + b] = e->reduced[place[a] * MOST + place[b]];
    return n;
}

void crease_places_free(crease_places *places)
{
    free(places->solved);
    places->solved = NULL;
}
