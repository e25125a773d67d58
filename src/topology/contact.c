/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/contact.h"

#include "base/vector.h"
#include "primitive/primitive.h"

#include <math.h>

enum { MOST_STEPS = 12, MIDWAY_STEPS = 5 };

/* In spacings. */
static const double SLOPE_STEP = 0.25;
static const double LONGEST = 0.7;
static const double STILL = 1e-9;
static const double ALIKE = 1e-4; /* difference of curvatures, by 1 / spacing */

/* Both surfaces at a place: the second with the sign that makes their gradients agree. */
struct sides {
    double distance[2], gradient[2][3], normal[3]; /* their mean gradient */
};

static bool look(const crease_model *const models[2], const double place[3], struct sides *at)
{
    for (int i = 0; i < 2; i++)
        at->distance[i] = crease_model_distance(models[i], place, at->gradient[i]);
    const bool against = crease_vector_dot(at->gradient[0], at->gradient[1]) < 0.0;
    at->distance[1] = against ? -at->distance[1] : at->distance[1];
    for (int c = 0; c < 3; c++) {
        at->gradient[1][c] = against ? -at->gradient[1][c] : at->gradient[1][c];
        at->normal[c] = at->gradient[0][c] + at->gradient[1][c];
    }
    if (!(crease_vector_length(at->normal) > 1e-9))
        return false;
    crease_vector_normalise(at->normal);
    return true;
}

static void move(double place[3], const double direction[3], double by)
{
    for (int c = 0; c < 3; c++)
        place[c] += by * direction[c];
}

double crease_contact_midway(const crease_model *const models[2], double place[3])
{
    struct sides at = {.distance = {0.0}};
    for (int i = 0; i < MIDWAY_STEPS && look(models, place, &at); i++)
        move(place, at.normal, -0.5 * (at.distance[0] + at.distance[1]));
    return look(models, place, &at) ? fabs(at.distance[0] - at.distance[1]) : INFINITY;
}

/* How the gradients differ along a direction. */
static double difference(const struct sides *at, const double across[3])
{
    return crease_vector_dot(at->gradient[0], across) - crease_vector_dot(at->gradient[1], across);
}

/* One Newton step across the line; its length, 0 where it stops, negative when it fails. */
static double step_across(
    const crease_model *const models[2], const double along[3], double spacing, double place[3])
{
    struct sides at, beside;
    double across[3], probe[3];
    if (!look(models, place, &at))
        return -1.0;
    move(place, at.normal, -0.5 * (at.distance[0] + at.distance[1]));
    crease_vector_cross(at.normal, along, across);
    if (!(crease_vector_length(across) > 1e-9))
        return -1.0;
    crease_vector_normalise(across);
    for (int c = 0; c < 3; c++)
        probe[c] = place[c] + SLOPE_STEP * spacing * across[c];
    if (!look(models, probe, &beside))
        return -1.0;
    const double here = difference(&at, across);
    const double slope = (difference(&beside, across) - here) / (SLOPE_STEP * spacing);
    if (fabs(slope) * spacing < ALIKE)
        return 0.0;
    const double step = fmin(fmax(-here / slope, -LONGEST * spacing), LONGEST * spacing);
    move(place, across, step);
    return fabs(step);
}

bool crease_contact_place(
    const crease_model *const models[2], const double along[3], double spacing, double place[3])
{
    for (int i = 0; i < MOST_STEPS; i++) {
        const double moved = step_across(models, along, spacing, place);
        if (moved < 0.0)
            return false;
        if (moved < STILL * spacing)
            break;
    }
    crease_contact_midway(models, place);
    return true;
}

/* The eigenvector of a symmetric 2 x 2 matrix whose eigenvalue is nearest to 0. */
static bool flattest(double xx, double xy, double yy, double least, double out[2])
{
    const double half = 0.5 * atan2(2.0 * xy, xx - yy);
    const double mean = 0.5 * (xx + yy), spread = hypot(0.5 * (xx - yy), xy);
    const bool second = fabs(mean - spread) < fabs(mean + spread);
    out[0] = second ? -sin(half) : cos(half);
    out[1] = second ? cos(half) : sin(half);
    return fabs(mean) + spread > least;
}

bool crease_contact_direction(
    const crease_model *const models[2], const double place[3], double spacing, double along[3])
{
    double axes[9], change[2][2], share[2];
    struct sides here, beside;
    const double step = SLOPE_STEP * spacing;
    if (!look(models, place, &here))
        return false;
    for (int c = 0; c < 3; c++)
        axes[6 + c] = here.normal[c];
    crease_primitive_frame(axes);
    for (int i = 0; i < 2; i++) {
        double probe[3];
        for (int c = 0; c < 3; c++)
            probe[c] = place[c] + step * axes[3 * i + c];
        if (!look(models, probe, &beside))
            return false;
        for (int k = 0; k < 2; k++)
            change[i][k] =
                (difference(&beside, axes + 3 * k) - difference(&here, axes + 3 * k)) / step;
    }
    const bool found = flattest(
        change[0][0], 0.5 * (change[0][1] + change[1][0]), change[1][1], ALIKE / spacing, share);
    for (int c = 0; c < 3; c++)
        along[c] = share[0] * axes[c] + share[1] * axes[3 + c];
    return found;
}
