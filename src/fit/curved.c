/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "fit/curved.h"

#include "base/memory.h"
#include "base/select.h"
#include "fit/chart.h"
#include "fit/form_fit.h"
#include "fit/isolate.h"
#include "fit/unroll.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    MOST_EXPLORED = 20000,
    MOST_GROWN = 200000, /* points that a finer net is tried with */
    LEAST_POINTS = 200,
    FIRST_SPANS = 4,
    MOST_CONTROLS = 4096,
    ROUNDS = 3,
    LAST_ROUNDS = 12
};

static const double SMOOTHING = 1e-9;
static const double MARGIN = 4.0;      /* of the score */
static const double CONTROLS = 0.25;   /* for each point, at most */
static const double NEGLIGIBLE = 1e-9; /* spacings */
static const double EXCESS = 1.25; /* of the residual over the noise, for a sheet that carries */
static const double NEAR = 3.0;    /* spacings from a line: either side is tried */
static const double REACH = 4.0;   /* spacings from the points explored */
static const double CAUCHY = 2.385;
static const double CLEAR = 2.0; /* standard deviations of the noise from a line */

typedef struct work {
    const crease_sheet_options *options;
    size_t count, step;
    double *points; /* of the points explored */
    crease_cloud *cloud;
    crease_regions *regions;
    crease_network *network;
    crease_spread spread;
    crease_courses courses;
    crease_feet feet;
    crease_form form;
    double *scratch;
    double mean, score, used;
    size_t freedom;
} work;

/* --------------------------------------------------------------------------------- scoring -- */

static double robust_scale(work *w, const crease_feet *feet)
{
    size_t n = 0;
    for (size_t i = 0; i < feet->count; i++)
        if (feet->prior[i] > 0.0)
            w->scratch[n++] = fabs(feet->residual[i]);
    return n ? 1.4826 * crease_select(w->scratch, n, n / 2) : 0.0;
}

/* Far points count little. Those so near to a line that noise may have brought them from its other
 * side count nothing: whichever side they are taken for, the mean of their distances is wrong. */
static void reweigh(work *w, crease_feet *feet, bool aside)
{
    const double scale = fmax(robust_scale(w, feet), 1e-8 * w->spread.spacing);
    const double clear = aside ? CLEAR * scale : 0.0;
    for (size_t i = 0; i < feet->count; i++) {
        const double ratio = feet->residual[i] / (CAUCHY * scale);
        feet->weight[i] = feet->clear[i] < clear ? 0.0 : feet->prior[i] / (1.0 + ratio * ratio);
    }
}

static void evaluate(work *w, const crease_feet *feet)
{
    const double spacing = w->spread.spacing;
    const double cap = fmax(10.0 * robust_scale(w, feet), 2.0 * spacing);
    double sum = 0.0, n = 0.0;
    for (size_t i = 0; i < feet->count; i++) {
        sum += feet->prior[i] * fmin(fabs(feet->residual[i]), cap);
        n += feet->prior[i];
    }
    const double freedom = (double)w->freedom;
    const double price = log(n) * n / fmax(0.1 * n, n - 2.0 * freedom);
    w->used = n;
    w->mean = sum / n;
    w->score = 2.0 * n * log(w->mean + NEGLIGIBLE * spacing) + freedom * price;
}

/* --------------------------------------------------------------------------------- fitting -- */

/* Feet and form in turn. */
static crease_status settle(
    crease_context *context, work *w, crease_feet *feet, int rounds, double near)
{
    crease_status status = CREASE_OK;
    double before = INFINITY;
    for (int i = 0; i < rounds && status == CREASE_OK; i++) {
        bool solved;
        status = crease_feet_move(context, &w->form, near * w->spread.spacing, feet);
        if (status != CREASE_OK)
            break;
        reweigh(w, feet, near > 0.0);
        evaluate(w, feet);
        if (i > 2 && !(w->mean < 0.999 * before))
            break;
        before = w->mean;
        status = crease_form_fit(
            context, &w->form, feet, CREASE_PULL_PLANES, SMOOTHING, &w->freedom, &solved);
        if (!solved)
            break;
    }
    if (status == CREASE_OK)
        status = crease_feet_move(context, &w->form, near * w->spread.spacing, feet);
    if (status == CREASE_OK)
        evaluate(w, feet);
    return status;
}

/* A form over this layout, through the points at their parameters; its score is left in w, form. */
static crease_status try_layout(
    crease_context *context, work *w, const crease_layout *layout, double margin, bool *taken)
{
    const double score = w->score, mean = w->mean;
    const size_t freedom = w->freedom;
    crease_form form = w->form;
    bool solved = false;
    crease_status status = crease_form_create(context, layout, &w->form);
    if (status == CREASE_OK)
        status = crease_form_fit(
            context, &w->form, &w->feet, CREASE_PULL_POINTS, SMOOTHING, &w->freedom, &solved);
    if (status == CREASE_OK && solved) {
        status = crease_feet_measure(context, &w->form, &w->feet);
        evaluate(w, &w->feet);
    }
    *taken = status == CREASE_OK && solved && w->score < score - margin;
    if (*taken) {
        crease_form_free(&form);
    } else {
        crease_form_free(&w->form);
        w->form = form;
        w->score = score;
        w->mean = mean;
        w->freedom = freedom;
    }
    return status;
}

static bool finer(const work *w, int mask, size_t factor, crease_layout *out)
{
    *out = w->form.layout;
    for (int d = 0; d < 2; d++)
        if (mask & 1 << d)
            out->axis[d].smooth = factor * (out->axis[d].smooth + 1) - 1;
    const double controls = (double)(crease_layout_count(out, 0) * crease_layout_count(out, 1));
    return controls <= MOST_CONTROLS && controls <= CONTROLS * w->used;
}

static crease_status grow(crease_context *context, work *w)
{
    static const struct {
        int mask;
        size_t factor;
    } tries[] = {{1, 2}, {2, 2}, {3, 2}, {1, 4}, {2, 4}};
    const double tolerance = w->options->tolerance;
    crease_status status = CREASE_OK;
    bool grown = true;
    while (grown && status == CREASE_OK && !(tolerance > 0.0 && w->mean < 0.8 * tolerance)) {
        grown = false;
        for (size_t i = 0; i < sizeof tries / sizeof tries[0] && !grown && status == CREASE_OK;
             i++) {
            crease_layout layout;
            if (finer(w, tries[i].mask, tries[i].factor, &layout))
                status =
                    try_layout(context, w, &layout, tolerance > 0.0 ? -INFINITY : MARGIN, &grown);
        }
        if (grown && status == CREASE_OK)
            status = settle(context, w, &w->feet, ROUNDS, NEAR);
        else if (status == CREASE_OK)
            status = crease_feet_measure(context, &w->form, &w->feet);
    }
    return status;
}

/* Half as many spans along each direction, as long as that does about as well. */
static crease_status thin_out(crease_context *context, work *w)
{
    crease_status status = CREASE_OK;
    for (int d = 0; d < 2; d++) {
        bool taken = true;
        while (taken && w->form.layout.axis[d].smooth > 0 && status == CREASE_OK) {
            crease_layout layout = w->form.layout;
            layout.axis[d].smooth = (layout.axis[d].smooth - 1) / 2;
            status = try_layout(context, w, &layout, -MARGIN, &taken);
            if (taken && status == CREASE_OK)
                status = settle(context, w, &w->feet, ROUNDS, NEAR);
        }
    }
    return status == CREASE_OK ? crease_feet_measure(context, &w->form, &w->feet) : status;
}

/* The first form, through the points at the parameters that the plane gives them. */
static crease_status begin(crease_context *context, work *w)
{
    crease_layout layout = {.order = w->options->order};
    bool solved = false;
    crease_chart_points(&w->spread, &w->courses, w->feet.uv, &layout);
    layout.axis[0].smooth = FIRST_SPANS * (w->courses.count + 1) - 1;
    layout.axis[1].smooth = FIRST_SPANS - 1;
    for (size_t i = 0; i < w->count; i++)
        w->feet.weight[i] = w->feet.prior[i];
    crease_status status = crease_form_create(context, &layout, &w->form);
    if (status == CREASE_OK)
        status = crease_form_fit(
            context, &w->form, &w->feet, CREASE_PULL_POINTS, 1e-6, &w->freedom, &solved);
    if (status == CREASE_OK)
        status = settle(context, w, &w->feet, 2 * ROUNDS, 0.0);
    if (status == CREASE_OK)
        status = settle(context, w, &w->feet, ROUNDS, NEAR);
    return status;
}

/* From here on with all points, not only those explored. */
static crease_status take_all(crease_context *context, work *w, const crease_cloud *cloud)
{
    if (w->step == 1)
        return CREASE_OK;
    crease_feet all;
    const size_t count = crease_cloud_count(cloud);
    crease_status status = crease_feet_create(context, crease_cloud_points(cloud), count, &all);
    if (status == CREASE_OK)
        status = crease_feet_borrow(context, &w->feet, REACH * w->spread.spacing, &all);
    if (status == CREASE_OK) {
        crease_feet_free(&w->feet);
        w->feet = all;
        free(w->scratch);
        w->scratch = crease_allocate(context, count, sizeof *w->scratch);
        if (!w->scratch)
            status = CREASE_ERROR_NO_MEMORY;
    } else {
        crease_feet_free(&all);
    }
    if (status == CREASE_OK)
        status = settle(context, w, &w->feet, ROUNDS, NEAR);
    if (status == CREASE_OK && count <= MOST_GROWN)
        status = grow(context, w);
    return status;
}

static bool carries(work *w)
{
    const double noise = crease_regions_sigma(w->regions);
    return robust_scale(w, &w->feet) <= EXCESS * noise;
}

/* ---------------------------------------------------------------------------------- running -- */

static crease_status survey(crease_context *context, work *w, const crease_cloud *cloud)
{
    const size_t all = crease_cloud_count(cloud);
    w->step = (all + MOST_EXPLORED - 1) / MOST_EXPLORED;
    w->count = (all + w->step - 1) / w->step;
    w->points = crease_allocate(context, w->count, 3 * sizeof *w->points);
    if (!w->points)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < w->count; i++)
        memcpy(w->points + 3 * i, crease_cloud_points(cloud) + 3 * i * w->step, 3 * sizeof(double));
    const crease_cloud_parts parts = {
        .count = w->count, .points = w->points, .coordinate_type = CREASE_TYPE_FLOAT64};
    crease_status status = crease_cloud_create(context, &parts, &w->cloud);
    if (status == CREASE_OK)
        status = crease_regions_find(context, w->cloud, NULL, &w->regions);
    if (status == CREASE_OK)
        status = crease_network_find(context, w->regions, NULL, &w->network);
    return status;
}

static crease_status lay_out(crease_context *context, work *w)
{
    crease_spread *const s = &w->spread;
    double spacing;
    crease_status status = crease_feet_create(context, w->points, w->count, &w->feet);
    s->plane = crease_allocate(context, w->count, 2 * sizeof *s->plane);
    w->scratch = crease_allocate(context, w->count, sizeof *w->scratch);
    if (status != CREASE_OK || !s->plane || !w->scratch)
        return CREASE_ERROR_NO_MEMORY;
    s->count = w->count;
    s->points = w->points;
    s->labels = crease_regions_labels(w->regions);
    s->keep = w->feet.prior;
    s->strip = w->feet.strip;
    s->spacing = crease_network_spacing(w->network);
    s->sigma = crease_regions_sigma(w->regions);
    status = crease_isolate(context, w->points, w->count, w->feet.prior, &spacing);
    if (status != CREASE_OK)
        return status;
    for (size_t i = 0; i < w->count; i++)
        w->feet.prior[i] *= s->labels[i] >= 0;
    status = crease_unroll(context, w->points, w->count, w->feet.prior, s->plane);
    if (status == CREASE_OK)
        status = crease_courses_find(context, s, w->network, &w->courses);
    return status;
}

static crease_status describe(crease_context *context, const work *w, crease_sheet *sheet)
{
    const crease_height *const basis = &w->form.basis;
    const crease_layout_axis *const axis = &w->form.layout.axis[0];
    const crease_surface_parts parts = {.order = {basis->order, basis->order},
        .count = {basis->count[0], basis->count[1]},
        .knots = {basis->knots[0], basis->knots[1]},
        .control_points = w->form.net};
    crease_status status = crease_surface_create(context, &parts, &sheet->surface);
    sheet->frame = (crease_frame){.rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    sheet->lines = crease_allocate(context, axis->line_count, sizeof *sheet->lines);
    if (status == CREASE_OK && !sheet->lines)
        status = CREASE_ERROR_NO_MEMORY;
    for (size_t l = 0; l < axis->line_count && status == CREASE_OK; l++)
        sheet->lines[sheet->line_count++] = (crease_line){.direction = 0,
            .parameter = axis->lines[l],
            .angle = crease_sheet_dihedral(sheet->surface, 0, axis->lines[l])};
    return status;
}

static crease_status run(
    crease_context *context, work *w, const crease_cloud *cloud, crease_sheet **out)
{
    crease_status status = lay_out(context, w);
    if (status != CREASE_OK || w->courses.count == 0)
        return status == CREASE_ERROR_DEGENERATE ? CREASE_OK : status;
    status = begin(context, w);
    if (status == CREASE_OK)
        status = grow(context, w);
    if (status == CREASE_OK && !(w->options->tolerance > 0.0))
        status = thin_out(context, w);
    if (status == CREASE_OK)
        status = take_all(context, w, cloud);
    if (status == CREASE_OK)
        status =
            settle(context, w, &w->feet, w->feet.count <= MOST_GROWN ? LAST_ROUNDS : ROUNDS, NEAR);
    if (status != CREASE_OK || !carries(w))
        return status;
    crease_sheet *sheet = crease_allocate(context, 1, sizeof *sheet);
    if (!sheet)
        return CREASE_ERROR_NO_MEMORY;
    status = describe(context, w, sheet);
    if (status == CREASE_OK)
        *out = sheet;
    else
        crease_sheet_free(sheet);
    return status;
}

crease_status crease_curved_fit(crease_context *context, const crease_cloud *cloud,
    const crease_sheet_options *options, crease_straightness *found, crease_sheet **out)
{
    work w = {.options = options};
    *out = NULL;
    *found = (crease_straightness){.straight = true};
    if (crease_cloud_count(cloud) < LEAST_POINTS)
        return CREASE_OK;
    crease_status status = survey(context, &w, cloud);
    if (status != CREASE_OK && status != CREASE_ERROR_NO_MEMORY && status != CREASE_ERROR_CANCELLED)
        status = CREASE_OK; /* no creases that could be told: a height field must do */
    else if (status == CREASE_OK && crease_network_count(w.network) > 0)
        status = crease_straight(context, w.cloud, w.network, found);
    if (status == CREASE_OK && !found->straight)
        status = run(context, &w, cloud, out);
    crease_form_free(&w.form);
    crease_feet_free(&w.feet);
    crease_courses_clear(&w.courses);
    crease_network_free(w.network);
    crease_regions_free(w.regions);
    crease_cloud_free(w.cloud);
    free(w.spread.plane);
    free(w.scratch);
    free(w.points);
    return status;
}
