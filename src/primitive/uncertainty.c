/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "primitive/uncertainty.h"

#include "base/symmetric.h"
#include "base/vector.h"
#include "primitive/primitive.h"

#include <math.h>

enum { N = CREASE_PRIMITIVE_PARAMETERS };

void crease_model_full_covariance(const crease_model *model, double *out)
{
    const double *entry = model->covariance;
    for (size_t r = 0; r < N; r++)
        for (size_t c = 0; c <= r; c++, entry++)
            out[N * r + c] = out[N * c + r] = *entry;
}

/* Variance of a linear function of the parameters. */
static double variance(const double *full, const double function[N])
{
    double sum = 0.0;
    for (size_t r = 0; r < N; r++)
        for (size_t c = 0; c < N; c++)
            sum += function[r] * full[N * r + c] * function[c];
    return fmax(sum, 0.0);
}

/* How far the model's centre moves along a direction: (t + w x arm) . direction. */
static void place_function(const crease_model *model, const double direction[3], double out[N])
{
    double arm[3], turn[3];
    for (int c = 0; c < 3; c++)
        arm[c] = model->centre[c] - model->pivot[c];
    crease_vector_cross(arm, direction, turn);
    for (int c = 0; c < 3; c++) {
        out[c] = direction[c];
        out[3 + c] = model->type == CREASE_REGION_SPHERE ? 0.0 : turn[c];
    }
    out[6] = out[7] = 0.0;
}

static double place_variance(
    const crease_model *model, const double *full, const double direction[3])
{
    double function[N];
    place_function(model, direction, function);
    return variance(full, function);
}

/* A cone slides along itself when its radius grows: its radius is the one where it was. */
static double radius_variance(const crease_model *model, const double *full)
{
    double function[N] = {0};
    if (model->type == CREASE_REGION_CONE) {
        place_function(model, model->axes + 6, function);
        for (size_t k = 0; k < N; k++)
            function[k] *= -model->shape;
    }
    function[6] = 1.0;
    return variance(full, function);
}

/* A turn about one direction across the axis tilts the axis towards the other. */
static double tilt_variance(const double *full, const double direction[3])
{
    double function[N] = {0};
    for (int c = 0; c < 3; c++)
        function[3 + c] = direction[c];
    return variance(full, function);
}

static crease_uncertainty of_primitive(const crease_model *model)
{
    double full[N * N], place = 0.0, tilt = 0.0;
    const crease_region_type type = model->type;
    crease_model_full_covariance(model, full);
    for (size_t row = 0; row < 3; row++) {
        const double *const direction = model->axes + 3 * row;
        const bool along = row == 2;
        const bool counts = type == CREASE_REGION_PLANE                    ? along
            : type == CREASE_REGION_CYLINDER || type == CREASE_REGION_CONE ? !along
                                                                           : true;
        place += counts ? place_variance(model, full, direction) : 0.0;
        tilt += along || type == CREASE_REGION_SPHERE ? 0.0 : tilt_variance(full, direction);
    }
    return (crease_uncertainty){.place = sqrt(place),
        .direction = sqrt(tilt),
        .radius = type == CREASE_REGION_PLANE ? 0.0 : sqrt(radius_variance(model, full)),
        .shape = type == CREASE_REGION_CONE || type == CREASE_REGION_TORUS
            ? sqrt(fmax(full[(N + 1) * 7], 0.0))
            : 0.0};
}

/* Where a ball between the planes goes while its radius grows by 1: away from both by 1. */
static bool growth(const crease_model *model, const crease_model *const planes[2], double out[3])
{
    double normals[2][3];
    for (int i = 0; i < 2; i++) {
        const double side = crease_model_distance(planes[i], model->centre, normals[i]);
        for (int c = 0; c < 3; c++)
            normals[i][c] = side < 0.0 ? -normals[i][c] : normals[i][c];
    }
    const double cosine = crease_vector_dot(normals[0], normals[1]);
    for (int c = 0; c < 3; c++)
        out[c] = (normals[0][c] + normals[1][c]) / (1.0 + cosine);
    return cosine > -1.0 + 1e-9;
}

/* Of a fillet all parameters follow the radius: along this line through the space of parameters the
 * points say the more. */
static crease_uncertainty of_fillet(const crease_model *model, const crease_model *const planes[2])
{
    crease_uncertainty out = of_primitive(model);
    double full[N * N], line[N] = {0}, solved[N], information = 0.0;
    crease_model_full_covariance(model, full);
    if (!growth(model, planes, line) || !crease_symmetric_factor(full, N, N, N))
        return out;
    line[6] = 1.0;
    for (size_t k = 0; k < N; k++)
        solved[k] = line[k];
    crease_symmetric_solve(full, N, N, N, solved);
    for (size_t k = 0; k < N; k++)
        information += line[k] * solved[k];
    out.radius = 1.0 / sqrt(information);
    out.place = out.radius * crease_vector_length(line);
    const crease_uncertainty first = of_primitive(planes[0]), second = of_primitive(planes[1]);
    out.direction = fmin(out.direction, hypot(first.direction, second.direction));
    return out;
}

crease_uncertainty crease_model_uncertainty(
    const crease_model *model, const crease_model *const planes[2])
{
    if (model->type == CREASE_REGION_FREEFORM)
        return (crease_uncertainty){.place = sqrt(model->leverage)};
    return planes ? of_fillet(model, planes) : of_primitive(model);
}
