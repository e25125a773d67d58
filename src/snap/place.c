/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "snap/place.h"

#include "base/vector.h"

#include <string.h>

static const double SETTLED = 1e-6; /* of a variance: what is left of it by rounding */

static void measure(const crease_snapping *all, crease_place *place)
{
    const crease_body *const body = &all->bodies[place->body];
    for (int k = 0; k < place->count; k++)
        place->at[k] = crease_vector_dot(body->model.centre, place->along[k]);
    for (int k = 0; k < place->count; k++)
        for (int m = 0; m <= k; m++) {
            double pair[2][3], found[3];
            memcpy(pair[0], place->along[k], sizeof pair[0]);
            memcpy(pair[1], place->along[m], sizeof pair[1]);
            const crease_functions moves = crease_body_moves(body, 2, pair);
            crease_body_covariance(body, &moves, found);
            place->covariance[k][m] = place->covariance[m][k] = m == k ? found[0] : found[1];
        }
}

static bool leads(const crease_snapping *all, size_t body)
{
    for (size_t i = 0; i < body; i++)
        if (all->axes.of[i] == all->axes.of[body])
            return false;
    return true;
}

static bool make_axis(const crease_snapping *all, size_t body, crease_place *out)
{
    const int32_t axis = all->axes.of[body];
    if (axis < 0 || all->axes.items[axis].size == 0 || !leads(all, body))
        return false;
    out->direction = all->directions.of[body];
    out->count = 2;
    memcpy(out->along, all->across[out->direction], sizeof all->across[out->direction]);
    measure(all, out);
    if (all->axes.items[axis].size > 1) {
        const double *const c = all->axes.items[axis].mean.covariance;
        out->covariance[0][0] = c[0];
        out->covariance[0][1] = out->covariance[1][0] = c[1];
        out->covariance[1][1] = c[2];
    }
    return true;
}

static bool make(const crease_snapping *all, size_t body, crease_place *out)
{
    const crease_region_type type = all->bodies[body].model.type;
    *out = (crease_place){.body = body, .direction = CREASE_NO_CLUSTER};
    if (!all->takes_part[body])
        return false;
    if (type == CREASE_REGION_SPHERE) {
        out->count = 3;
        for (int k = 0; k < 3; k++)
            out->along[k][k] = 1.0;
        measure(all, out);
        return true;
    }
    if (!all->moved[body] || all->directions.of[body] < 0)
        return false;
    if (type != CREASE_REGION_PLANE)
        return make_axis(all, body, out);
    out->is_plane = true;
    out->direction = all->directions.of[body];
    out->count = 1;
    memcpy(out->along[0], all->axis_of[out->direction], sizeof out->along[0]);
    measure(all, out);
    return true;
}

size_t crease_places_find(const crease_snapping *all, crease_place *out)
{
    size_t count = 0;
    for (size_t i = 0; i < all->count; i++)
        count += make(all, i, &out[count]);
    return count;
}

bool crease_place_has(const crease_snapping *all, const crease_place *place, size_t body)
{
    if (place->is_plane || place->direction < 0)
        return body == place->body;
    return all->axes.of[body] == all->axes.of[place->body];
}

void crease_place_move(crease_snapping *all, const crease_place *place, const double to[])
{
    for (size_t i = 0; i < all->count; i++) {
        if (!crease_place_has(all, place, i))
            continue;
        crease_body *const body = &all->bodies[i];
        for (int k = 0; k < place->count; k++) {
            double along[1][3];
            memcpy(along[0], place->along[k], sizeof along[0]);
            const double by[2] = {to[k] - crease_vector_dot(body->model.centre, along[0]), 0.0};
            const crease_functions moves = crease_body_moves(body, 1, along);
            double free[3];
            crease_body_covariance(body, &moves, free);
            if (free[0] > SETTLED * place->covariance[k][k])
                crease_body_condition(body, &moves, by);
            /* what was settled before, as coaxial, is shifted as it is */
            const double rest = to[k] - crease_vector_dot(body->model.centre, along[0]);
            for (int c = 0; c < 3; c++)
                body->model.centre[c] += rest * along[0][c];
        }
        all->moved[i] = true;
    }
}

void crease_place_project(const crease_place *place, const double onto[3], double by, double out[])
{
    for (int k = 0; k < place->count; k++)
        out[k] = by * crease_vector_dot(place->along[k], onto);
}
