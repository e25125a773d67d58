/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Mirror planes, at right angles to directions that surfaces have. Every pair of places that may be
 * each other's image, and every place that may be its own, tells where the plane would be; where
 * several tell the same within their errors, all of them are made to. One more than it takes to
 * place the plane is enough if nothing along that direction is left over; else two more, and half
 * of the places. */
#include "base/memory.h"
#include "base/vector.h"
#include "snap/joint.h"
#include "snap/middle.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LEAST_MIDDLES = 2, LEAST_MIDDLES_OF_SOME = 3 };

typedef struct mirror {
    double normal[3];
    size_t first, size; /* among the middles that were taken */
} mirror;

typedef struct symmetry {
    crease_snapping *all;
    crease_place *places;
    size_t place_count, mirror_count;
    bool *excluded;         /* of the places */
    size_t *first;          /* of their values in the joint */
    crease_middles middles; /* of one direction */
    crease_middles taken;   /* of all mirrors */
    mirror *mirrors;        /* one for a direction at most */
} symmetry;

/* ------------------------------------------------------------------------------------ mirrors --
 */

static double apart(const crease_middle *a, const crease_middle *b)
{
    const double d = a->at - b->at;
    return d * d / (a->variance + b->variance);
}

static bool takes_from(const crease_middle *list, size_t count, const crease_middle *h)
{
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 2; k++)
            if (list[i].place[0] == h->place[k] || list[i].place[1] == h->place[k])
                return true;
    return false;
}

/* The middles that agree with one of them, the nearest first; each place is taken once. `out` has
 * room for as many as there are places. */
static size_t agreeing(const symmetry *s, size_t with, double reach, crease_middle *out)
{
    const crease_middle *const lead = &s->middles.items[with];
    size_t low = with, high = with, count = 1;
    out[0] = *lead;
    while (low > 0 && lead->at - s->middles.items[low - 1].at < reach)
        low--;
    while (high + 1 < s->middles.count && s->middles.items[high + 1].at - lead->at < reach)
        high++;
    for (double least = -1.0;;) { /* by how far they are apart from the first */
        size_t best = s->middles.count;
        double nearest = CREASE_WITHIN_ERRORS[1];
        for (size_t i = low; i <= high; i++) {
            const double squared = apart(&s->middles.items[i], lead);
            if (i != with && squared < nearest && squared >= least &&
                !takes_from(out, count, &s->middles.items[i])) {
                nearest = squared;
                best = i;
            }
        }
        if (best == s->middles.count)
            return count;
        least = nearest;
        out[count++] = s->middles.items[best];
    }
}

static size_t places_of(const crease_middle *list, size_t count)
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
    crease_status status = crease_middles_find(
        s->all, s->places, s->place_count, s->excluded, normal, &s->middles, &across);
    if (status != CREASE_OK || s->middles.count < LEAST_MIDDLES ||
        across > CREASE_MOST_PLACES_ACROSS)
        return status;
    crease_middle *const found = crease_allocate(s->all->context, across + 1, sizeof *found);
    crease_middle *const best = crease_allocate(s->all->context, across + 1, sizeof *best);
    if (!found || !best) {
        free(found);
        free(best);
        return CREASE_ERROR_NO_MEMORY;
    }
    double most = 0.0;
    for (size_t i = 0; i < s->middles.count; i++)
        most = fmax(most, s->middles.items[i].variance);
    for (size_t i = 0; i < s->middles.count; i++) {
        const size_t count = agreeing(s, i, sqrt(2.0 * CREASE_WITHIN_ERRORS[1] * most), found);
        if (places_of(found, count) > places_of(best, best_count)) {
            memcpy(best, found, count * sizeof *found);
            best_count = count;
        }
    }
    const size_t explained = places_of(best, best_count);
    if (best_count >= (explained == across ? LEAST_MIDDLES : LEAST_MIDDLES_OF_SOME) &&
        2 * explained >= across) {
        mirror *const m = &s->mirrors[s->mirror_count++];
        memcpy(m->normal, normal, sizeof m->normal);
        m->first = s->taken.count;
        m->size = best_count;
        for (size_t i = 0; i < best_count && status == CREASE_OK; i++)
            status = crease_middles_add(s->all->context, &s->taken, &best[i]);
    }
    free(found);
    free(best);
    return status;
}

/* ------------------------------------------------------------------------------------ meeting --
 */

static void add_row(const symmetry *s, const crease_middle *h, double by, double *row)
{
    for (int k = 0; k < 2; k++)
        for (int c = 0; c < s->places[h->place[k]].count; c++)
            row[s->first[h->place[k]] + (size_t)c] += by * h->row[k][c];
}

static void add_level_row(const symmetry *s, const crease_middle *h, double *row)
{
    for (int k = 0; k < 2; k++) {
        const crease_place *const place = &s->places[h->place[k]];
        double part[CREASE_PLACE_COORDINATES];
        crease_place_project(place, h->across, k == 0 ? 1.0 : -1.0, part);
        for (int c = 0; c < place->count; c++)
            row[s->first[h->place[k]] + (size_t)c] += part[c];
    }
}

/* Makes all middles of a mirror tell one plane; those that do not come along are dropped. */
static void meet_mirror(symmetry *s, mirror *m, crease_joint *joint, double *row)
{
    crease_middle *const middles = s->taken.items + m->first;
    size_t kept = 0;
    for (size_t i = 0; i < m->size; i++) {
        bool meets = true;
        if (middles[i].place[0] != middles[i].place[1] &&
            !s->places[middles[i].place[0]].is_plane) {
            memset(row, 0, joint->count * sizeof *row);
            add_level_row(s, &middles[i], row);
            meets = crease_joint_condition(joint, row);
        }
        if (meets && kept > 0) {
            memset(row, 0, joint->count * sizeof *row);
            add_row(s, &middles[0], 1.0, row);
            add_row(s, &middles[i], -1.0, row);
            meets = crease_joint_condition(joint, row);
        }
        if (meets) {
            const crease_middle h = middles[i];
            middles[kept++] = h;
        }
    }
    m->size = kept;
}

static crease_status make_joint(symmetry *s, crease_joint *joint)
{
    size_t count = 0;
    for (size_t p = 0; p < s->place_count; p++)
        s->first[p] = SIZE_MAX;
    for (size_t i = 0; i < s->taken.count; i++)
        for (int k = 0; k < 2; k++) {
            const size_t p = s->taken.items[i].place[k];
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
    s->mirror_count = s->taken.count = 0;
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
        if (m->size < LEAST_MIDDLES)
            continue;
        bool *const row = all->mirrored + all->count * all->mirror_count++;
        for (size_t h = 0; h < m->size; h++)
            for (int k = 0; k < 2; k++)
                for (size_t body = 0; body < all->count; body++)
                    if (crease_place_has(
                            all, &s->places[s->taken.items[m->first + h].place[k]], body))
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
    free(s.middles.items);
    free(s.taken.items);
    free(s.mirrors);
    return status;
}
