/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "fit/draft.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FEW_UNKNOWNS = 128, FEW_POINTS = 1000, MORE_ROUNDS = 3, PLACES = 32 };

/* Parameters for each point; with more of them a fit follows the noise and tells nothing. */
static const double MOST_FREEDOM = 0.4;
/* Distances, in spacings, below which one fit is as good as another. */
static const double NEGLIGIBLE = 1e-9;
/* What a square gap over which the sheet rises by the whole range of heights costs, in squared
 * standard deviations of a point: little beside what the points about it say. */
static const double RISE = 1000.0;
static const double FIRST_SCALE = 0.1; /* standard deviation before it is known, in ranges */
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

/* Solves with one bending weight; false when the equations have no solution. */
static crease_status solve(
    crease_context *context, crease_draft *draft, double lambda, bool *solved)
{
    crease_status status = crease_system_factor(context, &draft->system, lambda, solved);
    if (status != CREASE_OK || !*solved)
        return status;
    status = crease_system_solve(context, &draft->system, draft->height.coefficients);
    return status == CREASE_OK ? crease_samples_measure(context, draft->samples, &draft->height)
                               : status;
}

/* Mean distance, freedom and score of the solution at hand. */
static crease_status evaluate(crease_context *context, crease_draft *draft)
{
    const double n = draft->observed > 0.0 ? draft->observed : draft->samples->used;
    const double floor = fmax(draft->samples->rounding, NEGLIGIBLE * draft->samples->spacing);
    draft->mean = crease_samples_mean_distance(draft->samples);
    const crease_status status = crease_system_freedom(context, &draft->system, &draft->freedom);
    const double price = log(n) * n / (n - 2.0 * fmin(draft->freedom, MOST_FREEDOM * n));
    draft->score = draft->fixed_lambda >= 0.0 || draft->freedom <= MOST_FREEDOM * n
        ? 2.0 * n * log(draft->mean + floor) + draft->freedom * price
        : INFINITY;
    return status;
}

/* The score stays infinite where the equations have no solution. */
static crease_status try_lambda(crease_context *context, crease_draft *draft, double lambda)
{
    bool solved;
    draft->score = INFINITY;
    crease_status status = solve(context, draft, lambda, &solved);
    if (status == CREASE_OK && solved)
        status = evaluate(context, draft);
    return status;
}

/* How many of the bending weights may be taken. The last is too stiff for iterations: they would
 * not see what holds the gaps. */
static int weights(const crease_draft *draft)
{
    return draft->system.multigrid ? CREASE_LAMBDAS - 1 : CREASE_LAMBDAS;
}

/* What a choice has found so far. */
typedef struct selection {
    double score, mean, freedom;
    int number;
    double *coefficients; /* where solving again takes long, else NULL */
} selection;

static crease_status try_number(
    crease_context *context, crease_draft *draft, int number, selection *best)
{
    const crease_status status = try_lambda(context, draft, LAMBDAS[number]);
    if (status != CREASE_OK || !(draft->score < best->score))
        return status;
    best->score = draft->score;
    best->mean = draft->mean;
    best->freedom = draft->freedom;
    best->number = number;
    if (best->coefficients)
        memcpy(best->coefficients, draft->height.coefficients,
            draft->system.size * sizeof *best->coefficients);
    return CREASE_OK;
}

/* The best of all bending weights. */
static crease_status choose_of_all(crease_context *context, crease_draft *draft, selection *best)
{
    crease_status status = CREASE_OK;
    for (int i = 0; i < weights(draft) && status == CREASE_OK; i++)
        status = try_number(context, draft, i, best);
    return status;
}

double crease_draft_stiffness(const crease_draft *draft)
{
    const crease_system *const system = &draft->system;
    return system->lambda * crease_stencil_trace(&system->normal) / system->traces[0];
}

/* The weight to begin with: the one last taken, or what a stiffness comes to, if that is more. */
static int first_number(const crease_draft *draft)
{
    const crease_system *const system = &draft->system;
    const double lambda =
        draft->stiffness * system->traces[0] / crease_stencil_trace(&system->normal);
    int number = draft->lambda;
    while (number + 1 < weights(draft) && LAMBDAS[number + 1] <= lambda)
        number++;
    return number < weights(draft) ? number : weights(draft) - 1;
}

/* From the one last taken upwards, and downwards, as long as it gets better. */
static crease_status choose_near(crease_context *context, crease_draft *draft, selection *best)
{
    const int start = first_number(draft);
    crease_status status = try_number(context, draft, start, best);
    for (int i = start + 1; i < weights(draft) &&
         (best->number == i - 1 || !(best->score < INFINITY)) && status == CREASE_OK;
         i++)
        status = try_number(context, draft, i, best);
    const int from = best->number == start ? start - 1 : -1;
    for (int i = from; i >= 0 && status == CREASE_OK && (i == from || best->number == i + 1); i--)
        status = try_number(context, draft, i, best);
    return status;
}

static crease_status not_determined(crease_context *context, const crease_draft *draft)
{
    return crease_fail(context, CREASE_ERROR_NUMERIC,
        "fit: %zu control points are not determined by the points; ask for fewer, or for some "
        "smoothing",
        draft->system.size);
}

/* Leaves the best solution in the draft. */
static crease_status take_best(crease_context *context, crease_draft *draft, const selection *best)
{
    draft->lambda = best->number;
    if (draft->system.lambda == LAMBDAS[best->number])
        return CREASE_OK;
    if (!best->coefficients || !(best->score < INFINITY))
        return try_lambda(context, draft, LAMBDAS[best->number]);
    draft->score = best->score;
    draft->mean = best->mean;
    draft->freedom = best->freedom;
    memcpy(draft->height.coefficients, best->coefficients,
        draft->system.size * sizeof *best->coefficients);
    return crease_samples_measure(context, draft->samples, &draft->height);
}

/* Leaves the solution with the best bending weight in the draft. */
static crease_status choose_lambda(crease_context *context, crease_draft *draft, bool all)
{
    selection best = {.score = INFINITY, .number = draft->lambda};
    if (draft->system.multigrid) {
        best.coefficients = crease_allocate(context, draft->system.size, sizeof(double));
        if (!best.coefficients)
            return CREASE_ERROR_NO_MEMORY;
    }
    crease_status status =
        all ? choose_of_all(context, draft, &best) : choose_near(context, draft, &best);
    if (status == CREASE_OK)
        status = take_best(context, draft, &best);
    free(best.coefficients);
    if (status == CREASE_OK && !(draft->score < INFINITY))
        status = not_determined(context, draft);
    return status;
}

static crease_status keep_lambda(crease_context *context, crease_draft *draft, bool last)
{
    bool solved = false;
    crease_status status = CREASE_OK;
    if (draft->fixed_lambda >= 0.0)
        status = solve(context, draft, draft->fixed_lambda, &solved);
    for (; draft->fixed_lambda < 0.0 && status == CREASE_OK; draft->lambda++) {
        status = solve(context, draft, LAMBDAS[draft->lambda], &solved);
        if (solved || draft->lambda + 1 == CREASE_LAMBDAS)
            break;
    }
    if (status == CREASE_OK && !solved)
        return not_determined(context, draft);
    if (status != CREASE_OK || !last)
        return status;
    if (!draft->system.multigrid)
        return evaluate(context, draft);
    draft->mean = crease_samples_mean_distance(draft->samples); /* a score takes another solution */
    return CREASE_OK;
}

static double weight_of_tension(const crease_samples *samples, double scale)
{
    return RISE * pow(scale / hypot(samples->range, samples->spacing), 2.0);
}

static crease_status assemble(crease_context *context, crease_draft *draft)
{
    const crease_samples *const s = draft->samples;
    const crease_observations observations = {.count = s->count,
        .sides = 1,
        .uv = s->uv,
        .weight = s->weight,
        .tilt = s->tilt,
        .target = s->target};
    crease_system_clear(&draft->system);
    return crease_system_add(context, &draft->system, &draft->height, &observations);
}

static crease_status fit_round(
    crease_context *context, crease_draft *draft, int round, bool last, crease_choice choice)
{
    crease_status status = CREASE_OK;
    double scale = FIRST_SCALE * draft->samples->range;
    if (round > 0 || draft->begun) {
        scale = crease_samples_scale(draft->samples);
        crease_samples_reweigh(draft->samples, scale, draft->redescending);
    }
    draft->system.hold = weight_of_tension(draft->samples, scale);
    if (round > 0 && draft->orthogonal)
        status = crease_samples_project(context, draft->samples, &draft->height, &draft->layout);
    if (status == CREASE_OK)
        status = assemble(context, draft);
    if (status != CREASE_OK)
        return status;
    const bool choose = last || (round == 0 && !draft->system.multigrid);
    if (choice == CREASE_CHOICE_NONE || draft->fixed_lambda >= 0.0 || !choose)
        return keep_lambda(context, draft, last);
    return choose_lambda(
        context, draft, choice == CREASE_CHOICE_ALL && draft->system.size <= FEW_UNKNOWNS);
}

bool crease_draft_bounded(const crease_draft *draft)
{
    const crease_samples *const s = draft->samples;
    const crease_layout_axis *const axis = draft->layout.axis;
    const crease_side sides[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
    const double most = 1.5 * hypot(s->range, s->spacing), middle = s->bottom + 0.5 * s->range;
    for (int i = 0; i <= PLACES; i++)
        for (int j = 0; j <= PLACES; j++) {
            const double uv[2] = {axis[0].low + (axis[0].high - axis[0].low) * i / PLACES,
                axis[1].low + (axis[1].high - axis[1].low) * j / PLACES};
            double f[3];
            crease_height_at(&draft->height, uv, sides, 0, f);
            if (!(fabs(f[0] - middle) <= most))
                return false;
        }
    return true;
}

crease_status crease_draft_open(crease_context *context, crease_draft *draft)
{
    crease_gaps gaps = {.empty = 0};
    crease_height before = draft->height;
    draft->height = (crease_height){0};
    crease_draft_free(draft);
    crease_status status = crease_gaps_create(context, draft->samples, &draft->layout, &gaps);
    if (status == CREASE_OK)
        status = crease_height_create(context, &draft->layout, &draft->height);
    if (status == CREASE_OK)
        status = crease_system_create(context, &draft->height, 1, &gaps, &draft->system);
    crease_gaps_free(&gaps);
    if (status == CREASE_OK && draft->begun && before.coefficients && draft->system.multigrid)
        crease_height_resemble(&before, &draft->height);
    crease_height_free(&before);
    return status;
}

crease_status crease_draft_fit(
    crease_context *context, crease_draft *draft, int rounds, crease_choice choice)
{
    crease_status status = crease_draft_open(context, draft);
    const int times = draft->samples->count <= FEW_POINTS ? MORE_ROUNDS * rounds : rounds;
    for (int round = 0; round < times && status == CREASE_OK; round++)
        status = fit_round(context, draft, round, round == times - 1, choice);
    draft->begun = false;
    return status;
}

void crease_draft_hold(crease_draft *draft, double scale)
{
    draft->system.hold = weight_of_tension(draft->samples, scale);
}

crease_status crease_draft_solve(crease_context *context, crease_draft *draft, crease_choice choice)
{
    return choice == CREASE_CHOICE_NONE || draft->fixed_lambda >= 0.0
        ? keep_lambda(context, draft, true)
        : choose_lambda(context, draft, false);
}

crease_status crease_draft_begin(crease_context *context, crease_draft *draft,
    const crease_height *height, const crease_layout *layout)
{
    const crease_layout below = *layout; /* perhaps the draft's own, whose ends now move */
    crease_draft_place(draft);
    draft->begun = true;
    return crease_samples_project(context, draft->samples, height, &below);
}

crease_status crease_draft_fit_again(crease_context *context, crease_draft *draft)
{
    return fit_round(context, draft, 1, true, CREASE_CHOICE_NONE);
}
