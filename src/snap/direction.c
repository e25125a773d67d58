/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "base/memory.h"
#include "base/vector.h"
#include "snap/snapping.h"

#include <math.h>
#include <string.h>

static const double NEAR_COSINE = 0.9; /* directions further apart are not compared */

static bool direction_value(void *user, size_t item, size_t leader, crease_value *out)
{
    const crease_snapping *const all = user;
    if (!all->has_axis[item] || !all->has_axis[leader])
        return false;
    const double *const frame = all->bodies[leader].model.axes;
    const double *const axis = all->bodies[item].model.axes + 6;
    const double cosine = crease_vector_dot(axis, frame + 6);
    if (fabs(cosine) < NEAR_COSINE)
        return false;
    double towards[2][3];
    memcpy(towards, frame, sizeof towards);
    const crease_functions tilts = crease_body_tilts(&all->bodies[item], towards);
    crease_body_covariance(&all->bodies[item], &tilts, out->covariance);
    for (int k = 0; k < 2; k++)
        out->at[k] = crease_vector_dot(axis, towards[k]) / cosine;
    return true;
}

static void mean_direction(crease_snapping *all, size_t cluster)
{
    const crease_cluster *const from = &all->directions.items[cluster];
    const double *const frame = all->bodies[from->leader].model.axes;
    double *const axis = all->axis_of[cluster];
    for (int c = 0; c < 3; c++)
        axis[c] = frame[6 + c] + from->mean.at[0] * frame[c] + from->mean.at[1] * frame[3 + c];
    crease_vector_normalise(axis);
}

double crease_snap_turn_squared(const crease_snapping *all, size_t cluster, const double axis[3])
{
    const crease_cluster *const from = &all->directions.items[cluster];
    const double *const frame = all->bodies[from->leader].model.axes;
    const double along = crease_vector_dot(axis, frame + 6);
    const double d[2] = {crease_vector_dot(axis, frame) / along - from->mean.at[0],
        crease_vector_dot(axis, frame + 3) / along - from->mean.at[1]};
    return crease_value_squared(d, from->mean.covariance, 2);
}

/* The nearest direction to a cluster's, by its errors, at a right angle to the one given. */
static bool upright_direction(
    const crease_snapping *all, size_t cluster, const double to[3], double out[3])
{
    const crease_cluster *const from = &all->directions.items[cluster];
    const double *const frame = all->bodies[from->leader].model.axes,
                        *const c = from->mean.covariance;
    const double rise[2] = {crease_vector_dot(frame, to), crease_vector_dot(frame + 3, to)};
    const double level =
        crease_vector_dot(frame + 6, to) + from->mean.at[0] * rise[0] + from->mean.at[1] * rise[1];
    const double follow[2] = {c[0] * rise[0] + c[1] * rise[1], c[1] * rise[0] + c[2] * rise[1]};
    const double variance = rise[0] * follow[0] + rise[1] * follow[1];
    if (!(level * level < CREASE_WITHIN_ERRORS[1] * variance))
        return false;
    for (int k = 0; k < 3; k++)
        out[k] = frame[6 + k] + (from->mean.at[0] - level * follow[0] / variance) * frame[k] +
            (from->mean.at[1] - level * follow[1] / variance) * frame[3 + k];
    crease_vector_normalise(out);
    return true;
}

/* Makes the direction perpendicular to one or two of those before it. */
static void set_upright(crease_snapping *all, size_t cluster)
{
    double *const axis = all->axis_of[cluster];
    int32_t *const to = all->upright[cluster];
    double trial[3];
    to[0] = to[1] = CREASE_NO_CLUSTER;
    for (size_t k = 0; k < cluster; k++) {
        if (all->directions.items[k].size == 0 ||
            !upright_direction(all, cluster, all->axis_of[k], trial))
            continue;
        if (to[0] < 0) {
            memcpy(axis, trial, sizeof trial);
            to[0] = (int32_t)k;
            continue;
        }
        crease_vector_cross(all->axis_of[to[0]], all->axis_of[k], trial);
        if (crease_vector_length(trial) < 0.5)
            continue;
        crease_vector_normalise(trial);
        if (crease_snap_turn_squared(all, cluster, trial) < CREASE_WITHIN_ERRORS[2]) {
            memcpy(axis, trial, sizeof trial);
            to[1] = (int32_t)k;
            return;
        }
    }
}

/* Whether a body may take the direction of its cluster within its own errors. */
static bool may_turn(const crease_snapping *all, size_t body, const double axis[3])
{
    double towards[2][3], covariance[3];
    const double *const frame = all->bodies[body].model.axes;
    memcpy(towards, frame, sizeof towards);
    const crease_functions tilts = crease_body_tilts(&all->bodies[body], towards);
    crease_body_covariance(&all->bodies[body], &tilts, covariance);
    const double along = crease_vector_dot(axis, frame + 6);
    const double d[2] = {
        crease_vector_dot(axis, frame) / along, crease_vector_dot(axis, frame + 3) / along};
    return crease_value_squared(d, covariance, 2) < CREASE_WITHIN_ERRORS[2];
}

static void turn_bodies(crease_snapping *all)
{
    for (size_t i = 0; i < all->count; i++) {
        const int32_t own = all->directions.of[i];
        if (own < 0)
            continue;
        const bool alone = all->directions.items[own].size < 2 && all->upright[own][0] < 0 &&
            all->image_of[own] < 0;
        if (!alone && may_turn(all, i, all->axis_of[own]) &&
            crease_body_turn(&all->bodies[i], all->axis_of[own]))
            all->moved[i] = true;
        else if (!alone) {
            all->directions.items[own].size--;
            all->directions.of[i] = CREASE_NO_CLUSTER;
        }
    }
}

crease_status crease_snap_directions(crease_snapping *all)
{
    crease_status status =
        crease_clusters_find(all->context, all->count, 2, direction_value, all, &all->directions);
    if (status != CREASE_OK)
        return status;
    const size_t count = all->directions.count;
    all->axis_of = crease_allocate(all->context, count, sizeof *all->axis_of);
    all->across = crease_allocate(all->context, count, sizeof *all->across);
    all->upright = crease_allocate(all->context, count, sizeof *all->upright);
    all->image_of = crease_allocate(all->context, count, sizeof *all->image_of);
    if (!all->axis_of || !all->across || !all->upright || !all->image_of)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t k = 0; k < count; k++) {
        mean_direction(all, k);
        set_upright(all, k);
    }
    status = crease_snap_oblique(all);
    for (size_t k = 0; k < count; k++) {
        double frame[9];
        memcpy(frame + 6, all->axis_of[k], sizeof all->axis_of[k]);
        crease_primitive_frame(frame);
        memcpy(all->across[k], frame, sizeof all->across[k]);
    }
    if (status == CREASE_OK)
        turn_bodies(all);
    return status;
}
