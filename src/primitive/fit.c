/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Primitives by least squares of the true distances.
 *
 * Planes: reweighted main axes. The others: Levenberg-Marquardt over a rigid motion about the mean
 * of the points, the radius and the shape. Motions that leave a primitive where it is (along or
 * about a cylinder's axis) have zero derivatives; a tiny ridge keeps the equations solvable and
 * these motions at zero.
 *
 * Based on: Lukacs, Martin, Marshall. Faithful least-squares fitting of spheres, cylinders, cones
 * and tori for reliable segmentation. 1998. */
#include "primitive/fitter.h"

#include "base/simd.h"
#include "base/symmetric.h"
#include "base/vector.h"
#include "primitive/primitive.h"

#include <math.h>
#include <string.h>

enum {
    N = CREASE_PRIMITIVE_PARAMETERS,
    PLANE_ROUNDS = 4,
    MOST_ROUNDS = 25,
    MOST_TRIES = 6,
    LANES = 4
};

static const double flattest = 100.0; /* radius over size of the points: beyond, it is a plane */
static const double steepest = 20.0;  /* growth of a cone's radius */
static const double most_turn = 0.5;  /* radians in one step */

/* ------------------------------------------------------------------------------------- plane -- */

static void plane_residuals(
    const crease_sample *sample, const crease_model *model, double *residuals)
{
    double d[3];
    for (size_t i = 0; i < sample->count; i++) {
        crease_sample_from(sample, i, model->centre, d);
        residuals[i] = crease_vector_dot(d, model->axes + 6);
    }
}

/* Main axes of the weighted points about their weighted mean, the normal last. */
static void weighted_plane(const crease_sample *sample, const double *weights, crease_model *model)
{
    double total = 0.0, matrix[6] = {0}, values[3], axes[9], d[3];
    double *const mean = model->centre;
    mean[0] = mean[1] = mean[2] = 0.0;
    for (size_t i = 0; i < sample->count; i++) {
        total += weights[i];
        for (size_t c = 0; c < 3; c++)
            mean[c] += weights[i] * sample->points[3 * i + c];
    }
    for (int c = 0; c < 3; c++)
        mean[c] /= total;
    for (size_t i = 0; i < sample->count; i++) {
        crease_sample_from(sample, i, mean, d);
        crease_symmetric_add(matrix, weights[i], d);
    }
    crease_symmetric_axes(matrix, values, axes);
    for (size_t row = 0; row < 3; row++)
        memcpy(model->axes + 3 * row, axes + 3 * (2 - row), 3 * sizeof *axes);
}

/* Turns the normal to the side of the sample's normals, and keeps the frame right-handed. */
static void orient_plane(const crease_sample *sample, crease_model *model)
{
    double agreement = 0.0;
    for (size_t i = 0; i < sample->count; i++)
        agreement += crease_vector_dot(sample->normals + 3 * i, model->axes + 6);
    for (int c = 0; c < 3 && agreement < 0.0; c++)
        model->axes[6 + c] = -model->axes[6 + c];
    crease_vector_cross(model->axes + 6, model->axes, model->axes + 3);
}

bool crease_fit_plane(crease_fitter *fitter, const crease_sample *sample, crease_model *model)
{
    double *const coefficients = model->patch.coefficients;
    *model = (crease_model){.type = CREASE_REGION_PLANE, .parameter_count = 3.0};
    model->patch.coefficients = coefficients;
    if (sample->count < 3)
        return false;
    for (size_t i = 0; i < sample->count; i++)
        fitter->weights[i] = 1.0;
    for (int round = 0; round < PLANE_ROUNDS; round++) {
        weighted_plane(sample, fitter->weights, model);
        plane_residuals(sample, model, fitter->residuals[0]);
        const double scale = crease_fit_scale(fitter, fitter->residuals[0], sample->count);
        for (size_t i = 0; i < sample->count; i++)
            fitter->weights[i] = crease_fit_weight(fitter->residuals[0][i], scale);
    }
    orient_plane(sample, model);
    return true;
}

/* ---------------------------------------------------------------------- Levenberg-Marquardt -- */

typedef struct search {
    crease_fitter *fitter;
    const crease_sample *sample;
    double pivot[3], size; /* mean of the points, largest distance from it */
    double scale;          /* of the residuals */
    double damping;
    double cost;
    double matrix[N * N], right[N];
} search;

/* Residuals and gradients into set 0 (present) or 1 (on trial); returns the robust cost. */
static double measure(const search *at, const crease_model *model, int set)
{
    double *const residuals = at->fitter->residuals[set], sums[LANES] = {0.0}, cost = 0.0;
    const size_t count = at->sample->count;
    const double unit = 1.0 / (9.0 * at->scale * at->scale);
    crease_primitive_distances(
        model, at->sample->points, count, residuals, at->fitter->gradients[set]);
    for (size_t i = 0; i < count; i++) {
        const double t = residuals[i] * residuals[i] * unit;
        sums[i % LANES] += t / (1.0 + t);
    }
    for (size_t k = 0; k < LANES; k++)
        cost += sums[k];
    return cost;
}

static void exchange_sets(crease_fitter *fitter)
{
    double *const residuals = fitter->residuals[0], *const gradients = fitter->gradients[0];
    fitter->residuals[0] = fitter->residuals[1];
    fitter->gradients[0] = fitter->gradients[1];
    fitter->residuals[1] = residuals;
    fitter->gradients[1] = gradients;
}

/* Adds weight times the products of a row with itself and with a residual. */
CREASE_VECTORISED static void add_row(
    const double change[N], double weight, double residual, double *matrix, double *right)
{
    const crease_four low = *(const crease_four *)change, high = *(const crease_four *)(change + 4);
    *(crease_four *)right -= weight * residual * low;
    *(crease_four *)(right + 4) -= weight * residual * high;
    for (int r = 0; r < N; r++) {
        const double factor = weight * change[r];
        *(crease_four *)(matrix + N * r) += factor * low;
        *(crease_four *)(matrix + N * r + 4) += factor * high;
    }
}

/* Normal equations of the weighted residuals, linear in a small change. */
static void assemble(search *at, const crease_model *model)
{
    double change[N];
    memset(at->matrix, 0, sizeof at->matrix);
    memset(at->right, 0, sizeof at->right);
    for (size_t i = 0; i < at->sample->count; i++) {
        const double residual = at->fitter->residuals[0][i];
        crease_primitive_derivatives(model, at->sample->points + 3 * i, residual,
            at->fitter->gradients[0] + 3 * i, at->pivot, change);
        add_row(change, crease_fit_weight(residual, at->scale), residual, at->matrix, at->right);
    }
}

/* The part of the ridge that is always there, in the units of each parameter. */
static double least_ridge(const search *at, const crease_model *model, int parameter)
{
    const bool angle =
        (parameter >= 3 && parameter < 6) || (parameter == 7 && model->type == CREASE_REGION_CONE);
    return 1e-9 * (double)at->sample->count * (angle ? at->size * at->size : 1.0);
}

static bool damped_step(const search *at, const crease_model *model, double step[N])
{
    double matrix[N * N];
    memcpy(matrix, at->matrix, sizeof matrix);
    memcpy(step, at->right, sizeof at->right);
    for (int k = 0; k < N; k++)
        matrix[(N + 1) * k] += at->damping * at->matrix[(N + 1) * k] + least_ridge(at, model, k);
    if (!crease_symmetric_factor(matrix, N, N, N))
        return false;
    crease_symmetric_solve(matrix, N, N, N, step);
    const double turn = crease_vector_length(step + 3);
    for (int k = 0; k < N && turn > most_turn; k++)
        step[k] *= most_turn / turn;
    return true;
}

/* Tries steps of growing damping until one lowers the cost. Returns whether it pays to go on. */
static bool improve(search *at, crease_model *model)
{
    double step[N];
    for (int tries = 0; tries < MOST_TRIES; tries++) {
        if (!damped_step(at, model, step)) {
            at->damping = 10.0 * at->damping + 1e-6;
            continue;
        }
        crease_model trial = *model;
        crease_primitive_change(&trial, at->pivot, step);
        const double cost = measure(at, &trial, 1);
        if (cost < at->cost) {
            const double gain = (at->cost - cost) / at->cost;
            *model = trial;
            at->cost = cost;
            at->damping *= 0.2;
            exchange_sets(at->fitter);
            return gain > 1e-5;
        }
        at->damping = 10.0 * at->damping + 1e-9;
    }
    return false;
}

/* The point of the axis beside the data stands for the axis; a cone's radius is the one there. */
static void settle(const search *at, crease_model *model)
{
    double d[3];
    if (model->type == CREASE_REGION_CYLINDER || model->type == CREASE_REGION_CONE) {
        for (int c = 0; c < 3; c++)
            d[c] = at->pivot[c] - model->centre[c];
        const double along = crease_vector_dot(d, model->axes + 6);
        for (int c = 0; c < 3; c++)
            model->centre[c] += along * model->axes[6 + c];
        model->radius += along * model->shape;
    }
    crease_vector_normalise(model->axes + 6);
    crease_primitive_frame(model->axes);
}

static bool is_plausible(const search *at, const crease_model *model)
{
    if (!(model->radius > 0.0) || model->radius > flattest * at->size)
        return false;
    if (model->type == CREASE_REGION_TORUS)
        return model->shape > 0.0 && model->radius >= 0.5 * model->shape;
    return fabs(model->shape) <= steepest;
}

bool crease_fit_primitive(crease_fitter *fitter, const crease_sample *sample, crease_model *model)
{
    static const double cost_of_kind[] = {3.0, 4.5, 5.0, 6.0, 9.0};
    search at = {.fitter = fitter, .sample = sample, .scale = fitter->sigma, .damping = 1e-3};
    crease_sample_mean(sample, at.pivot);
    at.size = crease_sample_reach(sample, at.pivot);
    if (!(at.size > 0.0) || !isfinite(measure(&at, model, 0)))
        return false;
    at.scale = crease_fit_scale(fitter, fitter->residuals[0], sample->count);
    at.cost = measure(&at, model, 0);
    for (int round = 0; round < MOST_ROUNDS; round++) {
        assemble(&at, model);
        if (!improve(&at, model))
            break;
        const double scale = crease_fit_scale(fitter, fitter->residuals[0], sample->count);
        if (scale < 0.8 * at.scale) {
            at.scale = scale;
            at.cost = measure(&at, model, 0);
        }
    }
    settle(&at, model);
    model->parameter_count = cost_of_kind[model->type];
    return is_plausible(&at, model);
}

/* -------------------------------------------------------------------------------- covariance -- */

/* Inverse of the normal equations times the noise, which the residuals may raise. */
static void primitive_covariance(search *at, crease_model *model)
{
    double squares = 0.0, total = 0.0, *entry = model->covariance;
    assemble(at, model);
    for (size_t i = 0; i < at->sample->count; i++) {
        const double residual = at->fitter->residuals[0][i];
        const double weight = crease_fit_weight(residual, at->scale);
        squares += weight * residual * residual;
        total += weight;
    }
    const double noise = fmax(at->fitter->sigma * at->fitter->sigma, squares / total);
    for (int k = 0; k < N; k++)
        at->matrix[(N + 1) * k] += least_ridge(at, model, k);
    if (!crease_symmetric_factor(at->matrix, N, N, N))
        return;
    for (int r = 0; r < N; r++) {
        double column[N] = {0};
        column[r] = noise;
        crease_symmetric_solve(at->matrix, N, N, N, column);
        for (int c = 0; c <= r; c++)
            *entry++ = column[c];
    }
}

void crease_fit_covariance(
    const crease_fitter *fitter, const crease_sample *sample, crease_model *model)
{
    const double count = (double)sample->count;
    if (model->type == CREASE_REGION_FREEFORM) {
        const double noise = fitter->sigma * fitter->sigma * fmax(model->chi, 1.0);
        model->leverage = noise * fmin(model->parameter_count / count, 1.0);
        return;
    }
    crease_fitter own = *fitter;
    crease_model local = *model;
    search at = {.fitter = &own, .sample = sample, .scale = fitter->sigma};
    crease_sample_mean(sample, at.pivot);
    at.size = crease_sample_reach(sample, at.pivot);
    for (int c = 0; c < 3; c++) {
        local.centre[c] -= sample->origin[c];
        model->pivot[c] = at.pivot[c] + sample->origin[c];
    }
    measure(&at, &local, 0);
    at.scale = crease_fit_scale(fitter, own.residuals[0], sample->count);
    primitive_covariance(&at, &local);
    memcpy(model->covariance, local.covariance, sizeof local.covariance);
}
