/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Knots as unknowns. To first order, moving a crease by d takes -d K from the sheet beyond it, K
 * being the jump of the slope; turning the frame by a takes a (f_x y - f_y x). With these as
 * further columns of the least-squares problem the control points are eliminated, and what is left
 * is a small system for the steps.
 *
 * Based on: Golub, Pereyra. The differentiation of pseudo-inverses and nonlinear least squares
 * problems whose variables separate. 1973. */
#include "fit/lines.h"

#include "base/memory.h"

#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 2 * CREASE_MOST_LINES + 1, HALVINGS = 5, MOST_ROWS = 16 };

static const double WORTH = 0.01;  /* log likelihood */
static const double EXACT = 1e-10; /* mean distance in spacings at which there is nothing to gain */
static const double LEAST_DETERMINED = 1e-9; /* share of a column not explained by the others */

/* The small system: reduced[i][j] of the steps, their right side, and which are determined. */
typedef struct equations {
    size_t count, lines;
    double reduced[MOST * MOST], right[MOST];
    bool free[MOST];
} equations;

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

/* The further columns at one sample, as distances along the normal. */
static void columns_at(const crease_draft *draft, size_t i, size_t count, double *out)
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
static void add_sample(const crease_draft *draft, size_t i, equations *e, double *mixed)
{
    const crease_samples *const s = draft->samples;
    const crease_side sides[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
    const size_t order = (size_t)draft->height.order;
    double columns[MOST];
    crease_support support;
    columns_at(draft, i, e->count, columns);
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

static void hold_undetermined(const crease_draft *draft, const double *whole, equations *e)
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

/* Eliminates the control points. */
static crease_status build(crease_context *context, crease_draft *draft, bool turn, equations *e)
{
    memset(e, 0, sizeof *e);
    e->lines = line_count(&draft->layout);
    e->count = e->lines + turn;
    const size_t size = draft->system.size;
    double *mixed = crease_allocate(context, size, 2 * MOST * sizeof *mixed);
    if (!mixed)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < draft->samples->count; i++)
        if (draft->samples->weight[i] > 0.0)
            add_sample(draft, i, e, mixed);
    double *const solved = mixed + MOST * size;
    const crease_status status =
        crease_system_solve_others(context, &draft->system, mixed, e->count, solved);
    double whole[MOST];
    for (size_t c = 0; c < e->count; c++) {
        whole[c] = e->reduced[c * MOST + c];
        for (size_t k = 0; k < e->count; k++)
            for (size_t i = 0; i < size; i++)
                e->reduced[c * MOST + k] -= mixed[c * size + i] * solved[k * size + i];
    }
    hold_undetermined(draft, whole, e);
    free(mixed);
    return status;
}

/* The system of the determined steps, packed; returns their number and their places. */
static size_t pack(const equations *e, double *matrix, size_t *place)
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

static bool solve(const equations *e, double *step)
{
    double matrix[MOST * MOST], right[MOST];
    size_t place[MOST];
    memset(step, 0, MOST * sizeof *step);
    const lapack_int n = (lapack_int)pack(e, matrix, place);
    for (lapack_int a = 0; a < n; a++)
        right[a] = e->right[place[a]];
    if (n == 0 || LAPACKE_dposv_work(LAPACK_COL_MAJOR, 'L', n, 1, matrix, n, right, n) != 0)
        return false;
    for (lapack_int a = 0; a < n; a++)
        step[place[a]] = right[a];
    return true;
}

static double limit(double value, double most)
{
    return fmin(fmax(value, -most), most);
}

/* The draft with a share of the step; false when lines would collide. */
static bool moved(
    const crease_draft *draft, const double *step, double share, bool turn, crease_draft *out)
{
    crease_layout layout = draft->layout;
    crease_frame frame = draft->frame;
    const double spacing = draft->samples->spacing, most = 3.0 * spacing;
    size_t column = 0;
    for (int d = 0; d < 2; d++) {
        layout.axis[d].line_count = 0;
        for (size_t l = 0; l < draft->layout.axis[d].line_count; l++)
            if (!crease_layout_add(&layout, d,
                    draft->layout.axis[d].lines[l] + share * limit(step[column++], most), spacing))
                return false;
    }
    if (turn)
        crease_frame_turn(&frame, share * limit(step[column], 0.05));
    *out = crease_draft_variant(draft, &layout, &frame);
    return true;
}

/* Fits a draft, one much like it being at hand. */
static crease_status fit_like(
    crease_context *context, const crease_draft *like, crease_draft *draft, crease_choice choice)
{
    if (like->warm) {
        const crease_status status =
            crease_draft_begin(context, draft, &like->height, &like->layout);
        return status == CREASE_OK ? crease_draft_fit(context, draft, 1, choice) : status;
    }
    crease_draft_place(draft);
    return crease_draft_fit(context, draft, draft->orthogonal ? 4 : 3, choice);
}

/* Takes the largest of 1, 1/2, 1/4 .. of the step that brings a gain worth a trial; else the draft
 * stays. */
static crease_status walk(
    crease_context *context, crease_draft *draft, const double *step, bool turn, bool *gained)
{
    const double least = draft->mean * exp(-WORTH / draft->samples->used);
    const bool bounded = crease_draft_bounded(draft);
    double share = 1.0;
    *gained = false;
    for (int i = 0; i < HALVINGS; i++, share *= 0.5) {
        crease_draft trial;
        if (!moved(draft, step, share, turn, &trial))
            continue;
        const crease_status status = fit_like(context, draft, &trial, CREASE_CHOICE_NONE);
        if (status == CREASE_OK && trial.mean < least &&
            (!bounded || crease_draft_bounded(&trial))) {
            crease_draft_free(draft);
            *draft = trial;
            *gained = true;
            return CREASE_OK;
        }
        crease_draft_free(&trial);
        if (status != CREASE_OK && status != CREASE_ERROR_NUMERIC)
            return status;
    }
    return CREASE_OK;
}

crease_status crease_lines_refine(
    crease_context *context, crease_draft *draft, int steps, bool turn)
{
    if (line_count(&draft->layout) == 0)
        return CREASE_OK;
    const double exact = fmax(4.0 * draft->samples->rounding, EXACT * draft->samples->spacing);
    crease_status status = CREASE_OK;
    bool gained = true, tried = false; /* tried: the samples are those of a trial */
    for (int i = 0; i < steps && gained && draft->mean > exact && status == CREASE_OK; i++) {
        equations e;
        double step[MOST];
        gained = false;
        status = build(context, draft, turn, &e);
        if (status == CREASE_OK && solve(&e, step)) {
            status = walk(context, draft, step, turn, &gained);
            tried = !gained;
        }
    }
    if (status == CREASE_OK && (tried || !draft->warm))
        status = fit_like(
            context, draft, draft, draft->orthogonal ? CREASE_CHOICE_NONE : CREASE_CHOICE_NEAR);
    return status;
}

crease_status crease_lines_errors(
    crease_context *context, crease_draft *draft, double errors[2 * CREASE_MOST_LINES])
{
    equations e;
    memset(errors, 0, 2 * CREASE_MOST_LINES * sizeof *errors);
    const crease_status status = build(context, draft, false, &e);
    if (status != CREASE_OK)
        return status;
    double matrix[MOST * MOST], sum = 0.0, total = 0.0;
    size_t place[MOST];
    const lapack_int n = (lapack_int)pack(&e, matrix, place);
    if (n == 0 || LAPACKE_dpotrf_work(LAPACK_COL_MAJOR, 'L', n, matrix, n) != 0 ||
        LAPACKE_dpotri_work(LAPACK_COL_MAJOR, 'L', n, matrix, n) != 0)
        return CREASE_OK;
    const crease_samples *const s = draft->samples;
    for (size_t i = 0; i < s->count; i++) {
        sum += s->weight[i] * s->residual[i] * s->residual[i];
        total += s->weight[i];
    }
    const double variance = sum / fmax(1.0, total - draft->freedom);
    for (lapack_int a = 0; a < n; a++)
        errors[place[a]] = sqrt(variance * matrix[a * n + a]);
    return CREASE_OK;
}
