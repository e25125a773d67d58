/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Normal equations in a band. Pulled to points, the three coordinates are three right sides of one
 * matrix; pulled to planes, they are coupled and every control point is three unknowns. */
#include "fit/form_fit.h"

#include "base/memory.h"
#include "spline/knots.h"

#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_LOCAL = CREASE_HEIGHT_ORDER_MAX * CREASE_HEIGHT_ORDER_MAX };

/* How strongly the form is kept from gliding, in shares of the pull to the planes. */
static const double GRIP = 0.01;
/* And how strongly its borders are drawn to points beyond them. */
static const double GRIP_OUTSIDE = 0.2;
static const double LEAST_SAY = 1e-6; /* of the largest, for a control point to count */
/* Control points of which the points say less than BARE of the mean are held STIFFER: they would
 * follow the noise of the few points that reach them. */
static const double BARE = 3e-3, STIFFER = 1e4;

typedef struct equations {
    crease_form *form;
    size_t block; /* unknowns for each control point: 1 or 3 */
    size_t sides; /* right sides: 3 or 1 */
    size_t size, width, stride[2];
    double *matrix; /* size x width, as LAPACK stores a lower band */
    double *right;  /* sides x size */
    double *say;    /* of each control point */
    double bare;    /* who has less of it is held stiffer */
} equations;

static size_t index_of(const equations *e, size_t i, size_t j)
{
    return e->stride[0] * i + e->stride[1] * j;
}

static crease_status create(
    crease_context *context, crease_form *form, crease_pull pull, equations *out)
{
    const size_t rows = form->basis.count[0], columns = form->basis.count[1];
    const size_t degree = (size_t)form->basis.order - 1;
    const bool upright = columns <= rows;
    *out = (equations){.form = form,
        .block = pull == CREASE_PULL_POINTS ? 1 : 3,
        .sides = pull == CREASE_PULL_POINTS ? 3 : 1,
        .stride = {upright ? columns : 1, upright ? 1 : rows}};
    out->size = out->block * rows * columns;
    out->width = out->block * (degree * (upright ? columns : rows) + degree + 1);
    out->matrix = crease_allocate(context, out->size, out->width * sizeof(double));
    out->right = crease_allocate(context, out->size, out->sides * sizeof(double));
    out->say = crease_allocate(context, rows * columns, sizeof(double));
    return out->matrix && out->right && out->say ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
}

static void release(equations *e)
{
    free(e->matrix);
    free(e->right);
    free(e->say);
}

/* Adds weight * tensor (block x block) to the block of two control points, index b >= a. */
static void add_block(equations *e, size_t a, size_t b, double weight, const double *tensor)
{
    const size_t n = e->block;
    for (size_t c = 0; c < n; c++) {
        double *const column = e->matrix + (n * a + c) * e->width;
        for (size_t r = a == b ? c : 0; r < n; r++)
            column[n * (b - a) + r - c] += weight * tensor[n * r + c];
    }
}

static bool at_border(const crease_form *form, const double uv[2])
{
    const crease_layout_axis *const axis = form->layout.axis;
    return uv[0] <= axis[0].low || uv[0] >= axis[0].high || uv[1] <= axis[1].low ||
        uv[1] >= axis[1].high;
}

/* What a point pulls to, and how strongly in each direction. */
static void pull_of(
    const equations *e, const crease_feet *feet, size_t i, double target[3], double tensor[9])
{
    if (e->block == 1) {
        memcpy(target, feet->points + 3 * i, 3 * sizeof *target);
        tensor[0] = 1.0;
        return;
    }
    const double *const n = feet->normal + 3 * i;
    const bool outside = at_border(e->form, feet->uv + 2 * i);
    const double grip = outside ? GRIP_OUTSIDE : GRIP;
    for (size_t r = 0; r < 3; r++) {
        target[r] =
            outside ? feet->points[3 * i + r] : feet->foot[3 * i + r] + n[r] * feet->residual[i];
        for (size_t c = 0; c < 3; c++)
            tensor[3 * r + c] = (1.0 - grip) * n[r] * n[c] + (r == c ? grip : 0.0);
    }
}

static void add_point(equations *e, const crease_feet *feet, size_t i)
{
    const size_t order = (size_t)e->form->basis.order, count = order * order;
    const bool upright = e->stride[1] == 1;
    double local[MOST_LOCAL], target[3], tensor[9], side[3];
    size_t index[MOST_LOCAL];
    crease_support s;
    crease_form_support(e->form, feet->strip[i], feet->uv + 2 * i, 0, &s);
    pull_of(e, feet, i, target, tensor);
    for (int r = 0; r < 3; r++)
        side[r] = e->block == 1 ? target[r]
                                : tensor[3 * r] * target[0] + tensor[3 * r + 1] * target[1] +
                tensor[3 * r + 2] * target[2];
    for (size_t k = 0; k < count; k++) {
        const size_t a = upright ? k / order : k % order, b = upright ? k % order : k / order;
        local[k] = s.values[0][a] * s.values[1][b];
        index[k] = index_of(e, s.first[0] + a, s.first[1] + b);
    }
    for (size_t a = 0; a < count; a++) {
        const double scaled = feet->weight[i] * local[a];
        e->say[index[a]] += scaled * local[a];
        for (size_t c = 0; c < 3; c++)
            e->right[e->block == 1 ? c * e->size + index[a] : 3 * index[a] + c] += scaled * side[c];
        for (size_t b = a; b < count; b++)
            add_block(e, index[a], index[b], scaled * local[b], tensor);
    }
}

/* --------------------------------------------------------------------------------- bending -- */

/* Second divided differences of three control points in a row. */
typedef struct difference {
    size_t index[3];
    double weight[3];
} difference;

static void add_difference(equations *e, const difference *d, double weight)
{
    static const double unit[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    for (size_t a = 0; a < 3; a++)
        for (size_t b = 0; b < 3; b++)
            if (d->index[b] >= d->index[a])
                add_block(e, d->index[a], d->index[b], weight * d->weight[a] * d->weight[b], unit);
}

static bool is_line(const crease_layout_axis *axis, double t)
{
    for (size_t l = 0; l < axis->line_count; l++)
        if (fabs(axis->lines[l] - t) < 1e-9 * (axis->high - axis->low))
            return true;
    return false;
}

static bool is_bare(const equations *e, const difference *d)
{
    return fmin(e->say[d->index[0]], fmin(e->say[d->index[1]], e->say[d->index[2]])) < e->bare;
}

/* Sum of the squares of the weights of all differences, or, with share, their matrix added. */
static double bend_along(equations *e, int direction, const double *places, double share)
{
    const size_t *const count = e->form->basis.count;
    const double whole = e->form->layout.axis[direction].high - e->form->layout.axis[direction].low;
    double sum = 0.0;
    for (size_t i = 1; i + 1 < count[direction]; i++) {
        const double *const t = places + i;
        if (is_line(&e->form->layout.axis[direction], t[0]))
            continue;
        const double before = (t[0] - t[-1]) / whole, behind = (t[1] - t[0]) / whole;
        /* times the length that the difference stands for */
        const double scale = sqrt(0.5 * (before + behind)) * 2.0 / (before + behind);
        difference d = {
            .weight = {scale / before, -scale / before - scale / behind, scale / behind}};
        for (size_t j = 0; j < count[1 - direction]; j++) {
            for (size_t k = 0; k < 3; k++)
                d.index[k] = direction == 0 ? index_of(e, i + k - 1, j) : index_of(e, j, i + k - 1);
            for (size_t k = 0; k < 3; k++)
                sum += d.weight[k] * d.weight[k];
            if (share > 0.0)
                add_difference(e, &d, is_bare(e, &d) ? STIFFER * share : share);
        }
    }
    return sum;
}

static crease_status add_bending(crease_context *context, equations *e, double smoothing)
{
    const crease_height *const basis = &e->form->basis;
    double *const places =
        crease_allocate(context, basis->count[0] + basis->count[1], sizeof *places);
    if (!places)
        return CREASE_ERROR_NO_MEMORY;
    double data = 0.0, bending = 0.0;
    for (size_t i = 0; i < basis->count[0] * basis->count[1]; i++)
        data += e->say[i];
    e->bare = BARE * data / (double)(basis->count[0] * basis->count[1]);
    for (int pass = 0; pass < 2; pass++)
        for (int d = 0; d < 2; d++) {
            double *const at = places + (d ? basis->count[0] : 0);
            crease_knots_greville(basis->knots[d], basis->order, basis->count[d], at);
            const double share = pass ? smoothing * data / bending : 0.0;
            const double sum = bend_along(e, d, at, share);
            bending += pass ? 0.0 : sum;
        }
    free(places);
    return CREASE_OK;
}

/* --------------------------------------------------------------------------------- solving -- */

static bool solve(equations *e)
{
    const lapack_int size = (lapack_int)e->size, width = (lapack_int)e->width;
    return LAPACKE_dpbtrf_work(LAPACK_COL_MAJOR, 'L', size, width - 1, e->matrix, width) == 0 &&
        LAPACKE_dpbtrs_work(LAPACK_COL_MAJOR, 'L', size, width - 1, (lapack_int)e->sides, e->matrix,
            width, e->right, size) == 0;
}

static void take(const equations *e)
{
    const size_t *const count = e->form->basis.count;
    for (size_t i = 0; i < count[0]; i++)
        for (size_t j = 0; j < count[1]; j++)
            for (size_t c = 0; c < 3; c++) {
                const size_t index = index_of(e, i, j);
                e->form->net[3 * (i * count[1] + j) + c] =
                    e->right[e->block == 1 ? c * e->size + index : 3 * index + c];
            }
}

static size_t count_freedom(const equations *e)
{
    const size_t count = e->size / e->block;
    double most = 0.0;
    size_t freedom = 0;
    for (size_t i = 0; i < count; i++)
        most = fmax(most, e->say[i]);
    for (size_t i = 0; i < count; i++)
        freedom += e->say[i] > LEAST_SAY * most;
    return freedom;
}

crease_status crease_form_fit(crease_context *context, crease_form *form, const crease_feet *feet,
    crease_pull pull, double smoothing, size_t *freedom, bool *solved)
{
    equations e;
    *solved = false;
    crease_status status = create(context, form, pull, &e);
    for (size_t i = 0; i < feet->count && status == CREASE_OK; i++)
        if (feet->weight[i] > 0.0)
            add_point(&e, feet, i);
    if (status == CREASE_OK)
        status = add_bending(context, &e, smoothing);
    if (status == CREASE_OK) {
        *freedom = count_freedom(&e);
        *solved = solve(&e);
        if (*solved)
            take(&e);
    }
    release(&e);
    return status;
}
