/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "base/vector.h"
#include "snap/snapping.h"

static bool is_round(const crease_snapping *all, size_t item)
{
    const crease_region_type type = all->bodies[item].model.type;
    return all->takes_part[item] && type != CREASE_REGION_PLANE && type != CREASE_REGION_SPHERE &&
        all->directions.of[item] >= 0;
}

/* The place of an axis, seen along it. */
static bool axis_value(void *user, size_t item, size_t leader, crease_value *out)
{
    const crease_snapping *const all = user;
    if (!is_round(all, item) || !is_round(all, leader) ||
        all->directions.of[item] != all->directions.of[leader] || !all->moved[item])
        return false;
    double(*const across)[3] = all->across[all->directions.of[item]];
    const crease_functions moves = crease_body_moves(&all->bodies[item], 2, across);
    crease_body_covariance(&all->bodies[item], &moves, out->covariance);
    for (int k = 0; k < 2; k++)
        out->at[k] = crease_vector_dot(all->bodies[item].model.centre, across[k]);
    return true;
}

crease_status crease_snap_axes(crease_snapping *all)
{
    const crease_status status =
        crease_clusters_find(all->context, all->count, 2, axis_value, all, &all->axes);
    for (size_t i = 0; i < all->count && status == CREASE_OK; i++) {
        const int32_t own = all->axes.of[i];
        crease_value value;
        if (own < 0 || all->axes.items[own].size < 2 || !axis_value(all, i, i, &value))
            continue;
        const double *const mean = all->axes.items[own].mean.at;
        const double by[2] = {mean[0] - value.at[0], mean[1] - value.at[1]};
        double(*const across)[3] = all->across[all->directions.of[i]];
        const crease_functions moves = crease_body_moves(&all->bodies[i], 2, across);
        if (!crease_body_condition(&all->bodies[i], &moves, by)) {
            all->axes.items[own].size--;
            all->axes.of[i] = CREASE_NO_CLUSTER;
        }
    }
    return status;
}

/* Radii of spheres, and of parallel cylinders that do not cross. */
static bool radius_value(void *user, size_t item, size_t leader, crease_value *out)
{
    const crease_snapping *const all = user;
    const crease_model *const a = &all->bodies[item].model, *const b = &all->bodies[leader].model;
    if (!all->takes_part[item] || !all->takes_part[leader] || a->type != b->type ||
        (a->type != CREASE_REGION_SPHERE && a->type != CREASE_REGION_CYLINDER))
        return false;
    if (a->type == CREASE_REGION_CYLINDER) {
        const int32_t direction = all->directions.of[item];
        if (direction < 0 || direction != all->directions.of[leader])
            return false;
        const int32_t axis = all->axes.of[item];
        const bool coaxial = axis >= 0 && axis == all->axes.of[leader];
        double d[3], beside[3];
        for (int c = 0; c < 3; c++)
            d[c] = a->centre[c] - b->centre[c];
        crease_vector_cross(d, a->axes + 6, beside);
        if (item != leader && !coaxial && crease_vector_length(beside) < a->radius + b->radius)
            return false;
    }
    const crease_functions growth = crease_body_growth();
    crease_body_covariance(&all->bodies[item], &growth, out->covariance);
    out->at[0] = a->radius;
    out->at[1] = 0.0;
    return true;
}

crease_status crease_snap_radii(crease_snapping *all)
{
    const crease_status status =
        crease_clusters_find(all->context, all->count, 1, radius_value, all, &all->radii);
    for (size_t i = 0; i < all->count && status == CREASE_OK; i++) {
        const int32_t own = all->radii.of[i];
        if (own < 0 || all->radii.items[own].size < 2)
            continue;
        crease_model *const model = &all->bodies[i].model;
        const double mean = all->radii.items[own].mean.at[0];
        const double by[2] = {mean - model->radius, 0.0};
        const crease_functions growth = crease_body_growth();
        if (crease_body_condition(&all->bodies[i], &growth, by)) {
            model->radius = mean;
            all->moved[i] = true;
        } else {
            all->radii.items[own].size--;
            all->radii.of[i] = CREASE_NO_CLUSTER;
        }
    }
    return status;
}
