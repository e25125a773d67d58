/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Which kind of surface a sample shows: all kinds that its number of points can tell apart are
 * fitted, and the cheapest by an information criterion is taken.
 *
 * Based on: Schwarz. Estimating the dimension of a model. 1978.
 * Based on: Akaike. A new look at the statistical model identification. 1974. */
#include "primitive/fitter.h"

#include "primitive/patch.h"

#include <math.h>
#include <string.h>

static const double growing_share = 0.25; /* of the points, for kinds richer than a plane */
static const double least_support = 0.5;  /* of a spline's coefficients that data determine */
static const double exact_share = 0.01;   /* cost of a point below which nothing richer is tried */

/* Primitives are fitted to so many points first; those that are clearly dearer there than a model
 * is allowed to be are not fitted to all. */
enum { SCREEN_POINTS = 160 };
static const double screen_ratio = 1.3, screen_slack = 20.0;

typedef struct choice {
    crease_fitter *fitter;
    const crease_sample *sample;
    crease_fit_rule rule;
    crease_fit_level level;
    double limit; /* no dearer model is of use */
    const crease_model *warm;
    crease_model quadratic; /* polynomial of degree 2; its coefficients are the third candidate's */
    bool has_quadratic;
    double log_count;
} choice;

crease_fit_level crease_fit_level_for(size_t count)
{
    return count < 16 ? CREASE_LEVEL_QUADRATIC
        : count < 40  ? CREASE_LEVEL_ROUND
        : count < 150 ? CREASE_LEVEL_SOLIDS
                      : CREASE_LEVEL_ALL;
}

static double log_count(const crease_sample *sample)
{
    return log(fmax((double)sample->count, 2.0));
}

/* Sum of the cut squared residuals of a model relative to the sample's origin. */
static double misfit(const crease_model *model, const crease_sample *sample, double sigma)
{
    double sum = 0.0, gradient[3];
    for (size_t i = 0; i < sample->count; i++) {
        const double r = crease_model_distance(model, sample->points + 3 * i, gradient) / sigma;
        sum += fmin(r * r, CREASE_COST_CUT);
    }
    return sum;
}

static void shift(crease_model *model, const double origin[3], double sign)
{
    for (int c = 0; c < 3; c++)
        model->centre[c] += sign * origin[c];
}

double crease_fit_cost(const crease_model *model, const crease_sample *sample, double sigma)
{
    crease_model local = *model;
    shift(&local, sample->origin, -1.0);
    return misfit(&local, sample, sigma) + model->parameter_count * log_count(sample);
}

static bool is_simple(const crease_model *model)
{
    return model->type != CREASE_REGION_FREEFORM ||
        (!model->patch.spline && model->patch.degree == 2);
}

static double surcharge(const choice *at, const crease_model *model)
{
    const double share = model->type == CREASE_REGION_PLANE ? 0.0 : is_simple(model) ? 1.0 : 2.0;
    switch (at->rule) {
    case CREASE_RULE_GROWING:
        return model->parameter_count * at->log_count +
            growing_share * share * (double)at->sample->count;
    case CREASE_RULE_AKAIKE:
        return model->parameter_count * 2.0;
    default:
        return model->parameter_count * at->log_count;
    }
}

static void rate(const choice *at, crease_model *model)
{
    const double sum = misfit(model, at->sample, at->fitter->sigma);
    model->chi = sum / (double)at->sample->count;
    model->cost = sum + surcharge(at, model);
    if (!isfinite(model->cost))
        model->cost = INFINITY;
}

/* Rates the model on trial and keeps it when it is better than the best. */
static void compare(choice *at)
{
    crease_fitter *const fitter = at->fitter;
    rate(at, &fitter->trial);
    if (!(fitter->trial.cost < fitter->best.cost))
        return;
    const crease_model loser = fitter->best;
    fitter->best = fitter->trial;
    fitter->trial = loser;
}

/* Begins with no model at all. */
static void begin(choice *at)
{
    crease_fitter *const fitter = at->fitter;
    fitter->best = (crease_model){.cost = INFINITY, .chi = INFINITY};
    fitter->trial = fitter->best;
    fitter->best.patch.coefficients = fitter->coefficients[0];
    fitter->trial.patch.coefficients = fitter->coefficients[1];
    at->log_count = log_count(at->sample);
}

/* The model on trial becomes a copy of a primitive. */
static void try_from(choice *at, const crease_model *model, crease_region_type type)
{
    crease_model *const trial = &at->fitter->trial;
    double *const coefficients = trial->patch.coefficients;
    *trial = *model;
    trial->type = type;
    trial->patch.coefficients = coefficients;
}

/* Cost that a further model must be below. */
static double allowed(const choice *at)
{
    return fmin(at->fitter->best.cost, at->limit);
}

/* Improves the model on trial with a part of the points. False when it is no good there. */
static bool passes_screen(choice *at)
{
    crease_fitter *const fitter = at->fitter;
    crease_sample *const few = &fitter->screen;
    const size_t count = at->sample->count;
    memcpy(few->origin, at->sample->origin, sizeof few->origin);
    few->count = SCREEN_POINTS;
    for (size_t i = 0; i < SCREEN_POINTS; i++)
        memcpy(few->points + 3 * i, at->sample->points + 3 * (i * count / SCREEN_POINTS),
            3 * sizeof *few->points);
    if (!crease_fit_primitive(fitter, few, &fitter->trial))
        return false;
    const double share = (double)count / SCREEN_POINTS;
    return share * misfit(&fitter->trial, few, fitter->sigma) <=
        screen_ratio * allowed(at) + screen_slack;
}

/* Fits the model on trial, a guess. */
static bool fit_trial(choice *at)
{
    if (at->sample->count > 2 * SCREEN_POINTS && allowed(at) < INFINITY && !passes_screen(at))
        return false;
    return crease_fit_primitive(at->fitter, at->sample, &at->fitter->trial);
}

static void try_primitive(choice *at, bool guessed)
{
    if (guessed && fit_trial(at))
        compare(at);
}

static void try_warm(choice *at)
{
    if (!at->warm || at->warm->type == CREASE_REGION_PLANE ||
        at->warm->type == CREASE_REGION_FREEFORM)
        return;
    try_from(at, at->warm, at->warm->type);
    shift(&at->fitter->trial, at->sample->origin, -1.0);
    try_primitive(at, true);
}

static void try_quadratic(choice *at, size_t least_points)
{
    crease_fitter *const fitter = at->fitter;
    at->has_quadratic = at->sample->count >= least_points &&
        crease_fit_polynomial(fitter, at->sample, 2, &fitter->trial);
    if (!at->has_quadratic)
        return;
    at->quadratic = fitter->trial;
    at->quadratic.patch.coefficients = fitter->coefficients[2];
    memcpy(at->quadratic.patch.coefficients, fitter->trial.patch.coefficients,
        fitter->trial.patch.coefficient_count * sizeof(double));
}

/* Cylinders from the normals and from the curvature; the better one is on trial in the end. False
 * when there is none. */
static bool better_cylinder(choice *at)
{
    crease_fitter *const fitter = at->fitter;
    crease_model best = {.cost = INFINITY};
    for (int way = 0; way < 2; way++) {
        if (way == 1 && !at->has_quadratic)
            break;
        const bool guessed = way == 0
            ? crease_guess_cylinder(at->sample, &fitter->trial)
            : crease_guess_cylinder_along(at->sample, &at->quadratic, &fitter->trial);
        if (!guessed || !fit_trial(at))
            continue;
        rate(at, &fitter->trial);
        if (fitter->trial.cost < best.cost)
            best = fitter->trial;
    }
    if (best.cost < INFINITY)
        try_from(at, &best, CREASE_REGION_CYLINDER);
    return best.cost < INFINITY;
}

static void try_round(choice *at)
{
    try_warm(at);
    try_primitive(at, crease_guess_sphere(at->sample, &at->fitter->trial));
    if (!better_cylinder(at))
        return;
    const crease_model cylinder = at->fitter->trial;
    compare(at);
    if (at->level < CREASE_LEVEL_SOLIDS)
        return;
    try_from(at, &cylinder, CREASE_REGION_CONE);
    try_primitive(at, true);
}

/* Whether a polynomial's parameters alone do not cost too much. */
static bool is_affordable(const choice *at, int degree)
{
    const crease_model parameters = {
        .type = CREASE_REGION_FREEFORM, .parameter_count = 0.5 * (degree + 1) * (degree + 2)};
    return surcharge(at, &parameters) < allowed(at);
}

static void try_solids(choice *at)
{
    crease_fitter *const fitter = at->fitter;
    try_primitive(at, crease_guess_cone(at->sample, &fitter->trial));
    if (fitter->best.chi > 0.95 || fitter->best.type == CREASE_REGION_FREEFORM)
        try_primitive(at, crease_guess_torus(at->sample, &fitter->trial));
    const double count = (double)at->sample->count;
    for (int degree = 3; degree <= CREASE_PATCH_DEGREE; degree++)
        if (at->rule != CREASE_RULE_GROWING && count >= 5.0 * degree * degree &&
            fitter->best.chi * count > 2.0 * at->log_count && is_affordable(at, degree) &&
            crease_fit_polynomial(fitter, at->sample, degree, &fitter->trial))
            compare(at);
}

/* Splines from few spans upwards, around those of the warm model, until they no longer pay: over a
 * plane, around an axis or around a centre. */
typedef bool fit_spline(
    crease_fitter *fitter, const crease_sample *sample, int spans, crease_model *model);

static void try_splines(choice *at, fit_spline *fit, int least)
{
    crease_fitter *const fitter = at->fitter;
    const bool warm =
        at->warm && at->warm->type == CREASE_REGION_FREEFORM && at->warm->patch.spline;
    const int low = warm && at->warm->patch.spans > 4 ? at->warm->patch.spans - 2 : least;
    const int wanted = warm ? at->warm->patch.spans + 4 : 6;
    const int high = wanted < CREASE_PATCH_SPANS ? wanted : CREASE_PATCH_SPANS;
    const double count = (double)at->sample->count;
    for (int spans = low; spans <= high; spans += spans < 4 ? 1 : 2) {
        const double coefficients = (fit == crease_fit_tube ? spans : spans + 3) * (spans + 3);
        const double chi = fitter->best.chi;
        const crease_model fewest = {
            .type = CREASE_REGION_FREEFORM, .parameter_count = least_support * coefficients};
        const bool exact = chi * count < 0.5 * count + 2.0 * at->log_count && chi < 0.2;
        if (exact || 3.0 * coefficients >= count || surcharge(at, &fewest) >= allowed(at) ||
            !fit(fitter, at->sample, spans, &fitter->trial))
            break;
        compare(at);
        const crease_model *const best = &fitter->best;
        const bool spline = best->type == CREASE_REGION_FREEFORM && best->patch.spline;
        if (spline ? best->patch.spans < spans - 2 : spans > 4 && best->chi < 1.3)
            break;
    }
}

/* Whether to begin with a spline: what it leaves lets the others be sieved out with few points. */
static bool is_spline(const crease_model *warm)
{
    return warm && warm->type == CREASE_REGION_FREEFORM && warm->patch.spline &&
        !warm->patch.round && !warm->patch.ball;
}

static void try_distances(choice *at)
{
    try_splines(at, crease_fit_tube, 4);
    try_splines(at, crease_fit_ball, 3);
}

static bool finish(choice *at)
{
    shift(&at->fitter->best, at->sample->origin, 1.0);
    return at->fitter->best.cost < INFINITY;
}

bool crease_fit_choose(crease_fitter *fitter, const crease_sample *sample, crease_fit_rule rule,
    crease_fit_level level, const crease_model *warm, double limit)
{
    choice at = {.fitter = fitter,
        .sample = sample,
        .rule = rule,
        .level = level,
        .limit = limit,
        .warm = warm};
    begin(&at);
    if (!crease_fit_plane(fitter, sample, &fitter->trial))
        return false;
    compare(&at);
    const double exact = exact_share * (double)sample->count + 4.0 * at.log_count;
    if (level >= CREASE_LEVEL_QUADRATIC && fitter->best.cost > exact) {
        const bool splines = level >= CREASE_LEVEL_ALL && rule != CREASE_RULE_GROWING;
        const bool early = splines && is_spline(warm);
        if (early)
            try_splines(&at, crease_fit_spline, 3);
        try_quadratic(&at, 10);
        if (at.has_quadratic)
            compare(&at);
        if (level >= CREASE_LEVEL_ROUND)
            try_round(&at);
        if (level >= CREASE_LEVEL_SOLIDS)
            try_solids(&at);
        if (splines && !early)
            try_splines(&at, crease_fit_spline, 3);
        if (level >= CREASE_LEVEL_ALL && !at.has_quadratic &&
            (rule == CREASE_RULE_AKAIKE || (warm && (warm->patch.round || warm->patch.ball))))
            try_distances(&at);
    }
    return finish(&at);
}

bool crease_fit_kind(crease_fitter *fitter, const crease_sample *sample, crease_region_type type,
    const crease_model *warm)
{
    choice at = {.fitter = fitter,
        .sample = sample,
        .rule = CREASE_RULE_BAYES,
        .limit = INFINITY,
        .warm = warm};
    begin(&at);
    if (sample->count < 8)
        return false;
    switch (type) {
    case CREASE_REGION_PLANE:
        if (crease_fit_plane(fitter, sample, &fitter->trial))
            compare(&at);
        break;
    case CREASE_REGION_SPHERE:
        try_primitive(&at, crease_guess_sphere(sample, &fitter->trial));
        break;
    case CREASE_REGION_CYLINDER:
        try_quadratic(&at, 12);
        if (better_cylinder(&at))
            compare(&at);
        if (warm && warm->type == CREASE_REGION_CYLINDER)
            try_warm(&at);
        break;
    case CREASE_REGION_CONE:
        try_primitive(&at, crease_guess_cone(sample, &fitter->trial));
        break;
    case CREASE_REGION_TORUS:
        try_primitive(&at, crease_guess_torus(sample, &fitter->trial));
        break;
    case CREASE_REGION_FREEFORM:
        try_quadratic(&at, 12);
        if (at.has_quadratic)
            compare(&at);
        break;
    }
    return finish(&at);
}
