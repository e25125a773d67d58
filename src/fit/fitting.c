/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "fit/fitting.h"

#include "base/memory.h"
#include "base/vector.h"
#include "fit/covariance.h"
#include "fit/exact.h"
#include "fit/isolate.h"
#include "fit/lines.h"
#include "fit/prune.h"
#include "spline/sheet.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Mean distances of two fits of which one serves the other: in shares. */
static const double ALIKE = 0.98;
static const double ALONG = 0.01; /* sine of the angle of a line to a crease that it may follow */
static const double STEEP = 0.7;  /* cosine of the angle of a crease to z that no line follows */
static const double EXACT = 1e-9; /* mean distance, in spacings */

enum {
    MOST_EXPLORED = 10000,
    MOST_REFINED = 50000,
    MOST_ROWS = 2048,
    LEAST_POINTS = 6,
    MOST_FOR_GAPS = 7
};

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

crease_status crease_fitting_check(
    crease_context *context, const crease_sheet_options *o, size_t count)
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
    if (count < LEAST_POINTS)
        return crease_fail(context, CREASE_ERROR_TOO_FEW_POINTS,
            "sheet: %zu points; a sheet needs at least %d, give more", count, LEAST_POINTS);
    warn_of_small_net(context, o);
    return CREASE_OK;
}

/* The edge that the orientation found becomes the first candidate, when it follows an axis. */
static size_t first_candidate(const crease_fitting *f, crease_candidate *out)
{
    const crease_frame *const frame = &f->oriented.frame;
    const int axis = crease_orient_edge_axis(&f->oriented);
    const double *const m = frame->rotation, *const edge = f->oriented.direction;
    const double along = crease_vector_dot(m + 3 * axis, edge);
    const double across = crease_vector_dot(m + 3 * (1 - axis), edge);
    if (!f->oriented.edge || fabs(across) > 0.1 * fabs(along))
        return 0;
    double local[3];
    crease_frame_enter(frame, f->oriented.point, 1, local);
    *out = (crease_candidate){
        .direction = 1 - axis, .count = 1, .at = {local[1 - axis], 0.0}, .gain = INFINITY};
    return 1;
}

crease_status crease_fitting_create(crease_context *context, const crease_cloud *cloud,
    const crease_sheet_options *options, crease_fitting *out)
{
    const crease_sheet_options *const o = options;
    *out = (crease_fitting){.options = o,
        .large = o->net[0] * o->net[1] > CREASE_EXPLORED_UNKNOWNS,
        .bounds = {.creases = o->creases < 0 ? CREASE_MOST_LINES : (size_t)o->creases,
            .tolerance = o->tolerance},
        .count = crease_cloud_count(cloud),
        .points = crease_cloud_points(cloud),
        .epsilon =
            crease_cloud_coordinate_type(cloud) == CREASE_TYPE_FLOAT32 ? FLT_EPSILON : DBL_EPSILON,
        .draft = {.layout = {.order = o->order},
            .lambda = CREASE_LAMBDAS / 2,
            .fixed_lambda = o->smoothing}};
    if (!out->large)
        memcpy(out->bounds.net, o->net, sizeof out->bounds.net);
    out->keep = crease_allocate(context, out->count, sizeof *out->keep);
    crease_status status = out->keep ? crease_orient(context, out->points, out->count,
                                           o->orientation, o->rotation, &out->oriented)
                                     : CREASE_ERROR_NO_MEMORY;
    out->draft.frame = out->oriented.frame;
    return status == CREASE_OK
        ? crease_isolate(context, out->points, out->count, out->keep, &out->spacing)
        : status;
}

void crease_fitting_free(crease_fitting *fitting)
{
    crease_draft_free(&fitting->draft);
    free(fitting->keep);
    fitting->keep = NULL;
}

void crease_fitting_follow(crease_fitting *f, const double point[3], const double direction[3])
{
    double m[9];
    memcpy(m, f->draft.frame.rotation, sizeof m);
    const double x = crease_vector_dot(m, direction), y = crease_vector_dot(m + 3, direction);
    const double z = crease_vector_dot(m + 6, direction);
    if ((f->oriented.edge && fmin(fabs(x), fabs(y)) < ALONG * hypot(x, y)) || !(fabs(z) < STEEP))
        return;
    for (int c = 0; c < 3; c++) { /* z at right angles to the crease, y along it */
        m[6 + c] -= z * direction[c];
        m[3 + c] = direction[c];
    }
    crease_vector_normalise(m + 6);
    crease_vector_cross(m + 3, m + 6, m);
    memcpy(f->draft.frame.rotation, m, sizeof m);
    memcpy(f->oriented.frame.rotation, m, sizeof m);
    memcpy(f->oriented.point, point, sizeof f->oriented.point);
    memcpy(f->oriented.direction, direction, sizeof f->oriented.direction);
    f->oriented.edge = true;
}

static crease_status draft_samples(
    crease_context *context, crease_fitting *f, size_t step, crease_samples *samples)
{
    const crease_status status = crease_samples_create(
        context, f->points, f->keep, f->count, step, f->spacing, f->epsilon, samples);
    if (status != CREASE_OK)
        return status;
    f->draft.samples = samples;
    crease_draft_place(&f->draft);
    for (int d = 0; d < 2; d++)
        if (!(f->draft.layout.axis[d].high - f->draft.layout.axis[d].low >
                16.0 * samples->rounding))
            return crease_fail(context, CREASE_ERROR_DEGENERATE,
                "sheet: seen along z the points have no extent in %c; choose another orientation",
                "xy"[d]);
    return CREASE_OK;
}

/* In gaps a sheet of few spans goes on as it came: it needs some knots to bend at. */
static crease_status knots_for_gaps(crease_context *context, crease_fitting *f)
{
    crease_gaps gaps;
    const crease_status status =
        crease_gaps_create(context, f->draft.samples, &f->draft.layout, &gaps);
    for (int d = 0; d < 2 && status == CREASE_OK; d++)
        f->bounds.least[d] =
            gaps.empty ? (gaps.count[d] < MOST_FOR_GAPS ? gaps.count[d] : MOST_FOR_GAPS) : 0;
    crease_gaps_free(&gaps);
    return status;
}

/* Whether all points lie on the sheet that some of them lie on. */
static crease_status confirm(crease_context *context, crease_fitting *f, size_t step)
{
    crease_samples samples = {0};
    f->draft.lambda = 0;
    crease_explore_keep_net(&f->draft.layout, &f->bounds);
    crease_status status = draft_samples(context, f, step, &samples);
    f->draft.begun = true; /* with distances of zero: nothing holds the gaps against the points */
    if (status == CREASE_OK)
        status = crease_draft_fit(context, &f->draft, 1, CREASE_CHOICE_NONE);
    f->exact = status == CREASE_OK && f->draft.mean <= EXACT * samples.spacing + samples.rounding;
    if (f->exact && !crease_draft_bounded(&f->draft))
        status = knots_for_gaps(context, f);
    if (f->exact && status == CREASE_OK)
        for (int d = 0; d < 2; d++)
            if (f->bounds.net[d] == 0)
                f->draft.layout.axis[d].smooth = f->bounds.least[d];
    crease_samples_free(&samples);
    return status == CREASE_ERROR_NUMERIC ? CREASE_OK : status;
}

crease_status crease_fitting_find_exact(crease_context *context, crease_fitting *f)
{
    const crease_sheet_options *const o = f->options;
    crease_samples samples = {0};
    if (o->orientation != CREASE_ORIENTATION_AUTOMATIC || o->smoothing >= 0.0 || o->order < 3)
        return CREASE_OK;
    const size_t step = (f->count + MOST_EXPLORED - 1) / MOST_EXPLORED;
    const crease_draft before = f->draft;
    crease_layout layout = f->draft.layout;
    bool found = false;
    crease_status status = crease_samples_create(
        context, f->points, f->keep, f->count, step, f->spacing, f->epsilon, &samples);
    if (status == CREASE_OK)
        status = crease_exact_find(
            context, &samples, &f->oriented, f->bounds.creases, &f->draft.frame, &layout, &found);
    crease_samples_free(&samples);
    if (status != CREASE_OK || !found)
        return status;
    f->draft.layout = layout;
    status = confirm(context, f, step);
    if (status == CREASE_OK && !f->exact) {
        crease_draft_free(&f->draft);
        f->draft = before;
    }
    return status;
}

crease_status crease_fitting_choose(crease_context *context, crease_fitting *f)
{
    if (f->exact)
        return CREASE_OK;
    crease_samples samples = {0};
    crease_candidate candidates[CREASE_MOST_CANDIDATES + 1];
    const bool turn = f->options->orientation == CREASE_ORIENTATION_AUTOMATIC;
    const size_t step = (f->count + MOST_EXPLORED - 1) / MOST_EXPLORED;
    crease_status status = draft_samples(context, f, step, &samples);
    if (status == CREASE_OK && turn && !f->oriented.edge) {
        double angle;
        status = crease_scan_turn(context, &samples, &angle);
        crease_frame_turn(&f->draft.frame, angle);
        crease_draft_place(&f->draft);
    }
    if (status == CREASE_OK && !crease_explore_keep_net(&f->draft.layout, &f->bounds))
        status = crease_fail(context, CREASE_ERROR_ARGUMENT, "sheet: the net is too small");
    size_t count = 0, first = 0;
    if (status == CREASE_OK)
        status = knots_for_gaps(context, f);
    if (status == CREASE_OK) {
        first = first_candidate(f, candidates);
        status = crease_scan(context, &samples, candidates + first, &count);
    }
    if (status == CREASE_OK)
        status = crease_explore(context, &f->draft, &f->bounds, candidates, first + count, turn);
    f->draft.orthogonal = true;
    if (status == CREASE_OK)
        status = crease_lines_refine(context, &f->draft, 12, turn);
    f->draft.orthogonal = false;
    if (status == CREASE_OK)
        status = crease_prune(context, &f->draft, &f->bounds, turn);
    crease_samples_free(&samples);
    return status;
}

/* A sheet that leaves the points far behind all the same is made stiffer until it does not; when
 * that does not help, its creases are at places where the points do not hold it. */
static crease_status hold_back(crease_context *context, crease_fitting *f)
{
    crease_draft *const draft = &f->draft;
    crease_status status = CREASE_OK;
    bool done = draft->fixed_lambda >= 0.0;
    while (status == CREASE_OK && !done && !crease_draft_bounded(draft)) {
        if (draft->lambda + 1 < (f->large ? CREASE_LAMBDAS - 1 : CREASE_LAMBDAS)) {
            draft->lambda++;
        } else {
            draft->layout.axis[0].line_count = draft->layout.axis[1].line_count = 0;
            crease_explore_keep_net(&draft->layout, &f->bounds);
            done = true;
        }
        draft->orthogonal = draft->redescending = false;
        crease_draft_place(draft);
        status = crease_draft_fit(context, draft, 3, CREASE_CHOICE_NONE);
    }
    return status;
}

void crease_fitting_lay_out_large(crease_fitting *f)
{
    crease_layout *const layout = &f->draft.layout;
    memcpy(f->bounds.net, f->options->net, sizeof f->bounds.net);
    for (int d = 0; d < 2; d++) {
        crease_layout_axis *const axis = &layout->axis[d];
        if (f->bounds.net[d] < crease_layout_count(layout, d) - axis->smooth) {
            if (d == 0) /* the errors of the other direction's lines follow */
                memmove(f->errors, f->errors + axis->line_count,
                    layout->axis[1].line_count * sizeof *f->errors);
            axis->line_count = 0;
        }
    }
    crease_explore_keep_net(layout, &f->bounds);
    f->draft.lambda = CREASE_LAMBDAS / 2;
    f->draft.stiffness = crease_draft_stiffness(&f->draft);
}

bool crease_fitting_is_exact(const crease_fitting *f)
{
    return f->draft.mean <= EXACT * f->draft.samples->spacing;
}

crease_status crease_fitting_enlarge(crease_context *context, crease_fitting *f)
{
    crease_draft *const draft = &f->draft;
    const crease_layout before = draft->layout;
    const double mean = draft->mean;
    /* where the small net is exact no weight is better than another */
    const bool exact = crease_fitting_is_exact(f);
    crease_fitting_lay_out_large(f);
    crease_status status = crease_draft_begin(context, draft, &draft->height, &before);
    if (status == CREASE_OK)
        status =
            crease_draft_fit(context, draft, 1, exact ? CREASE_CHOICE_NONE : CREASE_CHOICE_NEAR);
    if (status == CREASE_OK && !exact &&
        !(draft->mean > ALIKE * mean)) /* feet and weights are others now */
        status = crease_draft_fit_again(context, draft);
    return status == CREASE_OK ? hold_back(context, f) : status;
}

/* The fit of every step-th point, with the lines where these say. */
static crease_status settle(
    crease_context *context, crease_fitting *f, size_t step, int steps, crease_samples *samples)
{
    const bool turn = f->options->orientation == CREASE_ORIENTATION_AUTOMATIC;
    crease_status status = draft_samples(context, f, step, samples);
    f->draft.begun = f->exact;
    if (status == CREASE_OK)
        status = crease_draft_fit(context, &f->draft, 3, CREASE_CHOICE_NEAR);
    f->draft.redescending = f->draft.orthogonal = true;
    f->draft.begun = f->exact;
    if (status == CREASE_OK)
        status = crease_draft_fit(context, &f->draft, 4, CREASE_CHOICE_NONE);
    if (status == CREASE_OK && !f->exact)
        status = crease_lines_refine(context, &f->draft, steps, turn);
    return status == CREASE_OK ? hold_back(context, f) : status;
}

/* From the fit of some of the points to that of all: one round, one step of the lines unless they
 * are exact, and another round when that was worth it. */
static crease_status take_all(crease_context *context, crease_fitting *f, crease_samples *samples)
{
    crease_draft *const draft = &f->draft;
    const crease_layout before = draft->layout;
    const bool turn = f->options->orientation == CREASE_ORIENTATION_AUTOMATIC;
    crease_status status = draft_samples(context, f, 1, samples);
    draft->warm = true;
    if (status == CREASE_OK)
        status = crease_draft_begin(context, draft, &draft->height, &before);
    if (status == CREASE_OK)
        status = crease_draft_fit(context, draft, 1, CREASE_CHOICE_NONE);
    if (status == CREASE_OK && !f->exact)
        status = crease_lines_refine(context, draft, 1, turn);
    return status;
}

crease_status crease_fitting_settle(
    crease_context *context, crease_fitting *f, crease_samples *samples)
{
    crease_samples some = {0};
    const size_t step = (f->count + MOST_REFINED - 1) / MOST_REFINED;
    crease_status status = settle(context, f, step, f->count > MOST_EXPLORED && step == 1 ? 2 : 8,
        step > 1 ? &some : samples);
    if (status == CREASE_OK && step > 1)
        status = take_all(context, f, samples);
    crease_samples_free(&some);
    return status;
}

crease_status crease_fitting_tell_errors(crease_context *context, crease_fitting *f, double *errors)
{
    const bool turn = f->options->orientation == CREASE_ORIENTATION_AUTOMATIC;
    crease_covariance covariance;
    crease_status status = crease_covariance_create(context, &f->draft, turn, &covariance);
    if (status == CREASE_OK)
        crease_covariance_lines(&covariance, f->errors);
    if (status == CREASE_OK && errors)
        status = crease_covariance_points(context, &covariance, errors);
    crease_covariance_free(&covariance);
    return status;
}

/* ------------------------------------------------------------------------------------- sheet -- */

/* Where the points are: an angle in an empty corner of the rectangle is none of theirs. */
static bool has_points(const void *gaps, double u, double v)
{
    return !crease_gaps_at(gaps, u, v);
}

static crease_status describe_lines(
    crease_context *context, const crease_fitting *f, crease_sheet *sheet)
{
    const crease_layout *const layout = &f->draft.layout;
    sheet->lines = crease_allocate(
        context, layout->axis[0].line_count + layout->axis[1].line_count, sizeof *sheet->lines);
    if (!sheet->lines)
        return CREASE_ERROR_NO_MEMORY;
    for (int d = 0; d < 2; d++)
        for (size_t l = 0; l < layout->axis[d].line_count; l++) {
            const double at = layout->axis[d].lines[l];
            sheet->lines[sheet->line_count] = (crease_line){.direction = d,
                .parameter = at,
                .angle = crease_sheet_dihedral_where(
                    sheet->surface, d, at, has_points, &f->draft.system.gaps),
                .standard_error = f->errors[sheet->line_count]};
            sheet->line_count++;
        }
    return CREASE_OK;
}

crease_status crease_fitting_sheet(
    crease_context *context, const crease_fitting *f, crease_sheet **out)
{
    crease_sheet *const sheet = crease_allocate(context, 1, sizeof *sheet);
    crease_status status = sheet ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK) {
        sheet->frame = f->draft.frame;
        status = crease_height_surface(context, &f->draft.height, &f->draft.frame, &sheet->surface);
    }
    if (status == CREASE_OK)
        status = describe_lines(context, f, sheet);
    if (status == CREASE_OK)
        *out = sheet;
    else
        crease_sheet_free(sheet);
    return status;
}

crease_status crease_fitting_project(crease_context *context, const crease_closest *closest,
    const double *points, size_t count, crease_sheet *sheet)
{
    crease_foot *feet = crease_allocate(context, count, sizeof *feet);
    sheet->point_count = count;
    sheet->parameters = crease_allocate(context, count, 2 * sizeof(double));
    sheet->projected = crease_allocate(context, count, 3 * sizeof(double));
    sheet->deviations = crease_allocate(context, count, sizeof(double));
    crease_status status = feet && sheet->parameters && sheet->projected && sheet->deviations
        ? CREASE_OK
        : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK)
        status = closest ? crease_closest_feet(context, closest, points, count, feet)
                         : crease_surface_project(context, sheet->surface, points, count, feet);
    for (size_t i = 0; i < count && status == CREASE_OK; i++) {
        memcpy(sheet->parameters + 2 * i, feet[i].uv, sizeof feet[i].uv);
        memcpy(sheet->projected + 3 * i, feet[i].point, sizeof feet[i].point);
        sheet->deviations[i] = feet[i].distance;
    }
    free(feet);
    return status;
}
