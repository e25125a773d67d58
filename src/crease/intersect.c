/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Newton's method on signed distances: where two linearised models meet, the point nearest to the
 * present one lies in the plane of the two gradients. Marching takes such a step after each one
 * along the tangent.
 *
 * Based on: Barnhill, Kersey. A marching method for parametric surface/surface intersection. 1990.
 */
#include "crease/intersect.h"

#include "base/symmetric.h"
#include "base/vector.h"

#include <math.h>
#include <string.h>

enum { MOST_STEPS = 20, MOST_MEETING_STEPS = 30, MOST_HALVINGS = 3 };

static const double LEAST_SINE_SQUARED = 0.002; /* 2.6 degrees between the models */
static const double STILL = 1e-6;               /* share of the reach */
static const double LEAST_COSINE = 0.9;         /* of the turn within one step along the curve */
static const double STRAY = 0.6;                /* share of a step that its correction may have */
static const double WEAK = 0.02; /* eigenvalue, by the largest, of a direction left open */

/* One step onto both; its length, or a negative number where the models touch. */
static double approach(const crease_model *const models[2], double place[3], double tangent[3])
{
    double gradient[2][3], distance[2], moved = 0.0;
    for (int i = 0; i < 2; i++)
        distance[i] = crease_model_distance(models[i], place, gradient[i]);
    const double cosine = crease_vector_dot(gradient[0], gradient[1]);
    const double sine_squared = 1.0 - cosine * cosine;
    if (!(sine_squared >= LEAST_SINE_SQUARED))
        return -1.0;
    const double u = (cosine * distance[1] - distance[0]) / sine_squared;
    const double v = (cosine * distance[0] - distance[1]) / sine_squared;
    for (int c = 0; c < 3; c++) {
        const double step = u * gradient[0][c] + v * gradient[1][c];
        place[c] += step;
        moved += step * step;
    }
    crease_vector_cross(gradient[0], gradient[1], tangent);
    crease_vector_normalise(tangent);
    return sqrt(moved);
}

bool crease_intersection_project(
    const crease_model *const models[2], double reach, double place[3], double tangent[3])
{
    const double start[3] = {place[0], place[1], place[2]};
    for (int i = 0; i < MOST_STEPS; i++) {
        const double moved = approach(models, place, tangent);
        if (!(moved >= 0.0) || !(crease_vector_distance(place, start) <= reach))
            return false;
        if (moved < STILL * reach)
            return true;
    }
    return false;
}

static bool step_by(
    const crease_model *const models[2], double length, double place[3], double tangent[3])
{
    double to[3], direction[3];
    for (int c = 0; c < 3; c++)
        to[c] = place[c] + length * tangent[c];
    if (!crease_intersection_project(models, STRAY * length, to, direction))
        return false;
    const double cosine = crease_vector_dot(direction, tangent);
    if (fabs(cosine) < LEAST_COSINE)
        return false;
    for (int c = 0; c < 3; c++)
        tangent[c] = cosine < 0.0 ? -direction[c] : direction[c];
    memcpy(place, to, sizeof to);
    return true;
}

bool crease_intersection_step(
    const crease_model *const models[2], double longest, double place[3], double tangent[3])
{
    for (int halvings = 0; halvings <= MOST_HALVINGS; halvings++)
        if (step_by(models, ldexp(longest, -halvings), place, tangent))
            return true;
    return false;
}

/* One Gauss-Newton step towards all models; *farthest is the distance before it. */
static double gather(
    const crease_model *const *models, size_t count, double place[3], double *farthest)
{
    double matrix[6] = {0}, right[3] = {0}, values[3], axes[9], step[3] = {0};
    *farthest = 0.0;
    for (size_t i = 0; i < count; i++) {
        double gradient[3];
        const double distance = crease_model_distance(models[i], place, gradient);
        *farthest = fmax(*farthest, fabs(distance));
        crease_symmetric_add(matrix, 1.0, gradient);
        for (int c = 0; c < 3; c++)
            right[c] -= distance * gradient[c];
    }
    crease_symmetric_axes(matrix, values, axes);
    for (int e = 0; e < 3; e++)
        for (int c = 0; c < 3 && values[e] > WEAK * values[2]; c++)
            step[c] += crease_vector_dot(axes + 3 * e, right) / values[e] * axes[3 * e + c];
    for (int c = 0; c < 3; c++)
        place[c] += step[c];
    return crease_vector_length(step);
}

bool crease_intersection_meet(
    const crease_model *const *models, size_t count, double reach, double close, double place[3])
{
    const double start[3] = {place[0], place[1], place[2]};
    double farthest = INFINITY, moved = INFINITY;
    for (int i = 0; i < MOST_MEETING_STEPS && !(moved < STILL * reach); i++) {
        moved = gather(models, count, place, &farthest);
        if (!(crease_vector_distance(place, start) <= reach))
            return false;
    }
    return farthest < close;
}
