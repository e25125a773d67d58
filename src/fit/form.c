/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "fit/form.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "base/vector.h"

#include <stdlib.h>
#include <string.h>

enum { GRAIN = 1024, STEPS = 5, HALVINGS = 4 };

crease_status crease_form_create(
    crease_context *context, const crease_layout *layout, crease_form *out)
{
    *out = (crease_form){.layout = *layout};
    crease_status status = crease_height_create(context, layout, &out->basis);
    if (status == CREASE_OK) {
        out->net = crease_allocate(
            context, out->basis.count[0] * out->basis.count[1], 3 * sizeof *out->net);
        if (!out->net)
            status = CREASE_ERROR_NO_MEMORY;
    }
    if (status != CREASE_OK)
        crease_form_free(out);
    return status;
}

void crease_form_free(crease_form *form)
{
    crease_height_free(&form->basis);
    free(form->net);
    form->net = NULL;
}

void crease_form_support(
    const crease_form *form, size_t strip, const double uv[2], int derivatives, crease_support *out)
{
    const crease_layout_axis *const axis = &form->layout.axis[0];
    const bool end = strip < axis->line_count && uv[0] >= axis->lines[strip];
    const crease_side sides[2] = {end ? CREASE_SIDE_LEFT : CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
    crease_height_support(&form->basis, uv, sides, derivatives, out);
}

void crease_form_at(const crease_form *form, size_t strip, const double uv[2], double out[3][3])
{
    crease_support s;
    crease_form_support(form, strip, uv, 1, &s);
    memset(out, 0, 9 * sizeof(double));
    for (int i = 0; i < form->basis.order; i++) {
        const double *row =
            form->net + 3 * ((s.first[0] + (size_t)i) * form->basis.count[1] + s.first[1]);
        for (int j = 0; j < form->basis.order; j++, row += 3) {
            const double weights[3] = {s.values[0][i] * s.values[1][j],
                s.slopes[0][i] * s.values[1][j], s.values[0][i] * s.slopes[1][j]};
            for (int d = 0; d < 3; d++)
                for (int c = 0; c < 3; c++)
                    out[d][c] += weights[d] * row[c];
        }
    }
}

/* ------------------------------------------------------------------------------------- feet -- */

crease_status crease_feet_create(
    crease_context *context, const double *points, size_t count, crease_feet *out)
{
    *out = (crease_feet){.count = count, .points = points};
    out->strip = crease_allocate(context, count, sizeof *out->strip);
    out->uv = crease_allocate(context, count, 2 * sizeof(double));
    out->foot = crease_allocate(context, count, 3 * sizeof(double));
    out->normal = crease_allocate(context, count, 3 * sizeof(double));
    out->residual = crease_allocate(context, count, sizeof(double));
    out->clear = crease_allocate(context, count, sizeof(double));
    out->prior = crease_allocate(context, count, sizeof(double));
    out->weight = crease_allocate(context, count, sizeof(double));
    if (out->strip && out->uv && out->foot && out->normal && out->residual && out->clear &&
        out->prior && out->weight)
        return CREASE_OK;
    crease_feet_free(out);
    return CREASE_ERROR_NO_MEMORY;
}

void crease_feet_free(crease_feet *feet)
{
    free(feet->strip);
    free(feet->uv);
    free(feet->foot);
    free(feet->normal);
    free(feet->residual);
    free(feet->clear);
    free(feet->prior);
    free(feet->weight);
    *feet = (crease_feet){.count = 0};
}

static crease_status borrow(crease_context *context, const crease_feet *from, double reach,
    double *kept, uint32_t *number, uint32_t *near, double *squares, crease_feet *to)
{
    size_t count = 0;
    crease_tree *tree = NULL;
    for (size_t i = 0; i < from->count; i++)
        if (from->prior[i] > 0.0) {
            memcpy(kept + 3 * count, from->points + 3 * i, 3 * sizeof *kept);
            number[count++] = (uint32_t)i;
        }
    if (count == 0)
        return CREASE_OK;
    crease_status status = crease_tree_create(context, kept, count, &tree);
    if (status == CREASE_OK)
        status = crease_tree_nearest(context, tree, to->points, to->count, 1, near, squares);
    for (size_t i = 0; i < to->count && status == CREASE_OK; i++) {
        const size_t other = number[near[i]];
        to->strip[i] = from->strip[other];
        memcpy(to->uv + 2 * i, from->uv + 2 * other, 2 * sizeof(double));
        to->prior[i] = squares[i] <= reach * reach;
    }
    crease_tree_free(tree);
    return status;
}

crease_status crease_feet_borrow(
    crease_context *context, const crease_feet *from, double reach, crease_feet *to)
{
    double *const kept = crease_allocate(context, from->count, 3 * sizeof *kept);
    uint32_t *const number = crease_allocate(context, from->count, sizeof *number);
    uint32_t *const near = crease_allocate(context, to->count, sizeof *near);
    double *const squares = crease_allocate(context, to->count, sizeof *squares);
    const crease_status status = kept && number && near && squares
        ? borrow(context, from, reach, kept, number, near, squares, to)
        : CREASE_ERROR_NO_MEMORY;
    free(kept);
    free(number);
    free(near);
    free(squares);
    return status;
}

/* The rectangle of a strip. */
static void box_of(const crease_form *form, size_t strip, double low[2], double high[2])
{
    const crease_layout_axis *const axis = form->layout.axis;
    low[0] = strip > 0 ? axis[0].lines[strip - 1] : axis[0].low;
    high[0] = strip < axis[0].line_count ? axis[0].lines[strip] : axis[0].high;
    low[1] = axis[1].low;
    high[1] = axis[1].high;
}

static void offset(const double p[3], const double s[3], double out[3])
{
    for (int c = 0; c < 3; c++)
        out[c] = p[c] - s[c];
}

/* The Gauss-Newton step, along the sides of the box where it would leave it. */
static void step_to(double d[3][3], const double e[3], const double uv[2], const double low[2],
    const double high[2], double step[2])
{
    const double a = crease_vector_dot(d[1], d[1]), b = crease_vector_dot(d[1], d[2]);
    const double c = crease_vector_dot(d[2], d[2]), f = crease_vector_dot(d[1], e);
    const double g = crease_vector_dot(d[2], e), det = a * c - b * b;
    const bool held[2] = {(uv[0] <= low[0] && f < 0.0) || (uv[0] >= high[0] && f > 0.0),
        (uv[1] <= low[1] && g < 0.0) || (uv[1] >= high[1] && g > 0.0)};
    if (held[0] || held[1] || !(det > 1e-12 * a * c)) {
        step[0] = !held[0] && a > 0.0 ? f / a : 0.0;
        step[1] = !held[1] && c > 0.0 ? g / c : 0.0;
        if (!held[0] && !held[1])
            step[1] = 0.0;
        return;
    }
    step[0] = (c * f - b * g) / det;
    step[1] = (a * g - b * f) / det;
}

/* Moves uv to the nearest place of the strip; returns the squared distance. */
static double approach(
    const crease_form *form, size_t strip, const double point[3], double uv[2], double d[3][3])
{
    double low[2], high[2], e[3];
    box_of(form, strip, low, high);
    for (int k = 0; k < 2; k++)
        uv[k] = fmin(fmax(uv[k], low[k]), high[k]);
    crease_form_at(form, strip, uv, d);
    offset(point, d[0], e);
    double best = crease_vector_dot(e, e);
    for (int i = 0; i < STEPS; i++) {
        double step[2], share = 1.0, least = 0.0;
        bool nearer = false;
        step_to(d, e, uv, low, high, step);
        for (int h = 0; h < HALVINGS && !nearer; h++, share *= 0.5) {
            double next[2], trial[3][3];
            for (int k = 0; k < 2; k++)
                next[k] = fmin(fmax(uv[k] + share * step[k], low[k]), high[k]);
            crease_form_at(form, strip, next, trial);
            offset(point, trial[0], e);
            const double square = crease_vector_dot(e, e);
            nearer = square < best;
            if (nearer) {
                least = best - square;
                best = square;
                memcpy(uv, next, sizeof next);
                memcpy(d, trial, sizeof trial);
            }
        }
        if (!nearer || least < 1e-14 * best)
            break;
    }
    return best;
}

static double distance_to_line(const crease_layout_axis *axis, size_t strip, double u)
{
    const double before = strip > 0 ? u - axis->lines[strip - 1] : INFINITY;
    return fmin(before, strip < axis->line_count ? axis->lines[strip] - u : INFINITY);
}

static void describe(const crease_form *form, double d[3][3], crease_feet *feet, size_t i)
{
    const size_t strip = feet->strip[i];
    feet->clear[i] = crease_vector_length(d[1]) *
        distance_to_line(&form->layout.axis[0], strip, feet->uv[2 * i]);
    double e[3], *const n = feet->normal + 3 * i;
    memcpy(feet->foot + 3 * i, d[0], 3 * sizeof(double));
    crease_vector_cross(d[1], d[2], n);
    crease_vector_normalise(n);
    offset(feet->points + 3 * i, d[0], e);
    feet->residual[i] = crease_vector_dot(n, e);
}

typedef struct work {
    const crease_form *form;
    crease_feet *feet;
    double near;
    bool move;
} work;

/* The strip on the other side of a line within reach, or the same one. */
static size_t other_strip(const crease_form *form, size_t strip, double u, double near)
{
    const crease_layout_axis *const axis = &form->layout.axis[0];
    if (strip < axis->line_count && axis->lines[strip] - u < near)
        return strip + 1;
    if (strip > 0 && u - axis->lines[strip - 1] < near)
        return strip - 1;
    return strip;
}

static void move_foot(const work *w, size_t i)
{
    crease_feet *const feet = w->feet;
    double d[3][3], e[3][3], uv[2];
    const double *const p = feet->points + 3 * i;
    const double here = approach(w->form, feet->strip[i], p, feet->uv + 2 * i, d);
    const size_t other = other_strip(w->form, feet->strip[i], feet->uv[2 * i], w->near);
    if (other != feet->strip[i]) {
        memcpy(uv, feet->uv + 2 * i, sizeof uv);
        if (approach(w->form, other, p, uv, e) < here) {
            feet->strip[i] = (uint8_t)other;
            memcpy(feet->uv + 2 * i, uv, sizeof uv);
            memcpy(d, e, sizeof e);
        }
    }
    describe(w->form, d, feet, i);
}

static void work_on(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const work *const w = user;
    for (size_t i = begin; i < end; i++) {
        if (w->move && w->feet->prior[i] > 0.0) {
            move_foot(w, i);
        } else {
            double d[3][3];
            crease_form_at(w->form, w->feet->strip[i], w->feet->uv + 2 * i, d);
            describe(w->form, d, w->feet, i);
        }
    }
}

crease_status crease_feet_move(
    crease_context *context, const crease_form *form, double near, crease_feet *feet)
{
    work w = {form, feet, near, true};
    return crease_parallel_for(context, feet->count, GRAIN, work_on, &w);
}

crease_status crease_feet_measure(
    crease_context *context, const crease_form *form, crease_feet *feet)
{
    work w = {form, feet, 0.0, false};
    return crease_parallel_for(context, feet->count, GRAIN, work_on, &w);
}
