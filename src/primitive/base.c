/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The axis is where the normals of a tube meet, and across which they vary: linear line geometry,
 * first its direction, then its place. The centre of a ball is what all normals pass near to.
 *
 * Based on: Pottmann, Randrup. Rotational and helical surface approximation for reverse
 * engineering. 1998. */
#include "primitive/base.h"

#include "base/symmetric.h"
#include "base/vector.h"
#include "primitive/primitive.h"

#include <math.h>
#include <string.h>

enum { NORMALS_LOOKED_AT = 400 };

static const double steepest_cosine = 0.34; /* between a normal and the direction from the axis */
static const double steep_share = 0.03;     /* of the normals that may be steeper, or face back */
static const double near_axis = 0.2;        /* of the mean distance: there is no place for ... */
static const double near_share = 0.005;     /* ... more than so many of the points */
static const double least_above = 0.02;     /* of the length: what is behind is kept finite */
static const double least_cosine = -0.8;    /* from the middle: 143 degrees */
static const double least_middle = 0.1;     /* mean direction of points all around a centre */
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

/* Normals that point away from an axis or a centre, and towards it. */
typedef struct facing {
    size_t seen, out, in;
} facing;

static void look(facing *at, const double direction[3], const double normal[3])
{
    const double cosine = crease_vector_dot(direction, normal);
    at->seen++;
    at->out += cosine > steepest_cosine;
    at->in += cosine < -steepest_cosine;
}

static bool is_one_way(const facing *at)
{
    return (double)(at->out > at->in ? at->out : at->in) >= (1.0 - steep_share) * (double)at->seen;
}

/* Direction of a point from the axis; returns its distance. */
static double away_from_axis(const crease_sample *sample, size_t i, const double axes[9],
    const double centre[3], double out[3])
{
    crease_sample_from(sample, i, centre, out);
    const double along = crease_vector_dot(out, axes + 6);
    for (int c = 0; c < 3; c++)
        out[c] -= along * axes[6 + c];
    const double distance = crease_vector_length(out);
    crease_vector_normalise(out);
    return distance;
}

/* Whether all points face away from the axis, or all towards it, and none are on it. */
static bool is_around(const crease_sample *sample, const double axes[9], const double centre[3])
{
    const size_t stride = 1 + sample->count / NORMALS_LOOKED_AT;
    facing all = {0};
    double d[3], mean = 0.0;
    size_t near = 0;
    for (size_t i = 0; i < sample->count; i++)
        mean += away_from_axis(sample, i, axes, centre, d) / (double)sample->count;
    for (size_t i = 0; i < sample->count; i++) {
        near += away_from_axis(sample, i, axes, centre, d) < near_axis * mean;
        if (i % stride == 0)
            look(&all, d, sample->normals + 3 * i);
    }
    return is_one_way(&all) && (double)near <= near_share * (double)sample->count;
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

/* ------------------------------------------------------------------------------------- balls -- */

/* The place that the lines along the normals pass nearest to. */
static bool find_middle(const crease_sample *sample, double centre[3])
{
    double mean[3], matrix[9] = {0.0}, right[3] = {0.0};
    crease_sample_mean(sample, mean);
    for (size_t i = 0; i < sample->count; i++) {
        const double *const n = sample->normals + 3 * i;
        double d[3];
        crease_sample_from(sample, i, mean, d);
        const double along = crease_vector_dot(d, n);
        for (size_t r = 0; r < 3; r++) {
            right[r] += d[r] - along * n[r];
            for (size_t c = 0; c <= r; c++)
                matrix[3 * r + c] += (r == c ? 1.0 : 0.0) - n[r] * n[c];
        }
    }
    if (!crease_symmetric_factor(matrix, 3, 3, 2))
        return false;
    crease_symmetric_solve(matrix, 3, 3, 2, right);
    for (int c = 0; c < 3; c++)
        centre[c] = mean[c] + right[c];
    return true;
}

bool crease_ball_frame(const crease_sample *sample, crease_model *model)
{
    double *const z = model->axes + 6, d[3];
    facing all = {0};
    size_t behind = 0;
    if (sample->count == 0 || !find_middle(sample, model->centre))
        return false;
    for (size_t i = 0; i < sample->count; i++) {
        crease_sample_from(sample, i, model->centre, d);
        crease_vector_normalise(d);
        look(&all, d, sample->normals + 3 * i);
        for (int c = 0; c < 3; c++)
            z[c] += d[c] / (double)sample->count;
    }
    if (!is_one_way(&all) || !(crease_vector_length(z) > least_middle))
        return false;
    crease_vector_normalise(z);
    crease_primitive_frame(model->axes);
    for (size_t i = 0; i < sample->count; i++) {
        crease_sample_from(sample, i, model->centre, d);
        crease_vector_normalise(d);
        behind += crease_vector_dot(d, z) < least_cosine;
    }
    return (double)behind <= near_share * (double)sample->count;
}

void crease_ball_project(const double place[3], double out[2])
{
    const double length = crease_vector_length(place);
    const double above = fmax(place[2] + length, least_above * length);
    out[0] = length > 0.0 ? 2.0 * place[0] / above : 0.0;
    out[1] = length > 0.0 ? 2.0 * place[1] / above : 0.0;
}

void crease_ball_direction(const double at[2], double out[3])
{
    const double scale = crease_ball_scale(at);
    out[0] = at[0] * scale;
    out[1] = at[1] * scale;
    out[2] = 2.0 * scale - 1.0;
}

double crease_ball_scale(const double at[2])
{
    return 1.0 / (1.0 + 0.25 * (at[0] * at[0] + at[1] * at[1]));
}
