/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Mirror planes, at right angles to directions that surfaces have. Every pair of places that may be
 * each other's image, and every place that may be its own, tells where the plane would be; where
 * several tell the same within their errors, all of them are made to. One more than it takes to
 * place the plane is enough if nothing along that direction is left over; else two more, and half
 * of the places. */
#include "base/memory.h"
#include "base/vector.h"
#include "segment/joint.h"
#include "segment/place.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_PLACES = 60, LEAST_HALVES = 2, LEAST_HALVES_OF_SOME = 3 };

static const double EXACT = 1e-9;   /* sine between directions that were made perpendicular */
static const double OBLIQUE = 0.05; /* cosine between a mirror's normal and what it turns */

/* Two places, or twice the same: the mirror plane between them is a linear function of theirs. */
typedef struct half {
    size_t place[2];
    double row[2][CREASE_PLACE_COORDINATES];
    double across[3]; /* not zero: axes that must not be apart this way either */
    double at, variance;
} half;

typedef struct mirror {
    double normal[3];
    size_t first, size; /* among the halves that were taken */
} mirror;

typedef struct symmetry {
    crease_snapping *all;
    crease_place *places;
    size_t place_count, mirror_count, half_count, half_room, taken_count, taken_room;
    bool *excluded;  /* of the places */
    size_t *first;   /* of their values in the joint */
    half *halves;    /* of one direction */
    half *taken;     /* of all mirrors */
    mirror *mirrors; /* one for a direction at most */
} symmetry;

/* ------------------------------------------------------------------------------------- halves --
 */

/* Value and variance of a linear function of one place. */
static void evaluate(const crease_place *place, const double row[], double *at, double *variance)
{
    for (int k = 0; k < place->count; k++) {
        *at += row[k] * place->at[k];
        for (int m = 0; m < place->count; m++)
            *variance += row[k] * place->covariance[k][m] * row[m];
    }
}

static void project(const crease_place *place, const double onto[3], double by, double out[])
{
    for (int k = 0; k < place->count; k++)
        out[k] = by * crease_vector_dot(place->along[k], onto);
}

/* Whether the two are level: equal along a direction within their errors. */
static bool are_level(const crease_place *a, const crease_place *b, const double along[3])
{
    double row[CREASE_PLACE_COORDINATES], d = 0.0, variance = 0.0;
    project(a, along, 1.0, row);
    evaluate(a, row, &d, &variance);
    project(b, along, -1.0, row);
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
    const crease_place *a, const crease_place *b, const double normal[3], half *out)
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
static bool between_round(const symmetry *s, const crease_place *a, const crease_place *b,
    const double normal[3], half *out)
{
    const bool same = a == b;
    if (a->direction != b->direction)
        return false;
    if (a->direction >= 0) {
        const double *const axis = s->all->axis_of[a->direction];
        if (fabs(crease_vector_dot(axis, normal)) > EXACT)
            return false;
        crease_vector_cross(axis, normal, out->across);
        if (!same && (!are_level(a, b, out->across) || !share_radius(s->all, a, b)))
            return false;
    } else if (!same)
        return false;
    project(a, normal, same ? 1.0 : 0.5, out->row[0]);
    if (!same)
        project(b, normal, 0.5, out->row[1]);
    return true;
}

static crease_status add_half(symmetry *s, half **list, size_t *count, size_t *room, const half *h)
{
    if (*count == *room) {
        const size_t more = 2 * *room + 64;
        half *const grown = *list ? crease_reallocate(s->all->context, *list, more, sizeof **list)
                                  : crease_allocate(s->all->context, more, sizeof **list);
        if (!grown)
            return CREASE_ERROR_NO_MEMORY;
        *list = grown;
        *room = more;
    }
    (*list)[(*count)++] = *h;
    return CREASE_OK;
}

static crease_status try_half(symmetry *s, size_t a, size_t b, const double normal[3])
{
    const crease_place *const x = &s->places[a], *const y = &s->places[b];
    half h = {.place = {a, b}};
    if (s->excluded[a] || s->excluded[b] || x->is_plane != y->is_plane || (x->is_plane && a == b))
        return CREASE_OK;
    if (!(x->is_plane ? between_planes(x, y, normal, &h) : between_round(s, x, y, normal, &h)))
        return CREASE_OK;
    evaluate(x, h.row[0], &h.at, &h.variance);
    evaluate(y, h.row[1], &h.at, &h.variance);
    return add_half(s, &s->halves, &s->half_count, &s->half_room, &h);
}

static int compare_halves(const void *a, const void *b)
{
    const half *x = a, *y = b;
    if (x->at != y->at)
        return x->at < y->at ? -1 : 1;
    if (x->place[0] != y->place[0])
        return x->place[0] < y->place[0] ? -1 : 1;
    return x->place[1] < y->place[1] ? -1 : x->place[1] > y->place[1];
}

/* Places whose image is not the place itself wherever the mirror is. */
static bool is_across(const symmetry *s, const crease_place *place, const double normal[3])
{
    if (place->direction < 0)
        return true;
    const double along = fabs(crease_vector_dot(s->all->axis_of[place->direction], normal));
    return place->is_plane ? along > EXACT : along < 1.0 - EXACT;
}

/* All halves of a direction, by where they are; none where there are too many places. */
static crease_status list_halves(symmetry *s, const double normal[3], size_t *places)
{
    s->half_count = *places = 0;
    for (size_t a = 0; a < s->place_count; a++)
        *places += !s->excluded[a] && is_across(s, &s->places[a], normal);
    if (*places > MOST_PLACES)
        return CREASE_OK;
    for (size_t a = 0; a < s->place_count; a++)
        for (size_t b = a; b < s->place_count; b++) {
            if (!is_across(s, &s->places[a], normal) || !is_across(s, &s->places[b], normal))
                continue;
            const crease_status status = try_half(s, a, b, normal);
            if (status != CREASE_OK)
                return status;
        }
    if (s->half_count > 0)
        qsort(s->halves, s->half_count, sizeof *s->halves, compare_halves);
    return CREASE_OK;
}

/* ------------------------------------------------------------------------------------ mirrors --
 */

static double apart(const half *a, const half *b)
{
    const double d = a->at - b->at;
    return d * d / (a->variance + b->variance);
}

static bool takes_from(const half *list, size_t count, const half *h)
{
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 2; k++)
            if (list[i].place[0] == h->place[k] || list[i].place[1] == h->place[k])
                return true;
    return false;
}

/* The halves that agree with one of them, the nearest first; each place is taken once. `out` has
 * room for as many as there are places. */
static size_t agreeing(const symmetry *s, size_t with, double reach, half *out)
{
    const half *const lead = &s->halves[with];
    size_t low = with, high = with, count = 1;
    out[0] = *lead;
    while (low > 0 && lead->at - s->halves[low - 1].at < reach)
        low--;
    while (high + 1 < s->half_count && s->halves[high + 1].at - lead->at < reach)
        high++;
    for (double least = -1.0;;) { /* by how far they are apart from the first */
        size_t best = s->half_count;
        double nearest = CREASE_WITHIN_ERRORS[1];
        for (size_t i = low; i <= high; i++) {
            const double squared = apart(&s->halves[i], lead);
            if (i != with && squared < nearest && squared >= least &&
                !takes_from(out, count, &s->halves[i])) {
                nearest = squared;
                best = i;
            }
        }
        if (best == s->half_count)
            return count;
        least = nearest;
        out[count++] = s->halves[best];
    }
}

static size_t places_of(const half *list, size_t count)
{
    size_t places = 0;
    for (size_t i = 0; i < count; i++)
        places += list[i].place[0] == list[i].place[1] ? 1 : 2;
    return places;
}

/* The mirror of most places across a direction, if there is one. */
static crease_status seek_mirror(symmetry *s, const double normal[3])
{
    size_t across, best_count = 0;
    crease_status status = list_halves(s, normal, &across);
    if (status != CREASE_OK || s->half_count < LEAST_HALVES || across > MOST_PLACES)
        return status;
    half *const found = crease_allocate(s->all->context, across + 1, sizeof *found);
    half *const best = crease_allocate(s->all->context, across + 1, sizeof *best);
    if (!found || !best) {
        free(found);
        free(best);
        return CREASE_ERROR_NO_MEMORY;
    }
    double most = 0.0;
    for (size_t i = 0; i < s->half_count; i++)
        most = fmax(most, s->halves[i].variance);
    for (size_t i = 0; i < s->half_count; i++) {
        const size_t count = agreeing(s, i, sqrt(2.0 * CREASE_WITHIN_ERRORS[1] * most), found);
        if (places_of(found, count) > places_of(best, best_count)) {
            memcpy(best, found, count * sizeof *found);
            best_count = count;
        }
    }
    const size_t explained = places_of(best, best_count);
    if (best_count >= (explained == across ? LEAST_HALVES : LEAST_HALVES_OF_SOME) &&
        2 * explained >= across) {
        mirror *const m = &s->mirrors[s->mirror_count++];
        memcpy(m->normal, normal, sizeof m->normal);
        m->first = s->taken_count;
        m->size = best_count;
        for (size_t i = 0; i < best_count && status == CREASE_OK; i++)
            status = add_half(s, &s->taken, &s->taken_count, &s->taken_room, &best[i]);
    }
    free(found);
    free(best);
    return status;
}

/* ------------------------------------------------------------------------------------ meeting --
 */

static void add_row(const symmetry *s, const half *h, double by, double *row)
{
    for (int k = 0; k < 2; k++)
        for (int c = 0; c < s->places[h->place[k]].count; c++)
            row[s->first[h->place[k]] + (size_t)c] += by * h->row[k][c];
}

static void add_level_row(const symmetry *s, const half *h, double *row)
{
    for (int k = 0; k < 2; k++) {
        const crease_place *const place = &s->places[h->place[k]];
        double part[CREASE_PLACE_COORDINATES];
        project(place, h->across, k == 0 ? 1.0 : -1.0, part);
        for (int c = 0; c < place->count; c++)
            row[s->first[h->place[k]] + (size_t)c] += part[c];
    }
}

/* Makes all halves of a mirror tell one plane; those that do not come along are dropped. */
static void meet_mirror(symmetry *s, mirror *m, crease_joint *joint, double *row)
{
    half *const halves = s->taken + m->first;
    size_t kept = 0;
    for (size_t i = 0; i < m->size; i++) {
        bool meets = true;
        if (halves[i].place[0] != halves[i].place[1] && !s->places[halves[i].place[0]].is_plane) {
            memset(row, 0, joint->count * sizeof *row);
            add_level_row(s, &halves[i], row);
            meets = crease_joint_condition(joint, row);
        }
        if (meets && kept > 0) {
            memset(row, 0, joint->count * sizeof *row);
            add_row(s, &halves[0], 1.0, row);
            add_row(s, &halves[i], -1.0, row);
            meets = crease_joint_condition(joint, row);
        }
        if (meets) {
            const half h = halves[i];
            halves[kept++] = h;
        }
    }
    m->size = kept;
}

static crease_status make_joint(symmetry *s, crease_joint *joint)
{
    size_t count = 0;
    for (size_t p = 0; p < s->place_count; p++)
        s->first[p] = SIZE_MAX;
    for (size_t i = 0; i < s->taken_count; i++)
        for (int k = 0; k < 2; k++) {
            const size_t p = s->taken[i].place[k];
            if (s->first[p] == SIZE_MAX) {
                s->first[p] = count;
                count += (size_t)s->places[p].count;
            }
        }
    const crease_status status = crease_joint_make(s->all->context, count, joint);
    for (size_t p = 0; p < s->place_count && status == CREASE_OK; p++)
        for (int k = 0; k < s->places[p].count && s->first[p] < SIZE_MAX; k++) {
            const size_t at = s->first[p] + (size_t)k;
            joint->at[at] = s->places[p].at[k];
            for (int m = 0; m < s->places[p].count; m++)
                joint->covariance[at * count + s->first[p] + (size_t)m] =
                    s->places[p].covariance[k][m];
        }
    return status;
}

/* The place that goes furthest beyond its own errors, or the number of places. */
static size_t furthest(const symmetry *s, const crease_joint *joint)
{
    size_t worst = s->place_count;
    double most = 1.0;
    for (size_t p = 0; p < s->place_count; p++)
        for (int k = 0; k < s->places[p].count && s->first[p] < SIZE_MAX; k++) {
            const double d = joint->at[s->first[p] + (size_t)k] - s->places[p].at[k];
            const double ratio = d * d / (CREASE_WITHIN_ERRORS[1] * s->places[p].covariance[k][k]);
            if (ratio > most) {
                most = ratio;
                worst = p;
            }
        }
    return worst;
}

static crease_status find_mirrors(symmetry *s)
{
    crease_status status = CREASE_OK;
    s->mirror_count = s->taken_count = 0;
    for (size_t k = 0; k < s->all->directions.count && status == CREASE_OK; k++)
        if (s->all->directions.items[k].size > 0)
            status = seek_mirror(s, s->all->axis_of[k]);
    return status;
}

static int compare_mirrors(const void *a, const void *b)
{
    const mirror *x = a, *y = b;
    if (x->size != y->size)
        return x->size > y->size ? -1 : 1;
    return x->first < y->first ? -1 : x->first > y->first;
}

static void move_places(symmetry *s, const crease_joint *joint)
{
    for (size_t p = 0; p < s->place_count; p++)
        if (s->first[p] < SIZE_MAX)
            crease_place_move(s->all, &s->places[p], joint->at + s->first[p]);
}

/* Finds and meets mirrors; a place that would have to go too far is left out, and all is done
 * again. */
static crease_status meet_mirrors(symmetry *s)
{
    for (;;) {
        crease_joint joint = {0};
        crease_status status = find_mirrors(s);
        if (status != CREASE_OK || s->mirror_count == 0)
            return status;
        double *row = NULL;
        status = make_joint(s, &joint);
        if (status == CREASE_OK) {
            row = crease_allocate(s->all->context, joint.count, sizeof *row);
            status = row ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
        }
        size_t worst = s->place_count;
        if (status == CREASE_OK) {
            qsort(s->mirrors, s->mirror_count, sizeof *s->mirrors, compare_mirrors);
            for (size_t i = 0; i < s->mirror_count; i++)
                meet_mirror(s, &s->mirrors[i], &joint, row);
            worst = furthest(s, &joint);
            if (worst == s->place_count)
                move_places(s, &joint);
            else
                s->excluded[worst] = true;
        }
        free(row);
        crease_joint_clear(&joint);
        if (status != CREASE_OK || worst == s->place_count)
            return status;
    }
}

/* ----------------------------------------------------------------------------------- keeping -- */

/* Notes which bodies each mirror has to do with. */
static crease_status keep_mirrors(const symmetry *s)
{
    crease_snapping *const all = s->all;
    all->mirrored = crease_allocate(all->context, s->mirror_count * all->count + 1, 1);
    if (!all->mirrored)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < s->mirror_count; i++) {
        const mirror *const m = &s->mirrors[i];
        if (m->size < LEAST_HALVES)
            continue;
        bool *const row = all->mirrored + all->count * all->mirror_count++;
        for (size_t h = 0; h < m->size; h++)
            for (int k = 0; k < 2; k++)
                for (size_t body = 0; body < all->count; body++)
                    if (crease_place_has(all, &s->places[s->taken[m->first + h].place[k]], body))
                        row[body] = true;
    }
    return CREASE_OK;
}

crease_status crease_snap_symmetry(crease_snapping *all)
{
    symmetry s = {.all = all};
    crease_status status = CREASE_ERROR_NO_MEMORY;
    s.places = crease_allocate(all->context, all->count, sizeof *s.places);
    s.excluded = crease_allocate(all->context, all->count, sizeof *s.excluded);
    s.first = crease_allocate(all->context, all->count, sizeof *s.first);
    s.mirrors = crease_allocate(all->context, all->directions.count, sizeof *s.mirrors);
    if (s.places && s.excluded && s.first && s.mirrors) {
        s.place_count = crease_places_find(all, s.places);
        status = meet_mirrors(&s);
    }
    if (status == CREASE_OK)
        status = keep_mirrors(&s);
    free(s.places);
    free(s.excluded);
    free(s.first);
    free(s.halves);
    free(s.taken);
    free(s.mirrors);
    return status;
}
