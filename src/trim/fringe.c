/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "trim/fringe.h"

#include "base/memory.h"
#include "space/outline.h"
#include "trim/contour.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NO_SIDE = -1, SIDES = 4, PROBES = 2000 };

/* In spacings. */
static const double LEAST_LOOP = 8.0;    /* around a hole or an island */
static const double LEAST_ISLAND = 12.0; /* area, in squared spacings */
static const double FULL = 1.0;          /* between the border and the side that it is */
static const double FULL_CORNER = 2.5;   /* between the border and a corner of the rectangle */
static const double SOFT = 0.05;         /* how near to a side the border may come by itself */
static const double NEAR_CUT = 0.25;     /* a corner there is on the cut */
static const double LOOK_BACK = 2.0;     /* for the direction in which an arc ends */
static const double MOST_ON = 3.0;       /* that an arc goes on to a side */
static const double GUARD = 0.3;         /* of an end: no other place of an arc */

static const double LEAST_SLANT = 0.3; /* sine to a side, for an arc that goes on to it */
static const double OUTSIDE = 0.03;    /* of the places, that may be outside, ... */
static const double BESIDE = 0.5;      /* ... and of those that are along the border */

struct rings {
    size_t count;
    crease_contour *items;
};

static void clear_rings(struct rings *rings)
{
    for (size_t i = 0; rings->items && i < rings->count; i++)
        crease_contour_clear(&rings->items[i]);
    free(rings->items);
    *rings = (struct rings){.count = 0};
}

/* -------------------------------------------------------------------------------- contours -- */

/* Area and length of a loop of points. */
static void measure(const double *points, size_t count, double *area, double *length)
{
    *area = *length = 0.0;
    for (size_t i = 0; i < count; i++) {
        const double *const p = points + 3 * i, *const q = points + 3 * ((i + 1) % count);
        *area += 0.5 * (p[0] * q[1] - q[0] * p[1]);
        *length += hypot(q[0] - p[0], q[1] - p[1]);
    }
}

static crease_status add_loop(crease_context *context, const crease_scatter *scatter,
    const uint32_t *loop, size_t count, struct rings *rings)
{
    const double s = scatter->spacing;
    double *const points = crease_allocate(context, count, 6 * sizeof *points), area, length;
    if (!points)
        return CREASE_ERROR_NO_MEMORY;
    double *const normals = points + 3 * count;
    for (size_t i = 0; i < count; i++) {
        memcpy(points + 3 * i, scatter->places + 2 * (size_t)loop[i], 2 * sizeof *points);
        normals[3 * i + 2] = 1.0;
    }
    measure(points, count, &area, &length);
    crease_status status = CREASE_OK;
    if (length >= LEAST_LOOP * s && (area < 0.0 || area >= LEAST_ISLAND * s * s)) {
        const crease_rag rag = {
            .count = count, .points = points, .normals = normals, .closed = true, .spacing = s};
        status = crease_contour_fit(context, &rag, &rings->items[rings->count]);
        rings->count += status == CREASE_OK;
    }
    free(points);
    return status;
}

static crease_status find_rings(
    crease_context *context, const crease_scatter *scatter, double radius, struct rings *rings)
{
    crease_outline outline;
    crease_status status =
        crease_outline_find_flat(context, scatter->places, scatter->count, radius, &outline);
    if (status == CREASE_OK) {
        rings->items = crease_allocate(context, outline.loop_count, sizeof *rings->items);
        status = rings->items ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    }
    for (size_t i = 0; i < outline.loop_count && status == CREASE_OK; i++)
        status = add_loop(context, scatter, outline.points + outline.first[i],
            outline.first[i + 1] - outline.first[i], rings);
    crease_outline_clear(&outline);
    return status;
}

/* ----------------------------------------------------------------------------------- sides -- */

/* Sides in the order in which the border runs along them: y low, x high, y high, x low. */
static int across(int side)
{
    return 1 - side % 2;
}

static double value_of(const crease_scatter *scatter, int side)
{
    return side == 1 || side == 2 ? scatter->high[across(side)] : scatter->low[across(side)];
}

static double farthest(const crease_scatter *scatter, const crease_stretch *stretch, int side)
{
    double most = 0.0;
    for (size_t i = 0; i < stretch->count; i++)
        most = fmax(
            most, fabs(stretch->points[3 * i + (size_t)across(side)] - value_of(scatter, side)));
    return most;
}

/* The side that a stretch is, if any. */
static int side_of(const crease_scatter *scatter, const crease_stretch *stretch)
{
    for (int side = 0; side < SIDES; side++) {
        const int along = 1 - across(side);
        const double on =
            stretch->points[3 * (stretch->count - 1) + (size_t)along] - stretch->points[along];
        if (farthest(scatter, stretch, side) <= FULL * scatter->spacing &&
            (side < 2 ? on > 0.0 : on < 0.0))
            return side;
    }
    return NO_SIDE;
}

static bool is_beside(const crease_scatter *scatter, const double place[2])
{
    double least = INFINITY;
    for (int side = 0; side < SIDES; side++)
        least = fmin(least, fabs(place[across(side)] - value_of(scatter, side)));
    return least <= FULL * scatter->spacing;
}

/* Whether the places fill the rectangle: one ring, near the sides, and to all four corners. */
static bool is_full(const crease_scatter *scatter, const struct rings *rings)
{
    double corners[SIDES] = {INFINITY, INFINITY, INFINITY, INFINITY};
    if (rings->count != 1)
        return false;
    for (size_t i = 0; i < rings->items->count; i++)
        for (size_t k = 0; k < rings->items->items[i].count; k++) {
            const double *const p = rings->items->items[i].points + 3 * k;
            if (!is_beside(scatter, p))
                return false;
            for (int c = 0; c < SIDES; c++)
                corners[c] = fmin(corners[c],
                    hypot(p[0] - (c & 1 ? scatter->high[0] : scatter->low[0]),
                        p[1] - (c & 2 ? scatter->high[1] : scatter->low[1])));
        }
    for (int c = 0; c < SIDES; c++)
        if (corners[c] > FULL_CORNER * scatter->spacing)
            return false;
    return true;
}

/* ------------------------------------------------------------------------------------ arcs -- */

/* Keeps a place off the sides, smoothly and without changing the order of places. */
static void soften(const crease_scatter *scatter, const double from[2], double out[2])
{
    const double soft = SOFT * scatter->spacing;
    for (int d = 0; d < 2; d++) {
        double in = from[d] - scatter->low[d];
        in = 0.5 * (in + sqrt(in * in + 4.0 * soft * soft));
        in = scatter->high[d] - scatter->low[d] - in;
        in = 0.5 * (in + sqrt(in * in + 4.0 * soft * soft));
        out[d] = scatter->high[d] - in;
    }
}

/* The first place of a stretch, from one of its ends, that is clearly away from there. */
static const double *away_from(const crease_stretch *stretch, bool last, double distance)
{
    const size_t end = last ? stretch->count - 1 : 0;
    const double *const from = stretch->points + 3 * end, *p = from;
    for (size_t i = 1; i < stretch->count; i++) {
        p = stretch->points + 3 * (last ? end - i : i);
        if (hypot(p[0] - from[0], p[1] - from[1]) >= distance)
            break;
    }
    return p;
}

/* Where an arc that ends near a side comes to it. */
static void go_on_to_side(const crease_scatter *scatter, const crease_stretch *stretch, bool last,
    int side, double place[2])
{
    const double s = scatter->spacing, value = value_of(scatter, side);
    const double *const from = away_from(stretch, last, LOOK_BACK * s);
    const int d = across(side);
    const double on[2] = {place[0] - from[0], place[1] - from[1]};
    const double t = (value - place[d]) / on[d];
    if (fabs(on[d]) > LEAST_SLANT * hypot(on[0], on[1]) &&
        fabs(t) * hypot(on[0], on[1]) <= MOST_ON * s)
        place[1 - d] += t * on[1 - d];
    place[d] = value;
}

/* A corner that nearly is on a cut, and on which the border goes over it, is on the cut. */
static void move_to_cut(const crease_scatter *scatter, const crease_stretch *before,
    const crease_stretch *after, int d, double place[2])
{
    const double s = scatter->spacing;
    const double *const p = away_from(before, true, LOOK_BACK * s);
    const double *const q = away_from(after, false, LOOK_BACK * s);
    for (size_t i = 0; i < scatter->cuts.count[d]; i++) {
        const double at = scatter->cuts.at[d][i];
        if (fabs(place[d] - at) < NEAR_CUT * s && (p[d] > at) != (q[d] > at))
            place[d] = at;
    }
}

/* The place between two stretches; sides: those that they are. */
static void place_corner(const crease_scatter *scatter, const crease_stretch *before,
    const crease_stretch *after, const int sides[2], double place[2])
{
    place[0] = after->points[0];
    place[1] = after->points[1];
    if (sides[0] == NO_SIDE && sides[1] == NO_SIDE)
        soften(scatter, (double[]){place[0], place[1]}, place);
    else if (sides[0] == NO_SIDE)
        go_on_to_side(scatter, before, true, sides[1], place);
    else if (sides[1] == NO_SIDE)
        go_on_to_side(scatter, after, false, sides[0], place);
    for (int k = 0; k < 2; k++)
        if (sides[k] != NO_SIDE)
            place[across(sides[k])] = value_of(scatter, sides[k]);
    for (int d = 0; d < 2; d++) {
        const bool fixed = (sides[0] != NO_SIDE && across(sides[0]) == d) ||
            (sides[1] != NO_SIDE && across(sides[1]) == d);
        if (!fixed)
            move_to_cut(scatter, before, after, d, place);
        place[d] = fmin(fmax(place[d], scatter->low[d]), scatter->high[d]);
    }
}

static void append(crease_frontier *out, const double place[2])
{
    memcpy(out->places + 2 * out->place_count++, place, 2 * sizeof *place);
}

/* Whether a place lies ahead of an end, towards another place. */
static bool is_ahead(const double place[2], const double end[2], const double to[2], double guard)
{
    const double d[2] = {to[0] - end[0], to[1] - end[1]};
    return (place[0] - end[0]) * d[0] + (place[1] - end[1]) * d[1] > guard * hypot(d[0], d[1]);
}

static void add_arc(const crease_scatter *scatter, const crease_stretch *stretch, bool straight,
    const double first[2], const double last[2], crease_frontier *out)
{
    const double s = scatter->spacing;
    const double *const on = away_from(stretch, false, LOOK_BACK * s);
    const double *const back = away_from(stretch, true, LOOK_BACK * s);
    append(out, first);
    for (size_t i = 0; i < stretch->count && !straight; i++) {
        double place[2];
        soften(scatter, stretch->points + 3 * i, place);
        const bool early = hypot(place[0] - first[0], place[1] - first[1]) < LOOK_BACK * s;
        const bool late = hypot(place[0] - last[0], place[1] - last[1]) < LOOK_BACK * s;
        if ((!early || is_ahead(place, first, on, GUARD * s)) &&
            (!late || is_ahead(place, last, back, GUARD * s)))
            append(out, place);
    }
    append(out, last);
    out->first_place[++out->arc_count] = out->place_count;
}

/* A ring without a corner. */
static void add_round(
    const crease_scatter *scatter, const crease_stretch *stretch, crease_frontier *out)
{
    const size_t begin = out->place_count;
    for (size_t i = 0; i + 1 < stretch->count; i++) {
        double place[2];
        soften(scatter, stretch->points + 3 * i, place);
        append(out, place);
    }
    append(out, (double[]){out->places[2 * begin], out->places[2 * begin + 1]});
    out->first_place[++out->arc_count] = out->place_count;
}

static crease_status add_ring(crease_context *context, const crease_scatter *scatter,
    const crease_contour *ring, crease_frontier *out)
{
    const size_t n = ring->count;
    int *const sides = crease_allocate(context, n, sizeof *sides);
    double *const corners = crease_allocate(context, n, 2 * sizeof *corners);
    const crease_status status = sides && corners ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK && n == 1) {
        add_round(scatter, ring->items, out);
    } else if (status == CREASE_OK) {
        for (size_t i = 0; i < n; i++)
            sides[i] = side_of(scatter, &ring->items[i]);
        for (size_t i = 0; i < n; i++) {
            const size_t before = (i + n - 1) % n;
            place_corner(scatter, &ring->items[before], &ring->items[i],
                (int[]){sides[before], sides[i]}, corners + 2 * i);
        }
        for (size_t i = 0; i < n; i++)
            add_arc(scatter, &ring->items[i], sides[i] != NO_SIDE, corners + 2 * i,
                corners + 2 * ((i + 1) % n), out);
    }
    out->first_arc[++out->ring_count] = out->arc_count;
    free(sides);
    free(corners);
    return status;
}

static crease_status make_frontier(crease_context *context, const crease_scatter *scatter,
    const struct rings *rings, crease_frontier *out)
{
    size_t arcs = 0, places = 0;
    for (size_t i = 0; i < rings->count; i++) {
        arcs += rings->items[i].count;
        for (size_t k = 0; k < rings->items[i].count; k++)
            places += rings->items[i].items[k].count + 2;
    }
    crease_status status = crease_frontier_create(context, rings->count, arcs, places, out);
    out->ring_count = out->arc_count = out->place_count = 0;
    for (size_t i = 0; i < rings->count && status == CREASE_OK; i++)
        status = add_ring(context, scatter, &rings->items[i], out);
    return status;
}

/* -------------------------------------------------------------------------------- checking -- */

static double length_of(const crease_frontier *frontier)
{
    double length = 0.0;
    for (size_t a = 0; a < frontier->arc_count; a++)
        for (size_t k = frontier->first_place[a]; k + 1 < frontier->first_place[a + 1]; k++) {
            const double *const p = frontier->places + 2 * k;
            length += hypot(p[2] - p[0], p[3] - p[1]);
        }
    return length;
}

/* Whether the border encloses nearly all places. */
static bool encloses_most(const crease_scatter *scatter, const crease_frontier *frontier)
{
    const size_t step = scatter->count / PROBES + 1;
    size_t inside = 0, probes = 0;
    for (size_t i = 0; i < scatter->count; i += step, probes++) {
        const double *const at = scatter->places + 2 * i;
        bool in = false;
        for (size_t a = 0; a < frontier->arc_count; a++)
            for (size_t k = frontier->first_place[a]; k + 1 < frontier->first_place[a + 1]; k++) {
                const double *const p = frontier->places + 2 * k, *const q = p + 2;
                if ((p[1] > at[1]) != (q[1] > at[1]) &&
                    at[0] < p[0] + (at[1] - p[1]) / (q[1] - p[1]) * (q[0] - p[0]))
                    in = !in;
            }
        inside += in;
    }
    const double along = length_of(frontier) / scatter->spacing / (double)scatter->count;
    return (double)(probes - inside) <= (OUTSIDE + BESIDE * along) * (double)probes;
}

crease_status crease_fringe_find(crease_context *context, const crease_scatter *scatter,
    double radius, crease_frontier *out, crease_fringe_state *state)
{
    struct rings rings = {.count = 0};
    bool simple = false;
    *out = (crease_frontier){.ring_count = 0};
    *state = CREASE_FRINGE_LOST;
    crease_status status = find_rings(context, scatter, radius, &rings);
    if (status == CREASE_OK && is_full(scatter, &rings)) {
        *state = CREASE_FRINGE_FULL;
    } else if (status == CREASE_OK && rings.count > 0) {
        status = make_frontier(context, scatter, &rings, out);
        if (status == CREASE_OK)
            status = crease_frontier_is_simple(context, out, &simple);
        if (status == CREASE_OK && simple && encloses_most(scatter, out))
            *state = CREASE_FRINGE_FOUND;
    }
    if (*state != CREASE_FRINGE_FOUND)
        crease_frontier_clear(out);
    clear_rings(&rings);
    return status;
}

crease_status crease_fringe_of_rectangle(
    crease_context *context, const crease_scatter *scatter, crease_frontier *out)
{
    const double *const low = scatter->low, *const high = scatter->high;
    const double corners[][2] = {{low[0], low[1]}, {high[0], low[1]}, {high[0], high[1]},
        {low[0], high[1]}, {low[0], low[1]}};
    const crease_status status = crease_frontier_create(context, 1, SIDES, 2 * SIDES, out);
    if (status != CREASE_OK)
        return status;
    out->first_arc[1] = SIDES;
    for (size_t i = 0; i < SIDES; i++) {
        memcpy(out->places + 4 * i, corners[i], sizeof corners[i]);
        memcpy(out->places + 4 * i + 2, corners[i + 1], sizeof corners[i]);
        out->first_place[i + 1] = 2 * (i + 1);
    }
    return CREASE_OK;
}
