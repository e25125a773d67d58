/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A sheet of points that come in batches. What has to be known beforehand is found from a sample;
 * each batch is then placed, weighed by its distances from the sheet found so far, and added to the
 * normal equations. */
#include "fit/sum.h"

#include "base/memory.h"
#include "spline/sheet.h"

#include <cblas.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { AT_ONCE = 1 << 20 };

/* How far the rectangle may go beyond that of the sample, in its spacings. */
static const double REACH = 4.0;
/* Mean distances of two fits of which one serves the other: in shares. */
static const double ALIKE = 0.98;

static crease_status copy_points(
    crease_context *context, const crease_cloud *from, crease_cloud **out)
{
    const crease_cloud_parts parts = {.count = crease_cloud_count(from),
        .points = crease_cloud_points(from),
        .coordinate_type = crease_cloud_coordinate_type(from)};
    return crease_cloud_create(context, &parts, out);
}

static crease_status begin(crease_context *context, crease_sheet_sum *sum)
{
    crease_fitting *const f = &sum->fitting;
    crease_status status = crease_fitting_create(context, sum->cloud, &sum->options, f);
    if (status == CREASE_OK)
        status = crease_fitting_find_exact(context, f);
    if (status == CREASE_OK)
        status = crease_fitting_choose(context, f);
    if (status == CREASE_OK)
        status = crease_fitting_settle(context, f, &sum->sample);
    if (status == CREASE_OK)
        status = crease_fitting_tell_errors(context, f, NULL);
    if (status != CREASE_OK)
        return status;
    sum->exact = crease_fitting_is_exact(f);
    for (int d = 0; d < 2; d++) {
        sum->all.low[d] = f->draft.layout.axis[d].low;
        sum->all.high[d] = f->draft.layout.axis[d].high;
    }
    return CREASE_OK;
}

crease_status crease_sheet_sum_create(crease_context *context, const crease_cloud *sample,
    const crease_sheet_options *options, crease_sheet_sum **out)
{
    *out = NULL;
    crease_sheet_sum *const sum = crease_allocate(context, 1, sizeof *sum);
    if (!sum)
        return CREASE_ERROR_NO_MEMORY;
    sum->options = options ? *options : crease_sheet_options_default();
    const int blas_threads = openblas_get_num_threads();
    openblas_set_num_threads(1);
    crease_status status = crease_fitting_check(context, &sum->options, crease_cloud_count(sample));
    if (status == CREASE_OK)
        status = copy_points(context, sample, &sum->cloud);
    if (status == CREASE_OK)
        status = begin(context, sum);
    openblas_set_num_threads(blas_threads);
    if (status == CREASE_OK)
        *out = sum;
    else
        crease_sheet_sum_free(sum);
    return status;
}

void crease_sheet_sum_free(crease_sheet_sum *sum)
{
    if (!sum)
        return;
    crease_closest_free(sum->closest);
    crease_surface_free(sum->surface);
    crease_height_free(&sum->below);
    crease_fitting_free(&sum->fitting);
    crease_samples_free(&sum->sample);
    crease_cloud_free(sum->cloud);
    free(sum);
}

/* ------------------------------------------------------------------------------------- points --
 */

static crease_status check_points(crease_context *context, const double *points, size_t count)
{
    for (size_t i = 0; i < 3 * count; i++)
        if (!isfinite(points[i]))
            return crease_fail(context, CREASE_ERROR_VALUE,
                "sheet: point %zu of these has the coordinate %g; give finite ones", i / 3,
                points[i]);
    return CREASE_OK;
}

/* Whether a point, in the frame, may be one of the sheet beside the sample's rectangle. */
static bool is_of_sheet(const crease_sheet_sum *sum, const double *point)
{
    const crease_draft *const draft = &sum->fitting.draft;
    const crease_side sides[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
    const double reach = REACH * sum->sample.spacing;
    for (int d = 0; d < 2; d++)
        if (!(point[d] >= draft->layout.axis[d].low - reach) ||
            !(point[d] <= draft->layout.axis[d].high + reach))
            return false;
    double f[3];
    crease_height_at(&draft->height, point, sides, 1, f);
    const double steep = sqrt(1.0 + f[1] * f[1] + f[2] * f[2]);
    return fabs(point[2] - f[0]) <= 2.0 * steep * reach;
}

crease_status crease_sheet_sum_widen(
    crease_context *context, crease_sheet_sum *sum, const double *points, size_t count)
{
    if (sum->open || sum->surface)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "sheet: points have been added; widen its rectangle before");
    const crease_status status = check_points(context, points, count);
    for (size_t i = 0; i < count && status == CREASE_OK; i++) {
        double point[3];
        crease_frame_enter(&sum->fitting.draft.frame, points + 3 * i, 1, point);
        const bool beyond = point[0] < sum->all.low[0] || point[0] > sum->all.high[0] ||
            point[1] < sum->all.low[1] || point[1] > sum->all.high[1];
        for (int d = 0; d < 2 && beyond && is_of_sheet(sum, point); d++) {
            sum->all.low[d] = fmin(sum->all.low[d], point[d]);
            sum->all.high[d] = fmax(sum->all.high[d], point[d]);
        }
    }
    return status;
}

/* The sheet at hand becomes the one that feet are taken from, and the equations are emptied. */
static crease_status open_round(crease_context *context, crease_sheet_sum *sum)
{
    crease_fitting *const f = &sum->fitting;
    crease_draft *const draft = &f->draft;
    const bool first = !sum->surface;
    crease_closest_free(sum->closest);
    sum->closest = NULL;
    crease_height_free(&sum->below);
    sum->below_layout = draft->layout;
    crease_status status = crease_height_create(context, &draft->layout, &sum->below);
    if (status != CREASE_OK)
        return status;
    memcpy(sum->below.coefficients, draft->height.coefficients,
        sum->below.count[0] * sum->below.count[1] * sizeof(double));
    if (first && f->large)
        crease_fitting_lay_out_large(f);
    for (int d = 0; d < 2; d++) {
        draft->layout.axis[d].low = sum->all.low[d];
        draft->layout.axis[d].high = sum->all.high[d];
    }
    sum->mean = draft->mean;
    status = crease_samples_project(context, &sum->sample, &sum->below, &sum->below_layout);
    if (status != CREASE_OK)
        return status;
    sum->scale = crease_samples_scale(&sum->sample);
    draft->begun = true;
    status = crease_draft_open(context, draft);
    crease_draft_hold(draft, sum->scale);
    sum->count = 0;
    sum->open = status == CREASE_OK;
    return status;
}

/* Points beyond the rectangle would pull at its border. */
static void leave_out(const crease_sheet_sum *sum, crease_samples *batch)
{
    for (size_t i = 0; i < batch->count; i++)
        for (size_t d = 0; d < 2; d++)
            if (!(batch->points[3 * i + d] >= sum->all.low[d]) ||
                !(batch->points[3 * i + d] <= sum->all.high[d]))
                batch->prior[i] = 0.0;
}

/* The five numbers of each point as the equations take them. */
static crease_observations observations_of(const double *numbers, size_t count)
{
    return (crease_observations){.count = count,
        .sides = 1,
        .uv = numbers,
        .weight = numbers + 2 * count,
        .tilt = numbers + 3 * count,
        .target = numbers + 4 * count};
}

static crease_status observe_some(crease_context *context, const crease_sheet_sum *sum,
    const double *points, const double *keep, size_t count, double *numbers)
{
    crease_samples batch = {0};
    double low[2], high[2];
    crease_status status = crease_samples_create(
        context, points, keep, count, 1, sum->sample.spacing, sum->fitting.epsilon, &batch);
    if (status == CREASE_OK) {
        crease_samples_place(&batch, &sum->fitting.draft.frame, low, high);
        leave_out(sum, &batch);
        status = crease_samples_project(context, &batch, &sum->below, &sum->below_layout);
    }
    if (status == CREASE_OK) {
        crease_samples_reweigh(&batch, sum->scale, true);
        memcpy(numbers, batch.uv, 2 * count * sizeof *numbers);
        memcpy(numbers + 2 * count, batch.weight, count * sizeof *numbers);
        memcpy(numbers + 3 * count, batch.tilt, count * sizeof *numbers);
        memcpy(numbers + 4 * count, batch.target, count * sizeof *numbers);
    }
    crease_samples_free(&batch);
    return status;
}

crease_status crease_sheet_sum_begin(crease_context *context, crease_sheet_sum *sum)
{
    return sum->open ? CREASE_OK : open_round(context, sum);
}

crease_status crease_sheet_sum_observe(crease_context *context, const crease_sheet_sum *sum,
    const double *points, size_t count, double *numbers)
{
    crease_status status = check_points(context, points, count);
    if (status != CREASE_OK || count == 0)
        return status;
    double *const keep = crease_allocate(context, count, sizeof *keep);
    if (!keep)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < count; i++)
        keep[i] = 1.0;
    status = observe_some(context, sum, points, keep, count, numbers);
    free(keep);
    return status;
}

crease_status crease_sheet_sum_take(
    crease_context *context, crease_sheet_sum *sum, const double *numbers, size_t count)
{
    crease_draft *const draft = &sum->fitting.draft;
    const crease_observations seen = observations_of(numbers, count);
    if (count == 0)
        return CREASE_OK;
    const crease_status status = crease_system_add(context, &draft->system, &draft->height, &seen);
    sum->count += status == CREASE_OK ? count : 0;
    return status;
}

crease_status crease_sheet_sum_add(
    crease_context *context, crease_sheet_sum *sum, const double *points, size_t count)
{
    const size_t most = count < AT_ONCE ? count : AT_ONCE;
    crease_status status = check_points(context, points, count);
    if (status != CREASE_OK || count == 0)
        return status;
    status = crease_sheet_sum_begin(context, sum);
    double *const numbers = crease_allocate(context, most, CREASE_OBSERVED * sizeof *numbers);
    if (!numbers)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t at = 0; at < count && status == CREASE_OK; at += most) {
        const size_t some = count - at < most ? count - at : most;
        status = crease_sheet_sum_observe(context, sum, points + 3 * at, some, numbers);
        if (status == CREASE_OK)
            status = crease_sheet_sum_take(context, sum, numbers, some);
    }
    free(numbers);
    return status;
}

size_t crease_sheet_sum_count(const crease_sheet_sum *sum)
{
    return sum->count;
}

/* -------------------------------------------------------------------------------------- sheet --
 */

/* Stiffer, while the sheet leaves the points far behind in its gaps. */
static crease_status hold_back(crease_context *context, crease_draft *draft)
{
    crease_status status = CREASE_OK;
    while (status == CREASE_OK && draft->fixed_lambda < 0.0 && !crease_draft_bounded(draft) &&
        draft->lambda + 2 < CREASE_LAMBDAS) {
        draft->lambda++;
        status = crease_draft_solve(context, draft, CREASE_CHOICE_NONE);
    }
    return status;
}

crease_status crease_sheet_sum_make_ready(crease_context *context, crease_sheet_sum *sum)
{
    const crease_draft *const draft = &sum->fitting.draft;
    return crease_closest_create(
        context, &draft->height, &draft->layout, &draft->frame, sum->surface, &sum->closest);
}

static crease_status solve(crease_context *context, crease_sheet_sum *sum, crease_sheet **out)
{
    crease_draft *const draft = &sum->fitting.draft;
    crease_surface *surface = NULL;
    draft->observed = (double)sum->count;
    crease_status status = crease_draft_solve(
        context, draft, sum->exact || sum->surface ? CREASE_CHOICE_NONE : CREASE_CHOICE_NEAR);
    if (status == CREASE_OK)
        status = hold_back(context, draft);
    if (status == CREASE_OK)
        status = crease_fitting_sheet(context, &sum->fitting, out);
    if (status == CREASE_OK)
        status = crease_height_surface(context, &draft->height, &draft->frame, &surface);
    if (status != CREASE_OK)
        return status;
    sum->wants_more = !sum->surface && !sum->exact && !(draft->mean > ALIKE * sum->mean);
    crease_surface_free(sum->surface);
    sum->surface = surface;
    sum->open = false;
    status = crease_sheet_sum_make_ready(context, sum);
    return status == CREASE_OK ? crease_fitting_project(context, sum->closest, sum->fitting.points,
                                     sum->fitting.count, *out)
                               : status;
}

crease_status crease_sheet_sum_solve(
    crease_context *context, crease_sheet_sum *sum, crease_sheet **out)
{
    *out = NULL;
    if (!sum->open || sum->count == 0)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "sheet: no points have been added since it was solved last; add all of them");
    const int blas_threads = openblas_get_num_threads();
    openblas_set_num_threads(1);
    const crease_status status = solve(context, sum, out);
    openblas_set_num_threads(blas_threads);
    if (status != CREASE_OK) {
        crease_sheet_free(*out);
        *out = NULL;
    }
    return status;
}

bool crease_sheet_sum_wants_more(const crease_sheet_sum *sum)
{
    return sum->wants_more;
}

crease_status crease_sheet_sum_distances(crease_context *context, const crease_sheet_sum *sum,
    const double *points, size_t count, double *distances)
{
    if (!sum->surface)
        return crease_fail(context, CREASE_ERROR_ARGUMENT, "sheet: it has not been solved yet");
    crease_foot *feet = crease_allocate(context, count, sizeof *feet);
    if (!feet)
        return CREASE_ERROR_NO_MEMORY;
    const crease_status status = sum->closest
        ? crease_closest_feet(context, sum->closest, points, count, feet)
        : crease_surface_project(context, sum->surface, points, count, feet);
    for (size_t i = 0; i < count && status == CREASE_OK; i++)
        distances[i] = feet[i].distance;
    free(feet);
    return status;
}
