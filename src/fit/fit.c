/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A creased sheet from a cloud: the points become a height field in a frame whose y axis follows
 * the edge; lines where it bends or jumps are looked for and become knots of full multiplicity; the
 * number of further knots, the bending weight and the lines that stay are those with the best
 * score; then the lines are moved, and the frame is turned, to where the points fit best.
 *
 * Choices are made on at most MOST_EXPLORED points, the final fit uses all. */
#include "averaging/orient.h"
#include "base/memory.h"
#include "base/vector.h"
#include "fit/closest.h"
#include "fit/covariance.h"
#include "fit/curved.h"
#include "fit/explore.h"
#include "fit/isolate.h"
#include "fit/lines.h"
#include "spline/sheet.h"

#include <cblas.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Mean distances of two fits of which one serves the other: in shares. */
static const double ALIKE = 0.98;
static const double EXACT = 1e-9; /* mean distance, in spacings */

enum {
    MOST_EXPLORED = 10000,
    MOST_REFINED = 50000,
    MOST_ROWS = 2048,
    LEAST_POINTS = 6,
    MOST_FOR_GAPS = 7
};

typedef struct work {
    const crease_sheet_options *options;
    crease_bounds bounds;
    bool large; /* the net asked for is too large to choose with; it is fitted at the end */
    size_t count;
    const double *points;
    double epsilon;
    double *keep;
    double spacing;
    crease_oriented oriented;
    crease_draft draft;
    double errors[2 * CREASE_MOST_LINES];
    crease_sheet *sheet;
} work;

crease_sheet_options crease_sheet_options_default(void)
{
    return (crease_sheet_options){.orientation = CREASE_ORIENTATION_AUTOMATIC,
        .rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1},
        .order = 4,
        .creases = -1,
        .smoothing = -1.0};
}

static crease_status check_options(crease_context *context, const crease_sheet_options *o)
{
    if (o->order < 2 || o->order > CREASE_HEIGHT_ORDER_MAX)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "sheet: the order is %d; give 2 to %d (4 is bicubic)", o->order,
            CREASE_HEIGHT_ORDER_MAX);
    for (int d = 0; d < 2; d++)
        if (o->net[d] && (o->net[d] < (size_t)o->order || o->net[d] > MOST_ROWS))
            return crease_fail(context, CREASE_ERROR_ARGUMENT,
                "sheet: a net of %zu x %zu control points; give %d to %d each, or 0 for as many as "
                "the data ask for",
                o->net[0], o->net[1], o->order, MOST_ROWS);
    if (o->creases < -1 || o->creases > CREASE_MOST_LINES)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "sheet: %d creases in each direction; give 0 to %d, or -1 for as many as are "
            "significant",
            o->creases, CREASE_MOST_LINES);
    if (!isfinite(o->smoothing) || !(o->tolerance >= 0.0) || !isfinite(o->tolerance))
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "sheet: smoothing %g, tolerance %g; give finite numbers, and no negative tolerance",
            o->smoothing, o->tolerance);
    return CREASE_OK;
}

/* The edge that the orientation found becomes the first candidate, when it follows an axis. */
static size_t first_candidate(const work *w, crease_candidate *out)
{
    const crease_frame *const frame = &w->oriented.frame;
    const int axis = crease_orient_edge_axis(&w->oriented);
    const double *const m = frame->rotation, *const edge = w->oriented.direction;
    const double along = crease_vector_dot(m + 3 * axis, edge);
    const double across = crease_vector_dot(m + 3 * (1 - axis), edge);
    if (!w->oriented.edge || fabs(across) > 0.1 * fabs(along))
        return 0;
    double local[3];
    crease_frame_enter(frame, w->oriented.point, 1, local);
    *out = (crease_candidate){
        .direction = 1 - axis, .count = 1, .at = {local[1 - axis], 0.0}, .gain = INFINITY};
    return 1;
}

static crease_status draft_samples(
    crease_context *context, work *w, size_t step, crease_samples *samples)
{
    const crease_status status = crease_samples_create(
        context, w->points, w->keep, w->count, step, w->spacing, w->epsilon, samples);
    if (status != CREASE_OK)
        return status;
    w->draft.samples = samples;
    crease_draft_place(&w->draft);
    for (int d = 0; d < 2; d++)
        if (!(w->draft.layout.axis[d].high - w->draft.layout.axis[d].low >
                16.0 * samples->rounding))
            return crease_fail(context, CREASE_ERROR_DEGENERATE,
                "sheet: seen along z the points have no extent in %c; choose another orientation",
                "xy"[d]);
    return CREASE_OK;
}

/* In gaps a sheet of few spans goes on as it came: it needs some knots to bend at. */
static crease_status knots_for_gaps(crease_context *context, work *w)
{
    crease_gaps gaps;
    const crease_status status =
        crease_gaps_create(context, w->draft.samples, &w->draft.layout, &gaps);
    for (int d = 0; d < 2 && status == CREASE_OK; d++)
        w->bounds.least[d] =
            gaps.empty ? (gaps.count[d] < MOST_FOR_GAPS ? gaps.count[d] : MOST_FOR_GAPS) : 0;
    crease_gaps_free(&gaps);
    return status;
}

/* Choices, on some of the points. */
static crease_status choose(crease_context *context, work *w)
{
    crease_samples samples = {0};
    crease_candidate candidates[CREASE_MOST_CANDIDATES + 1];
    const bool turn = w->options->orientation == CREASE_ORIENTATION_AUTOMATIC;
    const size_t step = (w->count + MOST_EXPLORED - 1) / MOST_EXPLORED;
    crease_status status = draft_samples(context, w, step, &samples);
    if (status == CREASE_OK && turn && !w->oriented.edge) {
        double angle;
        status = crease_scan_turn(context, &samples, &angle);
        crease_frame_turn(&w->draft.frame, angle);
        crease_draft_place(&w->draft);
    }
    if (status == CREASE_OK && !crease_explore_keep_net(&w->draft.layout, &w->bounds))
        status = crease_fail(context, CREASE_ERROR_ARGUMENT, "sheet: the net is too small");
    size_t count = 0, first = 0;
    if (status == CREASE_OK)
        status = knots_for_gaps(context, w);
    if (status == CREASE_OK) {
        first = first_candidate(w, candidates);
        status = crease_scan(context, &samples, candidates + first, &count);
    }
    if (status == CREASE_OK)
        status = crease_explore(context, &w->draft, &w->bounds, candidates, first + count, turn);
    w->draft.orthogonal = true;
    if (status == CREASE_OK)
        status = crease_lines_refine(context, &w->draft, 12, turn);
    w->draft.orthogonal = false;
    if (status == CREASE_OK)
        status = crease_explore_prune(context, &w->draft, &w->bounds);
    crease_samples_free(&samples);
    return status;
}

/* A sheet that leaves the points far behind all the same is made stiffer until it does not; when
 * that does not help, its creases are at places where the points do not hold it. */
static crease_status hold_back(crease_context *context, work *w)
{
    crease_draft *const draft = &w->draft;
    crease_status status = CREASE_OK;
    bool done = draft->fixed_lambda >= 0.0;
    while (status == CREASE_OK && !done && !crease_draft_bounded(draft)) {
        if (draft->lambda + 1 < (w->large ? CREASE_LAMBDAS - 1 : CREASE_LAMBDAS)) {
            draft->lambda++;
        } else {
            draft->layout.axis[0].line_count = draft->layout.axis[1].line_count = 0;
            crease_explore_keep_net(&draft->layout, &w->bounds);
            done = true;
        }
        draft->orthogonal = draft->redescending = false;
        crease_draft_place(draft);
        status = crease_draft_fit(context, draft, 3, CREASE_CHOICE_NONE);
    }
    return status;
}

/* The large net that was asked for, with the creases of a smaller one, from whose feet and
 * distances it begins. */
static crease_status enlarge(crease_context *context, work *w)
{
    crease_draft *const draft = &w->draft;
    const crease_layout before = draft->layout;
    memcpy(w->bounds.net, w->options->net, sizeof w->bounds.net);
    for (int d = 0; d < 2; d++) {
        crease_layout_axis *const axis = &draft->layout.axis[d];
        if (w->bounds.net[d] < crease_layout_count(&draft->layout, d) - axis->smooth) {
            if (d == 0) /* the errors of the other direction's lines follow */
                memmove(w->errors, w->errors + axis->line_count,
                    draft->layout.axis[1].line_count * sizeof *w->errors);
            axis->line_count = 0;
        }
    }
    crease_explore_keep_net(&draft->layout, &w->bounds);
    draft->lambda = CREASE_LAMBDAS / 2;
    draft->stiffness = crease_draft_stiffness(draft);
    const double mean = draft->mean;
    crease_status status = crease_draft_begin(context, draft, &draft->height, &before);
    /* where the small net is exact no weight is better than another */
    const bool exact = mean <= EXACT * draft->samples->spacing;
    if (status == CREASE_OK)
        status =
            crease_draft_fit(context, draft, 1, exact ? CREASE_CHOICE_NONE : CREASE_CHOICE_NEAR);
    if (status == CREASE_OK && !exact &&
        !(draft->mean > ALIKE * mean)) /* feet and weights are others now */
        status = crease_draft_fit_again(context, draft);
    return status == CREASE_OK ? hold_back(context, w) : status;
}

/* The fit of every step-th point, with the lines where these say. */
static crease_status settle(
    crease_context *context, work *w, size_t step, int steps, crease_samples *samples)
{
    const bool turn = w->options->orientation == CREASE_ORIENTATION_AUTOMATIC;
    crease_status status = draft_samples(context, w, step, samples);
    if (status == CREASE_OK)
        status = crease_draft_fit(context, &w->draft, 3, CREASE_CHOICE_NEAR);
    w->draft.redescending = w->draft.orthogonal = true;
    if (status == CREASE_OK)
        status = crease_draft_fit(context, &w->draft, 4, CREASE_CHOICE_NONE);
    if (status == CREASE_OK)
        status = crease_lines_refine(context, &w->draft, steps, turn);
    return status == CREASE_OK ? hold_back(context, w) : status;
}

/* From the fit of some of the points to that of all: one round, one step of the lines, and another
 * round when that was worth it. */
static crease_status take_all(crease_context *context, work *w, crease_samples *samples)
{
    crease_draft *const draft = &w->draft;
    const crease_layout before = draft->layout;
    const bool turn = w->options->orientation == CREASE_ORIENTATION_AUTOMATIC;
    crease_status status = draft_samples(context, w, 1, samples);
    draft->warm = true;
    if (status == CREASE_OK)
        status = crease_draft_begin(context, draft, &draft->height, &before);
    if (status == CREASE_OK)
        status = crease_draft_fit(context, draft, 1, CREASE_CHOICE_NONE);
    if (status == CREASE_OK)
        status = crease_lines_refine(context, draft, 1, turn);
    return status;
}

/* Standard errors: of the lines, and, unless a larger net is to come, at all points. */
static crease_status tell_errors(crease_context *context, work *w)
{
    const bool turn = w->options->orientation == CREASE_ORIENTATION_AUTOMATIC;
    crease_covariance covariance;
    crease_status status = crease_covariance_create(context, &w->draft, turn, &covariance);
    if (status == CREASE_OK)
        crease_covariance_lines(&covariance, w->errors);
    if (status == CREASE_OK && !w->large) {
        w->sheet->errors = crease_allocate(context, w->count, sizeof *w->sheet->errors);
        status = w->sheet->errors ? crease_covariance_points(context, &covariance, w->sheet->errors)
                                  : CREASE_ERROR_NO_MEMORY;
    }
    crease_covariance_free(&covariance);
    return status;
}

/* The final fit, on all points. */
static crease_status finish(crease_context *context, work *w, crease_samples *samples)
{
    crease_samples some = {0};
    const size_t step = (w->count + MOST_REFINED - 1) / MOST_REFINED;
    crease_status status = settle(context, w, step, w->count > MOST_EXPLORED && step == 1 ? 2 : 8,
        step > 1 ? &some : samples);
    if (status == CREASE_OK && step > 1)
        status = take_all(context, w, samples);
    crease_samples_free(&some);
    if (status == CREASE_OK)
        status = tell_errors(context, w);
    if (status == CREASE_OK && w->large)
        status = enlarge(context, w);
    if (status == CREASE_OK)
        status =
            crease_height_surface(context, &w->draft.height, &w->draft.frame, &w->sheet->surface);
    return status;
}

static crease_status describe_lines(crease_context *context, work *w)
{
    const crease_layout *const layout = &w->draft.layout;
    crease_sheet *const sheet = w->sheet;
    sheet->frame = w->draft.frame;
    sheet->lines = crease_allocate(
        context, layout->axis[0].line_count + layout->axis[1].line_count, sizeof *sheet->lines);
    if (!sheet->lines)
        return CREASE_ERROR_NO_MEMORY;
    for (int d = 0; d < 2; d++)
        for (size_t l = 0; l < layout->axis[d].line_count; l++) {
            const double at = layout->axis[d].lines[l];
            sheet->lines[sheet->line_count] = (crease_line){.direction = d,
                .parameter = at,
                .angle = crease_sheet_dihedral(sheet->surface, d, at),
                .standard_error = w->errors[sheet->line_count]};
            sheet->line_count++;
        }
    return CREASE_OK;
}

/* draft: that the sheet was made from, or NULL. */
static crease_status project(crease_context *context, work *w, const crease_draft *draft)
{
    crease_sheet *const sheet = w->sheet;
    crease_foot *feet = crease_allocate(context, w->count, sizeof *feet);
    sheet->parameters = crease_allocate(context, w->count, 2 * sizeof(double));
    sheet->projected = crease_allocate(context, w->count, 3 * sizeof(double));
    sheet->deviations = crease_allocate(context, w->count, sizeof(double));
    crease_status status = feet && sheet->parameters && sheet->projected && sheet->deviations
        ? CREASE_OK
        : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK)
        status = draft ? crease_closest_feet(context, &draft->height, &draft->layout, &draft->frame,
                             sheet->surface, w->points, w->count, feet)
                       : crease_surface_project(context, sheet->surface, w->points, w->count, feet);
    for (size_t i = 0; i < w->count && status == CREASE_OK; i++) {
        memcpy(sheet->parameters + 2 * i, feet[i].uv, sizeof feet[i].uv);
        memcpy(sheet->projected + 3 * i, feet[i].point, sizeof feet[i].point);
        sheet->deviations[i] = feet[i].distance;
    }
    free(feet);
    return status;
}

/* Curved creases, and folds that no height field has, unless the options ask for a height field. */
static crease_status try_curved(crease_context *context, const crease_cloud *cloud, work *w)
{
    const crease_sheet_options *const o = w->options;
    if (o->orientation != CREASE_ORIENTATION_AUTOMATIC || o->net[0] || o->net[1] ||
        o->creases == 0 || o->smoothing >= 0.0)
        return CREASE_OK;
    crease_status status = crease_curved_fit(context, cloud, o, &w->sheet);
    if (status == CREASE_OK && w->sheet) {
        w->sheet->point_count = w->count;
        status = project(context, w, NULL);
    }
    return status;
}

static crease_status run(crease_context *context, work *w)
{
    crease_samples all = {0};
    w->keep = crease_allocate(context, w->count, sizeof *w->keep);
    w->sheet = crease_allocate(context, 1, sizeof *w->sheet);
    crease_status status = w->keep && w->sheet ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK)
        status = crease_orient(context, w->points, w->count, w->options->orientation,
            w->options->rotation, &w->oriented);
    if (status == CREASE_OK)
        status = crease_isolate(context, w->points, w->count, w->keep, &w->spacing);
    if (status == CREASE_OK) {
        w->sheet->point_count = w->count;
        w->draft.frame = w->oriented.frame;
        status = choose(context, w);
    }
    if (status == CREASE_OK)
        status = finish(context, w, &all);
    if (status == CREASE_OK)
        status = describe_lines(context, w);
    if (status == CREASE_OK)
        status = project(context, w, &w->draft);
    crease_samples_free(&all);
    return status;
}

/* A line of full multiplicity needs one more span on either side of it. */
static void warn_of_small_net(crease_context *context, const crease_sheet_options *o)
{
    const size_t least = 2 * (size_t)o->order - 1;
    if (o->net[0] && o->creases && o->net[0] < least && o->net[1] < least)
        crease_warn(context,
            "a net of %zu x %zu control points has no room for a crease; give at least %zu in one "
            "direction",
            o->net[0], o->net[1], least);
}

crease_status crease_sheet_fit(crease_context *context, const crease_cloud *cloud,
    const crease_sheet_options *options, crease_sheet **out)
{
    *out = NULL;
    const crease_sheet_options chosen = options ? *options : crease_sheet_options_default();
    crease_status status = check_options(context, &chosen);
    if (status != CREASE_OK)
        return status;
    work w = {.options = &chosen,
        .large = chosen.net[0] * chosen.net[1] > CREASE_EXPLORED_UNKNOWNS,
        .bounds = {.creases = chosen.creases < 0 ? CREASE_MOST_LINES : (size_t)chosen.creases,
            .tolerance = chosen.tolerance},
        .count = crease_cloud_count(cloud),
        .points = crease_cloud_points(cloud),
        .epsilon =
            crease_cloud_coordinate_type(cloud) == CREASE_TYPE_FLOAT32 ? FLT_EPSILON : DBL_EPSILON,
        .draft = {.layout = {.order = chosen.order},
            .lambda = CREASE_LAMBDAS / 2,
            .fixed_lambda = chosen.smoothing}};
    if (!w.large)
        memcpy(w.bounds.net, chosen.net, sizeof w.bounds.net);
    if (w.count < LEAST_POINTS)
        return crease_fail(context, CREASE_ERROR_TOO_FEW_POINTS,
            "sheet: %zu points; a sheet needs at least %d, give more", w.count, LEAST_POINTS);
    warn_of_small_net(context, &chosen);
    const int blas_threads = openblas_get_num_threads();
    openblas_set_num_threads(1);
    status = try_curved(context, cloud, &w);
    if (status == CREASE_OK && !w.sheet)
        status = run(context, &w);
    openblas_set_num_threads(blas_threads);
    if (status == CREASE_OK) {
        *out = w.sheet;
        w.sheet = NULL;
    }
    crease_draft_free(&w.draft);
    crease_sheet_free(w.sheet);
    free(w.keep);
    return status;
}
