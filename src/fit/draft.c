/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "fit/draft.h"

#include <math.h>

enum { FEW_UNKNOWNS = 128 };

/* Parameters for each point; with more of them a fit follows the noise and tells nothing. */
static const double MOST_FREEDOM = 0.4;
/* Distances, in spacings, below which one fit is as good as another. */
static const double NEGLIGIBLE = 1e-9;
static const double LAMBDAS[CREASE_LAMBDAS] = {1e-13, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 1, 1e2, 1e6};

void crease_draft_place(crease_draft *draft)
{
    double low[2], high[2];
    crease_samples_place(draft->samples, &draft->frame, low, high);
    for (int d = 0; d < 2; d++) {
        draft->layout.axis[d].low = low[d];
        draft->layout.axis[d].high = high[d];
    }
}

void crease_draft_free(crease_draft *draft)
{
    crease_height_free(&draft->height);
    crease_system_free(&draft->system);
}

crease_draft crease_draft_variant(
    const crease_draft *draft, const crease_layout *layout, const crease_frame *frame)
{
    crease_draft variant = *draft;
    variant.layout = *layout;
    variant.frame = *frame;
    variant.height = (crease_height){0};
    variant.system = (crease_system){0};
    return variant;
}

/* Fits with one bending weight; the score stays infinite where the equations have no solution. */
static crease_status try_lambda(crease_context *context, crease_draft *draft, double lambda)
{
    draft->score = INFINITY;
    if (!crease_system_factor(&draft->system, lambda))
        return CREASE_OK;
    crease_system_solve(&draft->system, &draft->height);
    const crease_status status = crease_samples_measure(context, draft->samples, &draft->height);
    if (status != CREASE_OK)
        return status;
    const double n = draft->samples->used;
    const double floor = fmax(draft->samples->rounding, NEGLIGIBLE * draft->samples->spacing);
    draft->mean = crease_samples_mean_distance(draft->samples);
    draft->freedom = crease_system_freedom(&draft->system);
    if (draft->fixed_lambda >= 0.0 || draft->freedom <= MOST_FREEDOM * n)
        draft->score = 2.0 * n * log(draft->mean + floor) + draft->freedom * log(n);
    return CREASE_OK;
}

static crease_status try_number(
    crease_context *context, crease_draft *draft, int number, double *best, int *taken)
{
    const crease_status status = try_lambda(context, draft, LAMBDAS[number]);
    if (draft->score < *best) {
        *best = draft->score;
        *taken = number;
    }
    return status;
}

/* Leaves the number of the best bending weight in the draft. */
static crease_status choose_lambda(crease_context *context, crease_draft *draft, bool all)
{
    double best = INFINITY;
    int taken = draft->lambda;
    crease_status status = CREASE_OK;
    if (all) {
        for (int i = 0; i < CREASE_LAMBDAS && status == CREASE_OK; i++)
            status = try_number(context, draft, i, &best, &taken);
    } else {
        const int start = draft->lambda;
        status = try_number(context, draft, start, &best, &taken);
        for (int i = start + 1;
             i < CREASE_LAMBDAS && (taken == i - 1 || !(best < INFINITY)) && status == CREASE_OK;
             i++)
            status = try_number(context, draft, i, &best, &taken);
        const int from = taken == start ? start - 1 : -1;
        for (int i = from; i >= 0 && status == CREASE_OK && (i == from || taken == i + 1); i--)
            status = try_number(context, draft, i, &best, &taken);
    }
    draft->lambda = taken;
    return status;
}

static crease_status solve(crease_context *context, crease_draft *draft, bool all)
{
    crease_status status =
        crease_system_assemble(context, &draft->system, &draft->height, draft->samples);
    if (status == CREASE_OK && draft->fixed_lambda < 0.0)
        status = choose_lambda(context, draft, all);
    if (status == CREASE_OK)
        status = try_lambda(context, draft,
            draft->fixed_lambda < 0.0 ? LAMBDAS[draft->lambda] : draft->fixed_lambda);
    if (status == CREASE_OK && !(draft->score < INFINITY))
        status = crease_fail(context, CREASE_ERROR_NUMERIC,
            "fit: %zu control points are not determined by the points; ask for fewer, or for some "
            "smoothing",
            draft->system.size);
    return status;
}

crease_status crease_draft_fit(crease_context *context, crease_draft *draft, int rounds, bool all)
{
    crease_draft_free(draft);
    crease_status status = crease_height_create(context, &draft->layout, &draft->height);
    if (status == CREASE_OK)
        status = crease_system_create(context, &draft->height, &draft->system);
    for (int round = 0; round < rounds && status == CREASE_OK; round++) {
        if (round > 0)
            crease_samples_reweigh(
                draft->samples, crease_samples_scale(draft->samples), draft->redescending);
        if (round > 0 && draft->orthogonal)
            status =
                crease_samples_project(context, draft->samples, &draft->height, &draft->layout);
        if (status == CREASE_OK)
            status = solve(context, draft, all && draft->system.size <= FEW_UNKNOWNS);
    }
    return status;
}
