/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/face.h"

#include "base/memory.h"
#include "topology/loop.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double HALF_TURN = 3.141592653589793238463;

/* -------------------------------------------------------------------------------- lists -- */

/* Adds a face; the loops are moved to it from `loops`, in the order given. */
static crease_status add_face(crease_graph *graph, const crease_face *face, crease_loops *loops,
    const size_t *order, size_t count)
{
    crease_topology *const t = graph->topology;
    if (t->face_count == t->face_room) {
        const size_t room = 2 * t->face_room + 16;
        crease_face *const faces = crease_reallocate(graph->context, t->faces, room, sizeof *faces);
        if (!faces)
            return CREASE_ERROR_NO_MEMORY;
        t->faces = faces;
        t->face_room = room;
    }
    crease_face *const to = &t->faces[t->face_count];
    *to = *face;
    to->loops = crease_allocate(graph->context, count, sizeof *to->loops);
    if (!to->loops)
        return CREASE_ERROR_NO_MEMORY;
    t->face_count++;
    to->loop_count = count;
    for (size_t i = 0; i < count; i++) {
        to->loops[i] = loops->items[order[i]];
        loops->items[order[i]] = (crease_loop){.count = 0};
    }
    return CREASE_OK;
}

/* ------------------------------------------------------------------------------ patches -- */

static bool is_inside(const double at[2], const crease_loop *loop)
{
    bool in = false;
    for (size_t i = 0; i + 1 < loop->uv_count; i++) {
        const double *const a = loop->uv + 2 * i, *const b = a + 2;
        if ((a[1] > at[1]) != (b[1] > at[1]) &&
            at[0] < a[0] + (at[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
            in = !in;
    }
    return in;
}

/* Whether most of a loop is inside another. */
static bool lies_in(const crease_loop *inner, const crease_loop *outer)
{
    size_t in = 0;
    if (fabs(inner->area) >= fabs(outer->area))
        return false;
    for (size_t i = 0; i < inner->uv_count; i++)
        in += is_inside(inner->uv + 2 * i, outer);
    return 2 * in > inner->uv_count;
}

static size_t depth_of(const crease_loops *loops, size_t i)
{
    size_t depth = 0;
    for (size_t k = 0; k < loops->count; k++)
        depth += k != i && lies_in(&loops->items[i], &loops->items[k]);
    return depth;
}

static void turn_to(crease_loop *loop, bool anticlockwise)
{
    if ((loop->area > 0.0) != anticlockwise)
        crease_loop_reverse(loop);
}

/* A face for each loop at an even depth; those one deeper and inside it are its holes. */
static crease_status make_patches(
    crease_graph *graph, uint32_t region, crease_loops *loops, size_t *depths, size_t *order)
{
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < loops->count; i++)
        depths[i] = depth_of(loops, i);
    for (size_t i = 0; i < loops->count && status == CREASE_OK; i++) {
        if (depths[i] % 2 == 1)
            continue;
        size_t count = 0;
        order[count++] = i;
        turn_to(&loops->items[i], true);
        for (size_t k = 0; k < loops->count; k++)
            if (depths[k] == depths[i] + 1 && lies_in(&loops->items[k], &loops->items[i])) {
                order[count++] = k;
                turn_to(&loops->items[k], false);
            }
        const crease_face face = {.region = region,
            .kind = CREASE_FACE_PATCH,
            .seam = {CREASE_NO_VERTEX, CREASE_NO_VERTEX}};
        status = add_face(graph, &face, loops, order, count);
    }
    return status;
}

/* ----------------------------------------------------------------------- all the way round -- */

/* Turns a rim to the direction, lets it begin at the seam and its parameter there be 0, or a whole
 * turn where it runs backwards. */
static crease_status set_rim(const crease_graph *graph, const crease_face *face, crease_loop *rim,
    bool forward, int32_t seam)
{
    const int d = face->direction;
    if ((rim->turns[d] > 0) != forward)
        crease_loop_reverse(rim);
    if (!crease_loop_begin_at(graph, rim, seam))
        return CREASE_OK;
    const crease_status status =
        crease_loop_measure(graph, &graph->topology->charts[face->region], rim);
    if (status == CREASE_OK)
        crease_loop_shift(
            rim, d, crease_chart_near(rim->uv[d], forward ? 0.0 : 2 * HALF_TURN) - rim->uv[d]);
    return status;
}

/* Mean of v of the region's points, to tell which pole the face has. */
static double mean_height(const crease_graph *graph, uint32_t region)
{
    const crease_regions *const r = graph->survey->regions;
    double sum = 0.0, count = 0.0;
    for (size_t i = 0; i < r->count; i++) {
        double uv[2];
        if (r->labels[i] != (int32_t)region)
            continue;
        crease_chart_at(&graph->topology->charts[region], r->points + 3 * i, uv);
        sum += uv[1];
        count += 1.0;
    }
    return count > 0.0 ? sum / count : 0.0;
}

/* Holes and rims of one region; the order in which its face takes them. */
struct sorted {
    size_t rims, count;
    size_t *order;
};

static struct sorted sort_loops(const crease_loops *loops, int direction, size_t *order)
{
    struct sorted out = {.order = order};
    for (size_t i = 0; i < loops->count; i++)
        if (loops->items[i].turns[direction] != 0)
            order[out.count++] = i;
    out.rims = out.count;
    for (size_t i = 0; i < loops->count; i++)
        if (loops->items[i].turns[direction] == 0)
            order[out.count++] = i;
    const int other = 1 - direction;
    if (out.rims == 2 &&
        crease_loop_mean(&loops->items[order[0]], other) >
            crease_loop_mean(&loops->items[order[1]], other)) {
        const size_t first = order[0];
        order[0] = order[1];
        order[1] = first;
    }
    return out;
}

static bool passes_vertex(const crease_graph *graph, const crease_loop *loop, int32_t vertex)
{
    for (size_t i = 0; i < loop->count; i++)
        if (crease_half_vertex(graph, loop->halves[i], 0) == vertex)
            return true;
    return false;
}

static crease_status set_rims(
    const crease_graph *graph, crease_face *face, crease_loops *loops, const struct sorted *sorted)
{
    crease_loop *const first = &loops->items[sorted->order[0]];
    if (sorted->rims == 1) {
        const double v = crease_loop_mean(first, 1);
        face->upper = face->kind == CREASE_FACE_CAP &&
            graph->topology->charts[face->region].type == CREASE_REGION_SPHERE &&
            mean_height(graph, face->region) > v;
        return set_rim(graph, face, first, face->upper, face->seam[0]);
    }
    if (!passes_vertex(graph, first, face->seam[0])) {
        const int32_t kept = face->seam[0];
        face->seam[0] = face->seam[1];
        face->seam[1] = kept;
    }
    const bool forward = face->direction == 0; /* the low rim, the face on its left */
    crease_status status = set_rim(graph, face, first, forward, face->seam[0]);
    if (status == CREASE_OK)
        status = set_rim(graph, face, &loops->items[sorted->order[1]], !forward, face->seam[1]);
    return status;
}

static crease_status make_round(
    crease_graph *graph, uint32_t region, crease_loops *loops, const int32_t seam[2], size_t *order)
{
    const crease_region_type type = graph->topology->charts[region].type;
    crease_face face = {.region = region, .kind = CREASE_FACE_BAND, .seam = {seam[0], seam[1]}};
    for (size_t i = 0; i < loops->count; i++)
        face.direction = loops->items[i].turns[1] != 0 ? 1 : face.direction;
    const struct sorted sorted = sort_loops(loops, face.direction, order);
    const bool pole =
        (type == CREASE_REGION_SPHERE || type == CREASE_REGION_CONE) && sorted.rims == 1;
    if ((!pole && sorted.rims != 2) || seam[0] == CREASE_NO_VERTEX ||
        (!pole && seam[1] == CREASE_NO_VERTEX)) {
        graph->topology->open[region] = true;
        return CREASE_OK;
    }
    face.kind = pole ? CREASE_FACE_CAP : CREASE_FACE_BAND;
    for (size_t i = sorted.rims; i < sorted.count; i++)
        turn_to(&loops->items[order[i]], false);
    crease_status status = set_rims(graph, &face, loops, &sorted);
    if (status == CREASE_OK)
        status = add_face(graph, &face, loops, order, sorted.count);
    return status;
}

/* -------------------------------------------------------------------------------- faces -- */

/* Holes and patches have their u around half a turn, where the chart has its middle. */
static void centre_loops(const crease_chart *chart, crease_loops *loops)
{
    for (size_t i = 0; i < loops->count && crease_chart_turns(chart, 0); i++) {
        crease_loop *const loop = &loops->items[i];
        const double mean = crease_loop_mean(loop, 0);
        if (loop->turns[0] == 0)
            crease_loop_shift(loop, 0, crease_chart_near(mean, HALF_TURN) - mean);
    }
}

static crease_status make_faces(
    crease_graph *graph, uint32_t region, crease_loops *loops, const int32_t seam[2])
{
    const crease_chart *const chart = &graph->topology->charts[region];
    const bool endless = chart->type == CREASE_REGION_SPHERE || chart->type == CREASE_REGION_TORUS;
    const crease_face whole = {
        .region = region, .kind = CREASE_FACE_WHOLE, .seam = {CREASE_NO_VERTEX, CREASE_NO_VERTEX}};
    bool round = false;
    for (size_t i = 0; i < loops->count; i++)
        round = round || loops->items[i].turns[0] != 0 || loops->items[i].turns[1] != 0;
    if (loops->count == 0 && endless)
        return add_face(graph, &whole, loops, NULL, 0);
    graph->topology->open[region] = loops->count == 0;
    size_t *const order = crease_allocate(graph->context, 2 * loops->count, sizeof *order);
    if (!order)
        return CREASE_ERROR_NO_MEMORY;
    centre_loops(chart, loops);
    const crease_status status = round
        ? make_round(graph, region, loops, seam, order)
        : make_patches(graph, region, loops, order + loops->count, order);
    free(order);
    return status;
}

static bool has_no_points(const crease_graph *graph, int32_t region)
{
    const crease_regions *const r = graph->survey->regions;
    size_t i = 0;
    while (i < r->count && r->labels[i] != region)
        i++;
    return i == r->count;
}

crease_status crease_faces_make(crease_graph *graph, const int32_t *seams)
{
    crease_topology *const t = graph->topology;
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < t->region_count && status == CREASE_OK; i++) {
        crease_loops loops;
        bool closed;
        status = crease_loops_of(graph, (uint32_t)i, &loops, &closed);
        const bool bare = loops.count == 0 && has_no_points(graph, (int32_t)i);
        t->open[i] = !closed && !bare;
        if (status == CREASE_OK && closed && !bare)
            status = make_faces(graph, (uint32_t)i, &loops, seams + 2 * i);
        crease_loops_clear(&loops);
    }
    return status;
}
