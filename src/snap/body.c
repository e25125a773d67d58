/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "snap/body.h"

#include "base/vector.h"
#include "primitive/uncertainty.h"

#include <math.h>
#include <string.h>

enum { N = CREASE_PRIMITIVE_PARAMETERS };

crease_functions crease_body_tilts(const crease_body *body, double towards[2][3])
{
    crease_functions out = {.count = 2};
    for (int k = 0; k < 2; k++)
        crease_vector_cross(body->model.axes + 6, towards[k], out.rows[k] + 3);
    return out;
}

crease_functions crease_body_moves(const crease_body *body, int count, double along[][3])
{
    crease_functions out = {.count = count};
    double arm[3];
    for (int c = 0; c < 3; c++)
        arm[c] = body->model.centre[c] - body->model.pivot[c];
    for (int k = 0; k < count; k++) {
        memcpy(out.rows[k], along[k], 3 * sizeof(double));
        if (body->model.type != CREASE_REGION_SPHERE)
            crease_vector_cross(arm, along[k], out.rows[k] + 3);
    }
    return out;
}

crease_functions crease_body_growth(void)
{
    crease_functions out = {.count = 1};
    out.rows[0][6] = 1.0;
    return out;
}

/* The covariance of all parameters with the functions. */
static void cross_covariance(
    const crease_body *body, const crease_functions *functions, double out[N][2])
{
    for (int r = 0; r < N; r++)
        for (int k = 0; k < 2; k++) {
            out[r][k] = 0.0;
            for (int c = 0; c < N && k < functions->count; c++)
                out[r][k] += body->covariance[N * r + c] * functions->rows[k][c];
        }
}

void crease_body_covariance(
    const crease_body *body, const crease_functions *functions, double out[3])
{
    double cross[N][2], full[2][2] = {{0}};
    cross_covariance(body, functions, cross);
    for (int i = 0; i < functions->count; i++)
        for (int k = 0; k < functions->count; k++)
            for (int c = 0; c < N; c++)
                full[i][k] += functions->rows[i][c] * cross[c][k];
    out[0] = full[0][0];
    out[1] = 0.5 * (full[0][1] + full[1][0]);
    out[2] = full[1][1];
}

/* The gain: how the parameters follow the functions. */
static bool gains(double cross[N][2], const double v[3], int count, double out[N][2])
{
    const double determinant = count == 1 ? v[0] : v[0] * v[2] - v[1] * v[1];
    if (!(v[0] > 0.0 && determinant > 0.0))
        return false;
    for (int r = 0; r < N; r++) {
        out[r][0] = count == 1 ? cross[r][0] / v[0]
                               : (cross[r][0] * v[2] - cross[r][1] * v[1]) / determinant;
        out[r][1] = count == 1 ? 0.0 : (cross[r][1] * v[0] - cross[r][0] * v[1]) / determinant;
    }
    return true;
}

bool crease_body_condition(
    crease_body *body, const crease_functions *functions, const double values[2])
{
    double cross[N][2], variances[3], gain[N][2], step[N];
    cross_covariance(body, functions, cross);
    crease_body_covariance(body, functions, variances);
    if (!gains(cross, variances, functions->count, gain))
        return false;
    for (int r = 0; r < N; r++) {
        step[r] = gain[r][0] * values[0] + (functions->count > 1 ? gain[r][1] * values[1] : 0.0);
        for (int c = 0; c < N; c++)
            body->covariance[N * r + c] -= gain[r][0] * cross[c][0] + gain[r][1] * cross[c][1];
    }
    crease_primitive_change(&body->model, body->model.pivot, step);
    return true;
}

/* Motions that leave the surface as it is are as good as unknown: they are taken to be none. */
static void hold(crease_body *body)
{
    static const double none[2] = {0};
    const crease_region_type type = body->model.type;
    double axes[3][3];
    memcpy(axes, body->model.axes, sizeof axes);
    if (type == CREASE_REGION_PLANE) {
        const crease_functions aside = crease_body_moves(body, 2, axes);
        crease_body_condition(body, &aside, none);
    } else if (type == CREASE_REGION_CYLINDER || type == CREASE_REGION_CONE) {
        const crease_functions along = crease_body_moves(body, 1, axes + 2);
        crease_body_condition(body, &along, none);
    }
    if (type != CREASE_REGION_SPHERE) {
        crease_functions spin = {.count = 1};
        memcpy(spin.rows[0] + 3, axes[2], sizeof axes[2]);
        crease_body_condition(body, &spin, none);
    }
}

crease_body crease_body_of(const crease_model *model)
{
    crease_body body = {.model = *model};
    crease_model_full_covariance(model, body.covariance);
    hold(&body);
    return body;
}

bool crease_body_turn(crease_body *body, const double axis[3])
{
    double target[3];
    crease_model *const model = &body->model;
    const double sign = crease_vector_dot(axis, model->axes + 6) < 0.0 ? -1.0 : 1.0;
    for (int c = 0; c < 3; c++)
        target[c] = sign * axis[c];
    double across[2][3];
    memcpy(across, model->axes, sizeof across);
    const crease_functions tilts = crease_body_tilts(body, across);
    const double values[2] = {
        crease_vector_dot(target, across[0]), crease_vector_dot(target, across[1])};
    if (!crease_body_condition(body, &tilts, values))
        return false;
    memcpy(model->axes + 6, target, sizeof target);
    crease_primitive_frame(model->axes);
    return true;
}

/* The turn from one axis to another near to it, as frames: out takes rows of `from` to those of
 * `to`. */
static void carried_frame(const crease_model *from, const double axis[3], double out[9])
{
    crease_model turned = *from;
    double step[N] = {0};
    crease_vector_cross(from->axes + 6, axis, step + 3);
    const double sine = crease_vector_length(step + 3);
    for (int c = 0; c < 3 && sine > 0.0; c++)
        step[3 + c] *= asin(fmin(sine, 1.0)) / sine;
    crease_primitive_change(&turned, turned.pivot, step);
    memcpy(out, turned.axes, 9 * sizeof *out);
}

/* A vector of the old frame in the new one. */
static void carry(const double old[9], const double new[9], const double v[3], double out[3])
{
    out[0] = out[1] = out[2] = 0.0;
    for (size_t row = 0; row < 3; row++) {
        const double along = crease_vector_dot(old + 3 * row, v);
        for (size_t c = 0; c < 3; c++)
            out[c] += along * new[3 * row + c];
    }
}

/* The covariance as the model has it, carried along with its surface, motions of the surface in
 * itself included. */
static void carry_covariance(crease_model *model, const double old[9], const double new[9])
{
    double full[N * N], turn[N * N] = {0}, half[N * N] = {0};
    crease_model_full_covariance(model, full);
    turn[6 * N + 6] = turn[7 * N + 7] = 1.0;
    for (size_t c = 0; c < 3; c++) {
        double unit[3] = {0}, image[3];
        unit[c] = 1.0;
        carry(old, new, unit, image);
        for (size_t r = 0; r < 3; r++)
            turn[N * r + c] = turn[N * (r + 3) + c + 3] = image[r];
    }
    for (size_t r = 0; r < N; r++)
        for (size_t c = 0; c < N; c++)
            for (size_t k = 0; k < N; k++)
                half[N * r + c] += turn[N * r + k] * full[N * k + c];
    double *entry = model->covariance;
    for (size_t r = 0; r < N; r++)
        for (size_t c = 0; c <= r; c++, entry++) {
            *entry = 0.0;
            for (size_t k = 0; k < N; k++)
                *entry += half[N * r + k] * turn[N * c + k];
        }
}

void crease_body_replace(const crease_body *body, crease_model *model)
{
    double frame[9], arm[3], carried[3];
    carried_frame(model, body->model.axes + 6, frame);
    for (int c = 0; c < 3; c++)
        arm[c] = model->pivot[c] - model->centre[c];
    carry(model->axes, frame, arm, carried);
    carry_covariance(model, model->axes, frame);
    memcpy(model->centre, body->model.centre, sizeof model->centre);
    memcpy(model->axes, body->model.axes, sizeof model->axes);
    model->radius = body->model.radius;
    model->shape = body->model.shape;
    for (int c = 0; c < 3; c++)
        model->pivot[c] = model->centre[c] + carried[c];
}
