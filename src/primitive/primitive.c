/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "primitive/primitive.h"

#include "base/simd.h"
#include "base/vector.h"

#include <math.h>
#include <string.h>

/* Cylindrical coordinates of a place around the model's axis: height along it and distance from it,
 * and the unit vector away from it (the frame's x on the axis itself). */
typedef struct around {
    double along, away;
    double outward[3];
} around;

CREASE_INLINE around around_axis(const crease_model *model, const double place[3])
{
    const double *const axis = model->axes + 6;
    double d[3];
    for (int c = 0; c < 3; c++)
        d[c] = place[c] - model->centre[c];
    around at = {.along = crease_vector_dot(d, axis)};
    for (int c = 0; c < 3; c++)
        at.outward[c] = d[c] - at.along * axis[c];
    at.away = crease_vector_length(at.outward);
    for (int c = 0; c < 3; c++)
        at.outward[c] = at.away > 0.0 ? at.outward[c] / at.away : model->axes[c];
    return at;
}

static double plane_distance(const crease_model *model, const double place[3], double gradient[3])
{
    double distance = 0.0;
    for (int c = 0; c < 3; c++) {
        gradient[c] = model->axes[6 + c];
        distance += (place[c] - model->centre[c]) * gradient[c];
    }
    return distance;
}

static double sphere_distance(const crease_model *model, const double place[3], double gradient[3])
{
    const double length = crease_vector_distance(place, model->centre);
    for (int c = 0; c < 3; c++)
        gradient[c] = length > 0.0 ? (place[c] - model->centre[c]) / length : model->axes[6 + c];
    return length - model->radius;
}

/* The radius of a cone grows by `shape` along the axis; a cylinder is a cone of shape 0. */
static double cone_distance(const crease_model *model, const double place[3], double gradient[3])
{
    const around at = around_axis(model, place);
    const double cosine = 1.0 / sqrt(1.0 + model->shape * model->shape);
    for (int c = 0; c < 3; c++)
        gradient[c] = cosine * (at.outward[c] - model->shape * model->axes[6 + c]);
    return cosine * (at.away - model->radius - model->shape * at.along);
}

static double torus_distance(const crease_model *model, const double place[3], double gradient[3])
{
    const around at = around_axis(model, place);
    const double across = at.away - model->radius;
    const double length = sqrt(across * across + at.along * at.along);
    for (int c = 0; c < 3; c++)
        gradient[c] = length > 0.0
            ? (across * at.outward[c] + at.along * model->axes[6 + c]) / length
            : model->axes[6 + c];
    return length - model->shape;
}

double crease_primitive_distance(
    const crease_model *model, const double place[3], double gradient[3])
{
    switch (model->type) {
    case CREASE_REGION_SPHERE:
        return sphere_distance(model, place, gradient);
    case CREASE_REGION_CYLINDER:
    case CREASE_REGION_CONE:
        return cone_distance(model, place, gradient);
    case CREASE_REGION_TORUS:
        return torus_distance(model, place, gradient);
    default:
        return plane_distance(model, place, gradient);
    }
}

/* cone_distance for many places. */
CREASE_VECTORISED static void cone_distances(const crease_model *restrict model,
    const double *restrict places, size_t count, double *restrict distances,
    double *restrict gradients)
{
    const double ox = model->centre[0], oy = model->centre[1], oz = model->centre[2];
    const double ax = model->axes[6], ay = model->axes[7], az = model->axes[8];
    const double ex = model->axes[0], ey = model->axes[1], ez = model->axes[2];
    const double shape = model->shape, radius = model->radius;
    const double cosine = 1.0 / sqrt(1.0 + shape * shape);
    for (size_t i = 0; i < count; i++) {
        const double x = places[3 * i] - ox, y = places[3 * i + 1] - oy, z = places[3 * i + 2] - oz;
        const double along = x * ax + y * ay + z * az;
        const double u = x - along * ax, v = y - along * ay, w = z - along * az;
        const double away = sqrt(u * u + v * v + w * w);
        const double inverse = 1.0 / (away > 0.0 ? away : 1.0);
        gradients[3 * i] = cosine * ((away > 0.0 ? u * inverse : ex) - shape * ax);
        gradients[3 * i + 1] = cosine * ((away > 0.0 ? v * inverse : ey) - shape * ay);
        gradients[3 * i + 2] = cosine * ((away > 0.0 ? w * inverse : ez) - shape * az);
        distances[i] = cosine * (away - radius - shape * along);
    }
}

void crease_primitive_distances(const crease_model *model, const double *places, size_t count,
    double *distances, double *gradients)
{
    if (model->type == CREASE_REGION_CYLINDER || model->type == CREASE_REGION_CONE) {
        cone_distances(model, places, count, distances, gradients);
        return;
    }
    for (size_t i = 0; i < count; i++)
        distances[i] = crease_primitive_distance(model, places + 3 * i, gradients + 3 * i);
}

void crease_primitive_derivatives(const crease_model *model, const double place[3], double distance,
    const double gradient[3], const double pivot[3], double out[CREASE_PRIMITIVE_PARAMETERS])
{
    double lever[3], turn[3];
    for (int c = 0; c < 3; c++)
        lever[c] = place[c] - pivot[c];
    crease_vector_cross(lever, gradient, turn);
    for (int c = 0; c < 3; c++) {
        out[c] = -gradient[c];
        out[3 + c] = model->type == CREASE_REGION_SPHERE ? 0.0 : -turn[c];
    }
    out[6] = model->type == CREASE_REGION_PLANE ? 0.0 : -1.0;
    out[7] = 0.0;
    if (model->type == CREASE_REGION_CONE) {
        const around at = around_axis(model, place);
        const double cosine = 1.0 / sqrt(1.0 + model->shape * model->shape);
        out[6] = -cosine;
        out[7] = -cosine * at.along - distance * model->shape * cosine * cosine;
    } else if (model->type == CREASE_REGION_TORUS) {
        const around at = around_axis(model, place);
        out[6] = -crease_vector_dot(at.outward, gradient);
        out[7] = -1.0;
    }
}

/* Rodrigues' rotation of v by the vector w: its length is the angle. */
static void rotate(double v[3], const double w[3])
{
    const double angle = crease_vector_length(w);
    if (!(angle > 0.0))
        return;
    const double axis[3] = {w[0] / angle, w[1] / angle, w[2] / angle};
    const double c = cos(angle), s = sin(angle), along = crease_vector_dot(axis, v) * (1.0 - c);
    double across[3];
    crease_vector_cross(axis, v, across);
    for (int i = 0; i < 3; i++)
        v[i] = v[i] * c + across[i] * s + axis[i] * along;
}

void crease_primitive_change(
    crease_model *model, const double pivot[3], const double step[CREASE_PRIMITIVE_PARAMETERS])
{
    double arm[3];
    for (int c = 0; c < 3; c++)
        arm[c] = model->centre[c] - pivot[c];
    rotate(arm, step + 3);
    for (int c = 0; c < 3; c++)
        model->centre[c] = pivot[c] + arm[c] + step[c];
    for (int row = 0; row < 3; row++)
        rotate(model->axes + 3 * row, step + 3);
    model->radius += step[6];
    model->shape += step[7];
}

void crease_primitive_frame(double axes[9])
{
    int least = 0;
    for (int c = 1; c < 3; c++)
        if (fabs(axes[6 + c]) < fabs(axes[6 + least]))
            least = c;
    double other[3] = {0};
    other[least] = 1.0;
    crease_vector_cross(axes + 6, other, axes);
    crease_vector_normalise(axes);
    crease_vector_cross(axes + 6, axes, axes + 3);
}
