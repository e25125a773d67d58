/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "snap/middle.h"

#include "base/memory.h"
#include "base/vector.h"

#include <math.h>
#include <stdlib.h>

static const double EXACT = 1e-9;   /* sine between directions that were made perpendicular */
static const double OBLIQUE = 0.05; /* cosine between a mirror's normal and what it turns */

/* What the middles of one direction are found of. */
typedef struct pairs {
    const crease_snapping *all;
    const crease_place *places;
    const bool *excluded; /* of the places */
    const double *normal;
} pairs;

/* Value and variance of a linear function of one place. */
static void evaluate(const crease_place *place, const double row[], double *at, double *variance)
{
    for (int k = 0; k < place->count; k++) {
        *at += row[k] * place->at[k];
        for (int m = 0; m < place->count; m++)
            *variance += row[k] * place->covariance[k][m] * row[m];
    }
}

/* Whether the two are level: equal along a direction within their errors. */
static bool are_level(const crease_place *a, const crease_place *b, const double along[3])
{
    double row[CREASE_PLACE_COORDINATES], d = 0.0, variance = 0.0;
    crease_place_project(a, along, 1.0, row);
    evaluate(a, row, &d, &variance);
    crease_place_project(b, along, -1.0, row);
    evaluate(b, row, &d, &variance);
    return d * d < CREASE_WITHIN_ERRORS[1] * variance;
}

/* Whether the two move bodies of one radius. */
static bool share_radius(const crease_snapping *all, const crease_place *a, const crease_place *b)
{
    for (size_t i = 0; i < all->count; i++) {
        const int32_t radius = all->radii.of[i];
        if (radius < 0 || !crease_place_has(all, a, i))
            continue;
        for (size_t k = 0; k < all->count; k++)
            if (all->radii.of[k] == radius && crease_place_has(all, b, k))
                return true;
    }
    return false;
}

/* Planes whose normals are each other's image. */
static bool between_planes(
    const crease_place *a, const crease_place *b, const double normal[3], crease_middle *out)
{
    double image[3], apart[3];
    const double along = crease_vector_dot(normal, a->along[0]);
    crease_mirror_vector(normal, a->along[0], image);
    crease_vector_cross(image, b->along[0], apart);
    if (fabs(along) < OBLIQUE || crease_vector_length(apart) > EXACT)
        return false;
    const double sign = crease_vector_dot(image, b->along[0]) < 0.0 ? -1.0 : 1.0;
    out->row[0][0] = 0.5 / along;
    out->row[1][0] = -0.5 * sign / along;
    return true;
}

/* Axes across the normal, or spheres. */
static bool between_round(
    const pairs *of, const crease_place *a, const crease_place *b, crease_middle *out)
{
    const bool same = a == b;
    if (a->direction != b->direction)
        return false;
    if (a->direction >= 0) {
        const double *const axis = of->all->axis_of[a->direction];
        if (fabs(crease_vector_dot(axis, of->normal)) > EXACT)
            return false;
        crease_vector_cross(axis, of->normal, out->across);
        if (!same && (!are_level(a, b, out->across) || !share_radius(of->all, a, b)))
            return false;
    } else if (!same)
        return false;
    crease_place_project(a, of->normal, same ? 1.0 : 0.5, out->row[0]);
    if (!same)
        crease_place_project(b, of->normal, 0.5, out->row[1]);
    return true;
}

crease_status crease_middles_add(
    crease_context *context, crease_middles *middles, const crease_middle *middle)
{
    if (middles->count == middles->room) {
        const size_t more = 2 * middles->room + 64;
        crease_middle *const grown = middles->items
            ? crease_reallocate(context, middles->items, more, sizeof *middles->items)
            : crease_allocate(context, more, sizeof *middles->items);
        if (!grown)
            return CREASE_ERROR_NO_MEMORY;
        middles->items = grown;
        middles->room = more;
    }
    middles->items[middles->count++] = *middle;
    return CREASE_OK;
}

static crease_status try_middle(const pairs *of, size_t a, size_t b, crease_middles *out)
{
    const crease_place *const x = &of->places[a], *const y = &of->places[b];
    crease_middle middle = {.place = {a, b}};
    if (x->is_plane != y->is_plane || (x->is_plane && a == b))
        return CREASE_OK;
    if (!(x->is_plane ? between_planes(x, y, of->normal, &middle)
                      : between_round(of, x, y, &middle)))
        return CREASE_OK;
    evaluate(x, middle.row[0], &middle.at, &middle.variance);
    evaluate(y, middle.row[1], &middle.at, &middle.variance);
    return crease_middles_add(of->all->context, out, &middle);
}

static int compare_middles(const void *a, const void *b)
{
    const crease_middle *x = a, *y = b;
    if (x->at != y->at)
        return x->at < y->at ? -1 : 1;
    if (x->place[0] != y->place[0])
        return x->place[0] < y->place[0] ? -1 : 1;
    return x->place[1] < y->place[1] ? -1 : x->place[1] > y->place[1];
}

/* Whether a place takes part: not where its image is the place itself wherever the mirror is. */
static bool takes_part(const pairs *of, size_t p)
{
    const crease_place *const place = &of->places[p];
    if (of->excluded[p])
        return false;
    if (place->direction < 0)
        return true;
    const double along = fabs(crease_vector_dot(of->all->axis_of[place->direction], of->normal));
    return place->is_plane ? along > EXACT : along < 1.0 - EXACT;
}

crease_status crease_middles_find(const crease_snapping *all, const crease_place *places,
    size_t count, const bool *excluded, const double normal[3], crease_middles *out, size_t *across)
{
    const pairs of = {all, places, excluded, normal};
    out->count = *across = 0;
    for (size_t p = 0; p < count; p++)
        *across += takes_part(&of, p);
    if (*across > CREASE_MOST_PLACES_ACROSS)
        return CREASE_OK;
    for (size_t a = 0; a < count; a++)
        for (size_t b = a; b < count; b++) {
            if (!takes_part(&of, a) || !takes_part(&of, b))
                continue;
            const crease_status status = try_middle(&of, a, b, out);
            if (status != CREASE_OK)
                return status;
        }
    if (out->count > 0)
        qsort(out->items, out->count, sizeof *out->items, compare_middles);
    return CREASE_OK;
}
