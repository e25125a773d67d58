/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Rough primitives: from the distribution of the normals and linear least squares, no iterations.
 *
 * Based on: Pottmann, Wallner. Computational Line Geometry. 2001 (the normals of a surface of
 * revolution meet its axis: a linear line complex). */
#include "primitive/fitter.h"

#include "base/symmetric.h"
#include "base/vector.h"
#include "primitive/primitive.h"

#include <math.h>
#include <string.h>

enum { MOST = 4 };

/* Normal equations of a few unknowns. */
typedef struct equations {
    int n;
    double matrix[MOST * MOST], right[MOST];
} equations;

static void add_row(equations *e, const double *terms, double value)
{
    for (int r = 0; r < e->n; r++) {
        e->right[r] += terms[r] * value;
        for (int c = 0; c <= r; c++)
            e->matrix[r * e->n + c] += terms[r] * terms[c];
    }
}

static bool solve(equations *e)
{
    const size_t n = (size_t)e->n;
    double trace = 0.0;
    for (int r = 0; r < e->n; r++)
        trace += e->matrix[r * (e->n + 1)];
    for (int r = 0; r < e->n; r++)
        e->matrix[r * (e->n + 1)] += 1e-13 * trace;
    if (!crease_symmetric_factor(e->matrix, n, n, n))
        return false;
    crease_symmetric_solve(e->matrix, n, n, n, e->right);
    return true;
}

static void begin(crease_model *model, crease_region_type type)
{
    double *const coefficients = model->patch.coefficients;
    *model = (crease_model){.type = type, .axes = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
    model->patch.coefficients = coefficients;
}

/* |p|^2 = 2 c p + r^2 - c^2, linear in c and the rest. */
bool crease_guess_sphere(const crease_sample *sample, crease_model *model)
{
    double mean[3], d[4];
    equations e = {.n = 4};
    begin(model, CREASE_REGION_SPHERE);
    crease_sample_mean(sample, mean);
    for (size_t i = 0; i < sample->count; i++) {
        crease_sample_from(sample, i, mean, d);
        d[3] = 1.0;
        add_row(&e, d, crease_vector_dot(d, d));
    }
    if (!solve(&e))
        return false;
    for (int c = 0; c < 3; c++)
        model->centre[c] = mean[c] + 0.5 * e.right[c];
    model->radius = sqrt(fmax(e.right[3] + 0.25 * crease_vector_dot(e.right, e.right), 0.0));
    return model->radius > 0.0;
}

/* Centre and radius of the circle around the model's axis, in the plane across it. */
static bool guess_circle(const crease_sample *sample, crease_model *model)
{
    double mean[3], d[3];
    equations e = {.n = 3};
    crease_primitive_frame(model->axes);
    crease_sample_mean(sample, mean);
    for (size_t i = 0; i < sample->count; i++) {
        crease_sample_from(sample, i, mean, d);
        const double x = crease_vector_dot(d, model->axes),
                     y = crease_vector_dot(d, model->axes + 3);
        add_row(&e, (double[]){x, y, 1.0}, x * x + y * y);
    }
    if (!solve(&e))
        return false;
    const double x = 0.5 * e.right[0], y = 0.5 * e.right[1];
    for (int c = 0; c < 3; c++)
        model->centre[c] = mean[c] + x * model->axes[c] + y * model->axes[3 + c];
    model->radius = sqrt(fmax(e.right[2] + x * x + y * y, 0.0));
    return model->radius > 0.0;
}

/* The direction in which the normals, less `mean`, vary least. */
static void least_variation(const crease_sample *sample, const double mean[3], double out[3])
{
    double matrix[6] = {0}, values[3], axes[9];
    for (size_t i = 0; i < sample->count; i++) {
        const double *const n = sample->normals + 3 * i;
        const double d[3] = {n[0] - mean[0], n[1] - mean[1], n[2] - mean[2]};
        crease_symmetric_add(matrix, 1.0, d);
    }
    crease_symmetric_axes(matrix, values, axes);
    memcpy(out, axes, 3 * sizeof *out);
}

bool crease_guess_cylinder(const crease_sample *sample, crease_model *model)
{
    begin(model, CREASE_REGION_CYLINDER);
    least_variation(sample, (double[3]){0}, model->axes + 6);
    return guess_circle(sample, model);
}

bool crease_guess_cylinder_along(
    const crease_sample *sample, const crease_model *polynomial, crease_model *model)
{
    const double *const w = polynomial->patch.coefficients;
    const double xx = w[3], xy = w[4], yy = w[5];
    const double angle = 0.5 * atan2(xy, xx - yy), c = cos(angle), s = sin(angle);
    const double first = xx * c * c + xy * c * s + yy * s * s, second = xx + yy - first;
    const bool turn = fabs(first) > fabs(second);
    begin(model, CREASE_REGION_CYLINDER);
    for (int i = 0; i < 3; i++) {
        const double x = polynomial->axes[i], y = polynomial->axes[3 + i];
        model->axes[6 + i] = turn ? c * y - s * x : c * x + s * y;
    }
    return guess_circle(sample, model);
}

/* The place that all tangent planes pass: the apex, relative to the mean of the points. */
static bool common_place(const crease_sample *sample, const double mean[3], double out[3])
{
    equations e = {.n = 3};
    double d[3];
    for (size_t i = 0; i < sample->count; i++) {
        const double *const n = sample->normals + 3 * i;
        crease_sample_from(sample, i, mean, d);
        add_row(&e, n, crease_vector_dot(n, d));
    }
    if (!solve(&e))
        return false;
    memcpy(out, e.right, 3 * sizeof *out);
    return true;
}

/* Radius and its growth along the axis through the centre, as a line through (along, away). */
static bool fit_slope(const crease_sample *sample, crease_model *model)
{
    equations e = {.n = 2};
    double d[3];
    const double *const axis = model->axes + 6;
    for (size_t i = 0; i < sample->count; i++) {
        crease_sample_from(sample, i, model->centre, d);
        const double along = crease_vector_dot(d, axis);
        const double away2 = crease_vector_dot(d, d) - along * along;
        add_row(&e, (double[]){1.0, along}, sqrt(fmax(away2, 0.0)));
    }
    if (!solve(&e))
        return false;
    model->radius = e.right[0];
    model->shape = e.right[1];
    return model->radius > 0.0 && isfinite(model->shape);
}

/* The normals of a cone lie on a circle: their plane's normal is the axis. */
bool crease_guess_cone(const crease_sample *sample, crease_model *model)
{
    double mean[3], apex[3];
    begin(model, CREASE_REGION_CONE);
    const crease_sample normals = {.count = sample->count, .points = sample->normals};
    crease_sample_mean(&normals, mean);
    least_variation(sample, mean, model->axes + 6);
    crease_primitive_frame(model->axes);
    crease_sample_mean(sample, mean);
    if (!common_place(sample, mean, apex))
        return false;
    const double along = crease_vector_dot(apex, model->axes + 6);
    for (int c = 0; c < 3; c++)
        model->centre[c] = mean[c] + apex[c] - along * model->axes[6 + c];
    return fit_slope(sample, model);
}

/* The axis of a surface of revolution: the direction a and moment b that minimise the sum of
 * (n b + (p x n) a)^2 with |a| = 1, b being eliminated. Lengths in units of `scale`. */
static bool revolution_axis(const crease_sample *sample, const double mean[3], double scale,
    double direction[3], double place[3])
{
    double nn[9] = {0}, nm[9] = {0}, least[6] = {0}, values[3], axes[9], solved[9];
    for (size_t i = 0; i < sample->count; i++) {
        const double *const n = sample->normals + 3 * i;
        double d[3], moment[3];
        crease_sample_from(sample, i, mean, d);
        crease_vector_cross(d, n, moment);
        for (int c = 0; c < 3; c++)
            moment[c] /= scale;
        crease_symmetric_add(least, 1.0, moment);
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 3; c++) {
                nn[3 * r + c] += n[r] * n[c];
                nm[3 * r + c] += n[r] * moment[c];
            }
    }
    const double trace = nn[0] + nn[4] + nn[8];
    for (int r = 0; r < 3; r++)
        nn[4 * r] += 1e-9 * trace;
    if (!crease_symmetric_factor(nn, 3, 3, 3))
        return false;
    for (int c = 0; c < 3; c++) {
        double column[3] = {nm[c], nm[3 + c], nm[6 + c]};
        crease_symmetric_solve(nn, 3, 3, 3, column);
        for (int r = 0; r < 3; r++)
            solved[3 * r + c] = column[r];
    }
    for (int r = 0, entry = 0; r < 3; r++)
        for (int c = r; c < 3; c++, entry++)
            for (int k = 0; k < 3; k++)
                least[entry] -= nm[3 * k + r] * solved[3 * k + c];
    crease_symmetric_axes(least, values, axes);
    memcpy(direction, axes, 3 * sizeof *direction);
    double moment[3], arm[3];
    for (int r = 0; r < 3; r++)
        moment[r] = -crease_vector_dot(solved + 3 * r, direction);
    crease_vector_cross(direction, moment, arm);
    for (int c = 0; c < 3; c++)
        place[c] = mean[c] + scale * arm[c];
    return true;
}

/* In the half-plane (away, along) the tube is a circle. */
bool crease_guess_torus(const crease_sample *sample, crease_model *model)
{
    double mean[3], d[3];
    equations e = {.n = 3};
    begin(model, CREASE_REGION_TORUS);
    crease_sample_mean(sample, mean);
    const double scale = crease_sample_reach(sample, mean);
    if (!(scale > 0.0) || !revolution_axis(sample, mean, scale, model->axes + 6, model->centre))
        return false;
    crease_primitive_frame(model->axes);
    for (size_t i = 0; i < sample->count; i++) {
        crease_sample_from(sample, i, model->centre, d);
        const double along = crease_vector_dot(d, model->axes + 6),
                     square = crease_vector_dot(d, d);
        add_row(&e, (double[]){sqrt(fmax(square - along * along, 0.0)), along, 1.0}, square);
    }
    if (!solve(&e))
        return false;
    const double away = 0.5 * e.right[0], along = 0.5 * e.right[1];
    model->radius = away;
    for (int c = 0; c < 3; c++)
        model->centre[c] += along * model->axes[6 + c];
    model->shape = sqrt(fmax(e.right[2] + away * away + along * along, 0.0));
    return model->radius > 0.0 && model->shape > 0.0;
}
