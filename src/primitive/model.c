/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "primitive/model.h"

#include "base/memory.h"
#include "base/vector.h"
#include "primitive/base.h"
#include "primitive/patch.h"
#include "primitive/primitive.h"

#include <math.h>
#include <stdlib.h>

static const double NEAR_AXIS = 0.1; /* of the distance, where nothing lies */

/* Distance along z times the cosine of the slope. */
static double height_distance(const crease_model *model, const double place[3], double gradient[3])
{
    double d[3], slope[2];
    for (int c = 0; c < 3; c++)
        d[c] = place[c] - model->centre[c];
    const double *const axes = model->axes;
    const double x = crease_vector_dot(d, axes), y = crease_vector_dot(d, axes + 3);
    const double z = crease_vector_dot(d, axes + 6);
    const double height = crease_patch_at(&model->patch, x, y, slope);
    const double cosine = 1.0 / sqrt(1.0 + slope[0] * slope[0] + slope[1] * slope[1]);
    for (int c = 0; c < 3; c++)
        gradient[c] = cosine * (axes[6 + c] - slope[0] * axes[c] - slope[1] * axes[3 + c]);
    return cosine * (z - height);
}

/* Distance away from the axis times the cosine of the slope. */
static double round_distance(const crease_model *model, const double place[3], double gradient[3])
{
    double d[3], slope[2];
    for (int c = 0; c < 3; c++)
        d[c] = place[c] - model->centre[c];
    const double *const axes = model->axes;
    const double x = crease_vector_dot(d, axes), y = crease_vector_dot(d, axes + 3);
    const double z = crease_vector_dot(d, axes + 6), angle = atan2(y, x), away = hypot(x, y);
    const double height = crease_patch_at(&model->patch, angle, z, slope);
    const double around = slope[0] / fmax(away, NEAR_AXIS * fabs(height));
    const double cosine = 1.0 / sqrt(1.0 + around * around + slope[1] * slope[1]);
    const double u = cos(angle) + around * sin(angle), v = sin(angle) - around * cos(angle);
    for (int c = 0; c < 3; c++)
        gradient[c] = cosine * (u * axes[c] + v * axes[3 + c] - slope[1] * axes[6 + c]);
    return cosine * (away - height);
}

/* Distance away from the centre times the cosine of the slope. */
static double ball_distance(const crease_model *model, const double place[3], double gradient[3])
{
    double d[3], local[3], at[2], slope[2], n[3];
    for (int c = 0; c < 3; c++)
        d[c] = place[c] - model->centre[c];
    for (int c = 0; c < 3; c++)
        local[c] = crease_vector_dot(d, model->axes + 3 * (size_t)c);
    crease_ball_project(local, at);
    crease_ball_direction(at, n);
    const double away = crease_vector_length(d), scale = crease_ball_scale(at);
    const double height = crease_patch_at(&model->patch, at[0], at[1], slope);
    const double rise = 1.0 / (scale * fmax(away, NEAR_AXIS * fabs(height)));
    const double u = rise * slope[0], v = rise * slope[1];
    const double cosine = 1.0 / sqrt(1.0 + u * u + v * v);
    /* Unit vectors along the projection's x and y. */
    const double half = 0.5 * scale * (at[0] * u + at[1] * v);
    n[0] -= u - at[0] * half;
    n[1] -= v - at[1] * half;
    n[2] += scale * (at[0] * u + at[1] * v);
    for (int c = 0; c < 3; c++)
        gradient[c] = cosine *
            (n[0] * model->axes[c] + n[1] * model->axes[3 + c] + n[2] * model->axes[6 + c]);
    return cosine * (away - height);
}

double crease_model_distance(const crease_model *model, const double place[3], double gradient[3])
{
    if (model->type != CREASE_REGION_FREEFORM)
        return crease_primitive_distance(model, place, gradient);
    return model->patch.round ? round_distance(model, place, gradient)
        : model->patch.ball   ? ball_distance(model, place, gradient)
                              : height_distance(model, place, gradient);
}

double crease_model_variance(const crease_model *model, const double place[3])
{
    if (model->type == CREASE_REGION_FREEFORM)
        return model->leverage;
    double gradient[3], change[CREASE_PRIMITIVE_PARAMETERS], variance = 0.0;
    const double distance = crease_primitive_distance(model, place, gradient);
    crease_primitive_derivatives(model, place, distance, gradient, model->pivot, change);
    const double *entry = model->covariance;
    for (int r = 0; r < CREASE_PRIMITIVE_PARAMETERS; r++)
        for (int c = 0; c <= r; c++)
            variance += *entry++ * change[r] * change[c] * (r == c ? 1.0 : 2.0);
    return fmax(variance, 0.0);
}

crease_status crease_model_copy(
    crease_context *context, const crease_model *model, crease_model *out)
{
    *out = *model;
    out->patch.coefficients = NULL;
    if (model->type != CREASE_REGION_FREEFORM)
        return CREASE_OK;
    out->patch.coefficients = crease_duplicate(context, model->patch.coefficients,
        model->patch.coefficient_count, sizeof *model->patch.coefficients);
    return out->patch.coefficients ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
}

void crease_model_clear(crease_model *model)
{
    free(model->patch.coefficients);
    model->patch.coefficients = NULL;
}
