/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Height fields by penalised, reweighted least squares over the plane across the mean normal, or
 * around an axis. The residual that counts is the distance across the surface, so heights weigh by
 * the squared cosine of the slope. */
#include "primitive/fitter.h"

#include "base/simd.h"
#include "base/symmetric.h"
#include "base/vector.h"
#include "primitive/base.h"
#include "primitive/patch.h"
#include "primitive/primitive.h"

#include <math.h>
#include <string.h>

enum { ROUNDS = 3, NORMALS_LOOKED_AT = 200, LEAST_AROUND = 4 };

static const double turn = 6.283185307179586476925;
static const double steepest_cosine = 0.34; /* 70 degrees: beyond, a height field is no good */
static const double steep_share = 0.03;     /* of the normals that may be: outliers have any */
static const double BEYOND = 1.0;           /* spacings that a tube goes on beyond its points */
static const double bending = 2e-4;         /* weight of the second differences of a spline */
static const double supported = 0.3; /* sum of a basis function over the points that makes its
                                        coefficient a free parameter */

static bool mean_normal(const crease_sample *sample, double out[3])
{
    const size_t stride = 1 + sample->count / NORMALS_LOOKED_AT;
    size_t seen = 0, steep = 0;
    out[0] = out[1] = out[2] = 0.0;
    for (size_t i = 0; i < sample->count; i++)
        for (size_t c = 0; c < 3; c++)
            out[c] += sample->normals[3 * i + c];
    if (!(crease_vector_length(out) > 0.0))
        return false;
    crease_vector_normalise(out);
    for (size_t i = 0; i < sample->count; i += stride, seen++)
        steep += crease_vector_dot(sample->normals + 3 * i, out) < steepest_cosine;
    return (double)steep <= steep_share * (double)seen;
}

/* z along the mean normal, x along the points' greatest extent across it, the mean as origin. */
static bool choose_frame(const crease_sample *sample, crease_model *model)
{
    double d[3], xx = 0.0, xy = 0.0, yy = 0.0, *const axes = model->axes;
    if (!mean_normal(sample, axes + 6))
        return false;
    crease_primitive_frame(axes);
    crease_sample_mean(sample, model->centre);
    for (size_t i = 0; i < sample->count; i++) {
        crease_sample_from(sample, i, model->centre, d);
        const double x = crease_vector_dot(d, axes), y = crease_vector_dot(d, axes + 3);
        xx += x * x;
        xy += x * y;
        yy += y * y;
    }
    const double angle = 0.5 * atan2(2.0 * xy, xx - yy), c = cos(angle), s = sin(angle);
    for (int k = 0; k < 3; k++) {
        const double x = axes[k], y = axes[3 + k];
        axes[k] = c * x + s * y;
        axes[3 + k] = c * y - s * x;
    }
    return true;
}

/* The points in the frame, and the rectangle they take. */
static void enter_frame(crease_fitter *fitter, const crease_sample *sample, crease_model *model)
{
    double d[3];
    crease_patch *const patch = &model->patch;
    for (int k = 0; k < 2; k++) {
        patch->low[k] = INFINITY;
        patch->high[k] = -INFINITY;
    }
    for (size_t i = 0; i < sample->count; i++) {
        double *const local = fitter->local + 3 * i;
        crease_sample_from(sample, i, model->centre, d);
        for (int k = 0; k < 3; k++)
            local[k] = crease_vector_dot(d, model->axes + 3 * k);
        for (int k = 0; k < 2; k++) {
            patch->low[k] = fmin(patch->low[k], local[k]);
            patch->high[k] = fmax(patch->high[k], local[k]);
        }
        fitter->weights[i] = 1.0;
    }
}

/* Angle, height and distance from the axis of the points in the frame, and the heights they take.
 */
static void enter_tube(crease_fitter *fitter, const crease_sample *sample, crease_model *model)
{
    crease_patch *const patch = &model->patch;
    double away = 0.0, low = INFINITY, high = -INFINITY;
    enter_frame(fitter, sample, model);
    for (size_t i = 0; i < sample->count; i++) {
        double *const local = fitter->local + 3 * i;
        const double x = local[0], y = local[1], angle = atan2(y, x);
        local[0] = angle < 0.0 ? angle + turn : angle;
        local[1] = local[2];
        local[2] = hypot(x, y);
        away += local[2] / (double)sample->count;
        low = fmin(low, local[1]);
        high = fmax(high, local[1]);
    }
    const double beyond = BEYOND * sqrt(turn * away * (high - low) / (double)sample->count);
    patch->low[0] = 0.0;
    patch->high[0] = turn;
    patch->low[1] = low - beyond;
    patch->high[1] = high + beyond;
}

/* The projection of the points' directions, and their distances from the centre. */
static void enter_ball(crease_fitter *fitter, const crease_sample *sample, crease_model *model)
{
    crease_patch *const patch = &model->patch;
    enter_frame(fitter, sample, model);
    for (int k = 0; k < 2; k++) {
        patch->low[k] = INFINITY;
        patch->high[k] = -INFINITY;
    }
    for (size_t i = 0; i < sample->count; i++) {
        double *const local = fitter->local + 3 * i, at[2];
        const double distance = crease_vector_length(local);
        crease_ball_project(local, at);
        for (int k = 0; k < 2; k++) {
            patch->low[k] = fmin(patch->low[k], at[k]);
            patch->high[k] = fmax(patch->high[k], at[k]);
            local[k] = at[k];
        }
        local[2] = distance;
    }
}

/* Half-width of the band of the normal equations. */
static size_t band_of(const crease_patch *patch)
{
    return patch->spline && !patch->round ? 3 * crease_patch_side(patch) + 3
                                          : patch->coefficient_count;
}

/* Where the lower triangle of a matrix has the entry of a row and a column. */
static size_t entry(size_t n, size_t row, size_t column)
{
    return row > column ? n * row + column : n * column + row;
}

static void add_to_polynomial(crease_fitter *fitter, size_t count, const crease_patch *patch)
{
    const size_t n = patch->coefficient_count;
    double terms[CREASE_PATCH_TERMS];
    for (size_t i = 0; i < count; i++) {
        const double *const local = fitter->local + 3 * i;
        crease_patch_terms(patch, local[0], local[1], terms);
        for (size_t r = 0; r < n; r++) {
            const double weighted = fitter->weights[i] * terms[r];
            fitter->right[r] += weighted * local[2];
            for (size_t c = 0; c <= r; c++)
                fitter->matrix[n * r + c] += weighted * terms[c];
        }
    }
}

/* Adds a point: blocks of four by four to the matrix, one for each two of the splines of x. Those
 * on the diagonal also fill what is above it, which nobody reads. */
CREASE_VECTORISED static void add_cell(
    const crease_cell *cell, double weight, double height, crease_fitter *fitter, size_t n)
{
    const crease_four y = *(const crease_four *)cell->y;
    for (size_t a = 0; a < 4; a++) {
        const double weighted = weight * cell->x[a];
        *(crease_four *)(fitter->right + cell->first[a]) += weighted * height * y;
        *(crease_four *)(fitter->support + cell->first[a]) += cell->x[a] * y;
        for (size_t b = 0; b <= a; b++) {
            const bool below = cell->first[a] >= cell->first[b];
            const size_t row = cell->first[below ? a : b], column = cell->first[below ? b : a];
            const crease_four both = weighted * cell->x[b] * y;
            double *const block = fitter->matrix + n * row + column;
            for (size_t r = 0; r < 4; r++)
                *(crease_four *)(block + n * r) += cell->y[r] * both;
        }
    }
}

static void add_to_spline(crease_fitter *fitter, size_t count, const crease_patch *patch)
{
    crease_cell cell;
    for (size_t i = 0; i < count; i++) {
        const double *const local = fitter->local + 3 * i;
        crease_patch_cell(patch, local[0], local[1], &cell);
        add_cell(&cell, fitter->weights[i], local[2], fitter, patch->coefficient_count);
    }
}

static void add_points(crease_fitter *fitter, size_t count, const crease_patch *patch)
{
    const size_t n = patch->coefficient_count;
    memset(fitter->matrix, 0, n * n * sizeof *fitter->matrix);
    memset(fitter->right, 0, n * sizeof *fitter->right);
    memset(fitter->support, 0, n * sizeof *fitter->support);
    if (patch->spline)
        add_to_spline(fitter, count, patch);
    else
        add_to_polynomial(fitter, count, patch);
}

/* Adds weight (a - 2 b + c)^2 for three coefficients. */
static void add_difference(double *matrix, size_t n, const size_t of[3], double weight)
{
    static const double share[3] = {1.0, -2.0, 1.0};
    for (size_t r = 0; r < 3; r++)
        for (size_t c = 0; c <= r; c++)
            matrix[entry(n, of[r], of[c])] += weight * share[r] * share[c];
}

/* Second differences in both directions, lightly: they define coefficients without data. */
static void add_penalty(crease_fitter *fitter, size_t count, const crease_patch *patch)
{
    const size_t side = crease_patch_side(patch), n = patch->coefficient_count, rows = n / side;
    const size_t ends = patch->round ? 0 : 2; /* rows that no difference begins at */
    const double weight = bending * (double)count / (patch->spans * patch->spans);
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j + 2 < side; j++) {
            const size_t at = i * side + j;
            add_difference(fitter->matrix, n, (size_t[]){at, at + 1, at + 2}, weight);
        }
    for (size_t i = 0; i + ends < rows; i++)
        for (size_t j = 0; j < side; j++)
            add_difference(fitter->matrix, n,
                (size_t[]){i * side + j, (i + 1) % rows * side + j, (i + 2) % rows * side + j},
                weight);
}

static bool solve(crease_fitter *fitter, const crease_patch *patch)
{
    const size_t n = patch->coefficient_count, band = band_of(patch);
    double trace = 0.0;
    for (size_t k = 0; k < n; k++)
        trace += fitter->matrix[(n + 1) * k];
    for (size_t k = 0; k < n; k++)
        fitter->matrix[(n + 1) * k] += 1e-10 * trace / (double)n;
    if (!crease_symmetric_factor(fitter->matrix, n, n, band))
        return false;
    crease_symmetric_solve(fitter->matrix, n, n, band, fitter->right);
    memcpy(patch->coefficients, fitter->right, n * sizeof *fitter->right);
    return true;
}

/* Squared cosine of the angle between the surface at a point and what it is a height over. */
static double squared_cosine(
    const crease_patch *patch, const double local[3], const double slope[2], double least)
{
    double across = slope[0], up = slope[1];
    const double away = fmax(local[2], least);
    if (patch->round)
        across /= away;
    if (patch->ball) {
        across /= crease_ball_scale(local) * away;
        up /= crease_ball_scale(local) * away;
    }
    return 1.0 / (1.0 + across * across + up * up);
}

static void reweight(crease_fitter *fitter, size_t count, const crease_patch *patch)
{
    double slope[2];
    const double least = 1e-9 * (patch->high[1] - patch->low[1]);
    for (size_t i = 0; i < count; i++) {
        const double *const local = fitter->local + 3 * i;
        const double value = crease_patch_at(patch, local[0], local[1], slope);
        const double cosine2 = squared_cosine(patch, local, slope, least);
        fitter->residuals[0][i] = (local[2] - value) * sqrt(cosine2);
        fitter->weights[i] = cosine2;
    }
    const double scale = crease_fit_scale(fitter, fitter->residuals[0], count);
    for (size_t i = 0; i < count; i++)
        fitter->weights[i] *= crease_fit_weight(fitter->residuals[0][i], scale);
}

static bool fit(crease_fitter *fitter, const crease_sample *sample, crease_model *model)
{
    crease_patch *const patch = &model->patch;
    for (int round = 0; round < ROUNDS; round++) {
        add_points(fitter, sample->count, patch);
        if (patch->spline)
            add_penalty(fitter, sample->count, patch);
        if (!solve(fitter, patch))
            return false;
        if (round + 1 < ROUNDS)
            reweight(fitter, sample->count, patch);
    }
    model->parameter_count = 0.0;
    for (size_t k = 0; k < patch->coefficient_count; k++)
        model->parameter_count += !patch->spline || fitter->support[k] > supported;
    return true;
}

static bool begin(crease_fitter *fitter, const crease_sample *sample, crease_model *model)
{
    double *const coefficients = model->patch.coefficients;
    *model = (crease_model){.type = CREASE_REGION_FREEFORM};
    model->patch.coefficients = coefficients;
    if (sample->count < 6 || !choose_frame(sample, model))
        return false;
    enter_frame(fitter, sample, model);
    return model->patch.high[0] > model->patch.low[0] && model->patch.high[1] > model->patch.low[1];
}

bool crease_fit_polynomial(
    crease_fitter *fitter, const crease_sample *sample, int degree, crease_model *model)
{
    if (!begin(fitter, sample, model))
        return false;
    crease_patch *const patch = &model->patch;
    patch->degree = degree;
    patch->coefficient_count = (size_t)((degree + 1) * (degree + 2) / 2);
    patch->unit[0] = patch->unit[1] =
        0.5 * fmax(patch->high[0] - patch->low[0], patch->high[1] - patch->low[1]);
    return fit(fitter, sample, model);
}

/* Fits distances over a base whose rectangle of data is known. */
static bool fit_distances(
    crease_fitter *fitter, const crease_sample *sample, int spans, crease_model *model)
{
    crease_patch *const patch = &model->patch;
    if (!(patch->high[0] > patch->low[0] && patch->high[1] > patch->low[1]))
        return false;
    patch->spline = true;
    patch->spans = spans;
    const size_t side = crease_patch_side(patch);
    patch->coefficient_count = (patch->round ? (size_t)spans : side) * side;
    for (int k = 0; k < 2; k++)
        patch->unit[k] = (patch->high[k] - patch->low[k]) / spans;
    return fit(fitter, sample, model);
}

bool crease_fit_tube(
    crease_fitter *fitter, const crease_sample *sample, int spans, crease_model *model)
{
    double *const coefficients = model->patch.coefficients;
    *model = (crease_model){.type = CREASE_REGION_FREEFORM};
    model->patch.coefficients = coefficients;
    if (spans < LEAST_AROUND || !crease_tube_frame(sample, model))
        return false;
    model->patch.round = true;
    enter_tube(fitter, sample, model);
    return fit_distances(fitter, sample, spans, model);
}

bool crease_fit_ball(
    crease_fitter *fitter, const crease_sample *sample, int spans, crease_model *model)
{
    double *const coefficients = model->patch.coefficients;
    *model = (crease_model){.type = CREASE_REGION_FREEFORM};
    model->patch.coefficients = coefficients;
    if (!crease_ball_frame(sample, model))
        return false;
    model->patch.ball = true;
    enter_ball(fitter, sample, model);
    return fit_distances(fitter, sample, spans, model);
}

bool crease_fit_spline(
    crease_fitter *fitter, const crease_sample *sample, int spans, crease_model *model)
{
    if (!begin(fitter, sample, model))
        return false;
    crease_patch *const patch = &model->patch;
    patch->spline = true;
    patch->spans = spans;
    patch->coefficient_count = crease_patch_side(patch) * crease_patch_side(patch);
    for (int k = 0; k < 2; k++)
        patch->unit[k] = (patch->high[k] - patch->low[k]) / spans;
    return fit(fitter, sample, model);
}
