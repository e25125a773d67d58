/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "base/memory.h"
#include "trim/overlay.h"

#include <math.h>
#include <stdlib.h>

crease_status crease_frontier_create(crease_context *context, size_t ring_count, size_t arc_count,
    size_t place_count, crease_frontier *out)
{
    *out = (crease_frontier){
        .ring_count = ring_count, .arc_count = arc_count, .place_count = place_count};
    out->first_arc = crease_allocate(context, ring_count + 1, sizeof *out->first_arc);
    out->first_place = crease_allocate(context, arc_count + 1, sizeof *out->first_place);
    out->places = crease_allocate(context, place_count, 2 * sizeof *out->places);
    if (out->first_arc && out->first_place && out->places)
        return CREASE_OK;
    crease_frontier_clear(out);
    return CREASE_ERROR_NO_MEMORY;
}

void crease_frontier_clear(crease_frontier *frontier)
{
    free(frontier->first_arc);
    free(frontier->first_place);
    free(frontier->places);
    *frontier = (crease_frontier){.ring_count = 0};
}

/* A side of the rings, and the sides that it follows and is followed by. */
struct side {
    const double *a, *b;
    double low, high; /* in x */
    size_t number, before, after;
};

static int by_low(const void *left, const void *right)
{
    const struct side *const a = left, *const b = right;
    if (a->low != b->low)
        return a->low < b->low ? -1 : 1;
    return (a->number > b->number) - (a->number < b->number);
}

/* Twice the area of a triangle. */
static double turn(const double a[2], const double b[2], const double c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static bool within(const double a[2], const double b[2], const double p[2])
{
    return fmin(a[0], b[0]) <= p[0] && p[0] <= fmax(a[0], b[0]) && fmin(a[1], b[1]) <= p[1] &&
        p[1] <= fmax(a[1], b[1]);
}

static bool meet(const struct side *p, const struct side *q)
{
    const double c = turn(p->a, p->b, q->a), d = turn(p->a, p->b, q->b);
    const double e = turn(q->a, q->b, p->a), f = turn(q->a, q->b, p->b);
    if (((c > 0.0) != (d > 0.0) && c != 0.0 && d != 0.0) &&
        ((e > 0.0) != (f > 0.0) && e != 0.0 && f != 0.0))
        return true;
    return (c == 0.0 && within(p->a, p->b, q->a)) || (d == 0.0 && within(p->a, p->b, q->b)) ||
        (e == 0.0 && within(q->a, q->b, p->a)) || (f == 0.0 && within(q->a, q->b, p->b));
}

/* Sides one after the other share a place; they may only not turn back onto each other. */
static bool turn_back(const struct side *p, const struct side *q)
{
    const struct side *const first = p->after == q->number ? p : q;
    const struct side *const second = first == p ? q : p;
    const double dot = (first->b[0] - first->a[0]) * (second->b[0] - second->a[0]) +
        (first->b[1] - first->a[1]) * (second->b[1] - second->a[1]);
    return dot <= 0.0 && turn(first->a, first->b, second->b) == 0.0;
}

static size_t make_sides(const crease_frontier *frontier, struct side *sides)
{
    size_t n = 0;
    for (size_t r = 0; r < frontier->ring_count; r++) {
        const size_t begin = n;
        for (size_t a = frontier->first_arc[r]; a < frontier->first_arc[r + 1]; a++)
            for (size_t i = frontier->first_place[a]; i + 1 < frontier->first_place[a + 1]; i++) {
                const double *const p = frontier->places + 2 * i;
                sides[n] = (struct side){.a = p,
                    .b = p + 2,
                    .low = fmin(p[0], p[2]),
                    .high = fmax(p[0], p[2]),
                    .number = n,
                    .before = n - 1,
                    .after = n + 1};
                n++;
            }
        if (n > begin) {
            sides[begin].before = n - 1;
            sides[n - 1].after = begin;
        }
    }
    return n;
}

crease_status crease_frontier_is_simple(
    crease_context *context, const crease_frontier *frontier, bool *simple)
{
    struct side *const sides = crease_allocate(context, frontier->place_count, sizeof *sides);
    if (!sides)
        return CREASE_ERROR_NO_MEMORY;
    const size_t n = make_sides(frontier, sides);
    qsort(sides, n, sizeof *sides, by_low);
    *simple = true;
    for (size_t i = 0; i < n && *simple; i++)
        for (size_t k = i + 1; k < n && sides[k].low <= sides[i].high && *simple; k++) {
            const struct side *const p = &sides[i], *const q = &sides[k];
            const bool next = p->after == q->number || q->after == p->number;
            *simple = next ? !turn_back(p, q) : !meet(p, q);
        }
    free(sides);
    return CREASE_OK;
}
