/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A creased sheet from a cloud: the points become a height field in a frame whose y axis follows
 * the edge; lines where it bends or jumps are looked for and become knots of full multiplicity; the
 * number of further knots, the bending weight and the lines that stay are those with the best
 * score; then the lines are moved, and the frame is turned, to where the points fit best. */
#include "base/memory.h"
#include "fit/better.h"
#include "fit/curved.h"
#include "fit/fitting.h"
#include "spline/sheet.h"

#include <cblas.h>
#include <stdlib.h>

crease_sheet_options crease_sheet_options_default(void)
{
    return (crease_sheet_options){.orientation = CREASE_ORIENTATION_AUTOMATIC,
        .rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1},
        .order = 4,
        .creases = -1,
        .smoothing = -1.0};
}

/* The final fit, on all points, with their standard errors unless a larger net is to come. */
static crease_status finish(
    crease_context *context, crease_fitting *f, double **errors, crease_sheet **sheet)
{
    crease_samples samples = {0};
    crease_status status = crease_fitting_settle(context, f, &samples);
    if (status == CREASE_OK && !f->large) {
        *errors = crease_allocate(context, f->count, sizeof **errors);
        status = *errors ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    }
    if (status == CREASE_OK)
        status = crease_fitting_tell_errors(context, f, *errors);
    if (status == CREASE_OK && f->large)
        status = crease_fitting_enlarge(context, f);
    if (status == CREASE_OK)
        status = crease_fitting_sheet(context, f, sheet);
    crease_samples_free(&samples);
    crease_system_free(&f->draft.system); /* before all points are projected */
    return status;
}

/* A height over a rectangle. */
static crease_status fit_height(crease_context *context, crease_fitting *f, crease_sheet **sheet)
{
    double *errors = NULL;
    crease_closest *closest = NULL;
    const crease_draft *const draft = &f->draft;
    crease_status status = crease_fitting_choose(context, f);
    if (status == CREASE_OK)
        status = finish(context, f, &errors, sheet);
    if (status == CREASE_OK) {
        (*sheet)->errors = errors;
        errors = NULL;
        status = crease_closest_create(
            context, &draft->height, &draft->layout, &draft->frame, (*sheet)->surface, &closest);
    }
    if (status == CREASE_OK)
        status = crease_fitting_project(context, closest, f->points, f->count, *sheet);
    crease_closest_free(closest);
    free(errors);
    return status;
}

/* Curved creases, and folds that no height field has, unless the options ask for a height field. */
static crease_status try_curved(crease_context *context, const crease_cloud *cloud,
    const crease_sheet_options *o, crease_straightness *found, crease_sheet **sheet)
{
    *found = (crease_straightness){.straight = true};
    if (o->orientation != CREASE_ORIENTATION_AUTOMATIC || o->net[0] || o->net[1] ||
        o->creases == 0 || o->smoothing >= 0.0)
        return CREASE_OK;
    const crease_status status = crease_curved_fit(context, cloud, o, found, sheet);
    return status == CREASE_OK && *sheet
        ? crease_fitting_project(
              context, NULL, crease_cloud_points(cloud), crease_cloud_count(cloud), *sheet)
        : status;
}

/* A height field beside a curved sheet whose creases may be straight: the better one is kept. */
static crease_status compare(crease_context *context, crease_fitting *f, crease_sheet **sheet)
{
    crease_sheet *height = NULL;
    const crease_status status = fit_height(context, f, &height);
    if (status == CREASE_OK && height->line_count > 0 &&
        crease_better_height(height, *sheet, f->draft.frame.rotation + 6, f->spacing)) {
        crease_sheet *const curved = *sheet;
        *sheet = height;
        height = curved;
    }
    crease_sheet_free(height);
    return status == CREASE_ERROR_NUMERIC || status == CREASE_ERROR_DEGENERATE ? CREASE_OK : status;
}

static crease_status fit(crease_context *context, const crease_cloud *cloud,
    const crease_sheet_options *options, crease_sheet **sheet)
{
    crease_fitting f;
    crease_straightness found = {.straight = true};
    crease_status status = crease_fitting_create(context, cloud, options, &f);
    if (status == CREASE_OK)
        status = crease_fitting_find_exact(context, &f);
    if (status == CREASE_OK && !f.exact) {
        status = try_curved(context, cloud, options, &found, sheet);
        if (found.nearly)
            crease_fitting_follow(&f, found.point, found.direction);
    }
    if (status == CREASE_OK && !*sheet)
        status = fit_height(context, &f, sheet);
    else if (status == CREASE_OK && found.nearly)
        status = compare(context, &f, sheet);
    crease_fitting_free(&f);
    return status;
}

crease_status crease_sheet_fit(crease_context *context, const crease_cloud *cloud,
    const crease_sheet_options *options, crease_sheet **out)
{
    *out = NULL;
    const crease_sheet_options chosen = options ? *options : crease_sheet_options_default();
    crease_sheet *sheet = NULL;
    crease_status status = crease_fitting_check(context, &chosen, crease_cloud_count(cloud));
    if (status != CREASE_OK)
        return status;
    const int blas_threads = openblas_get_num_threads();
    openblas_set_num_threads(1);
    status = fit(context, cloud, &chosen, &sheet);
    openblas_set_num_threads(blas_threads);
    if (status == CREASE_OK)
        *out = sheet;
    else
        crease_sheet_free(sheet);
    return status;
}
