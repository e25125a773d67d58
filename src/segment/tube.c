/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The axis is where the normals of a tube meet, and across which they vary: linear line geometry,
 * first its direction, then its place.
 *
 * Based on: Pottmann, Randrup. Rotational and helical surface approximation for reverse
 * engineering. 1998. */
#include "segment/tube.h"

#include "base/symmetric.h"
#include "base/vector.h"
#include "segment/primitive.h"

#include <math.h>
#include <string.h>

enum { NORMALS_LOOKED_AT = 400 };

static const double steepest_cosine = 0.34; /* between a normal and the direction from the axis */
static const double steep_share = 0.03;     /* of the normals that may be steeper, or face back */
static const double least_turn = 0.02;      /* of the normals across the axis: their variance */

/* The direction in which the normals vary least. */
static bool find_direction(const crease_sample *sample, double axes[9])
{
    double mean[3] = {0.0}, matrix[6] = {0.0}, values[3], found[9];
    for (size_t i = 0; i < sample->count; i++)
        for (size_t c = 0; c < 3; c++)
            mean[c] += sample->normals[3 * i + c] / (double)sample->count;
    for (size_t i = 0; i < sample->count; i++) {
        double d[3];
        for (size_t c = 0; c < 3; c++)
            d[c] = sample->normals[3 * i + c] - mean[c];
        crease_symmetric_add(matrix, 1.0 / (double)sample->count, d);
    }
    crease_symmetric_axes(matrix, values, found);
    memcpy(axes + 6, found, 3 * sizeof *axes);
    crease_primitive_frame(axes);
    return values[1] > least_turn;
}

/* The place across the axis that the lines along the normals pass nearest to. */
static bool find_centre(const crease_sample *sample, const double axes[9], double centre[3])
{
    double mean[3], xx = 0.0, xy = 0.0, yy = 0.0, right[2] = {0.0};
    crease_sample_mean(sample, mean);
    for (size_t i = 0; i < sample->count; i++) {
        double d[3], across[3];
        crease_sample_from(sample, i, mean, d);
        crease_vector_cross(axes + 6, sample->normals + 3 * i, across);
        const double x = crease_vector_dot(across, axes), y = crease_vector_dot(across, axes + 3);
        const double offset = crease_vector_dot(d, across);
        xx += x * x;
        xy += x * y;
        yy += y * y;
        right[0] += x * offset;
        right[1] += y * offset;
    }
    const double determinant = xx * yy - xy * xy;
    if (!(determinant > 1e-6 * (xx + yy) * (xx + yy)))
        return false;
    const double x = (yy * right[0] - xy * right[1]) / determinant;
    const double y = (xx * right[1] - xy * right[0]) / determinant;
    for (int c = 0; c < 3; c++)
        centre[c] = mean[c] + x * axes[c] + y * axes[3 + c];
    return true;
}

/* Whether all points face away from the axis, or all towards it. */
static bool is_around(const crease_sample *sample, const double axes[9], const double centre[3])
{
    const size_t stride = 1 + sample->count / NORMALS_LOOKED_AT;
    size_t seen = 0, out = 0, in = 0;
    for (size_t i = 0; i < sample->count; i += stride, seen++) {
        double d[3];
        crease_sample_from(sample, i, centre, d);
        const double along = crease_vector_dot(d, axes + 6);
        for (int c = 0; c < 3; c++)
            d[c] -= along * axes[6 + c];
        crease_vector_normalise(d);
        const double cosine = crease_vector_dot(d, sample->normals + 3 * i);
        out += cosine > steepest_cosine;
        in += cosine < -steepest_cosine;
    }
    return (double)(out > in ? out : in) >= (1.0 - steep_share) * (double)seen;
}

bool crease_tube_frame(const crease_sample *sample, crease_model *model)
{
    if (!find_direction(sample, model->axes))
        return false;
    if (find_centre(sample, model->axes, model->centre) &&
        is_around(sample, model->axes, model->centre))
        return true;
    crease_sample_mean(sample, model->centre);
    return is_around(sample, model->axes, model->centre);
}
