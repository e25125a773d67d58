/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/turn.h"

#include "base/memory.h"
#include "base/vector.h"
#include "topology/loop.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ANGLES = 64, BISECTIONS = 60 };

static const double TURN = 6.283185307179586476925;
static const double SAME_ANGLE = 1e-6;
static const double CLEAR = 0.05;  /* radians from holes that a vertex must be to be chosen */
static const double BESIDE = 0.05; /* spacings from a point to one that takes its place */

/* ------------------------------------------------------------------------- cutting edges -- */

/* Lets a closed edge without vertex begin at its point number i. */
static crease_status begin_edge_at(crease_graph *graph, size_t index, size_t i, int32_t *vertex)
{
    crease_edge *const edge = &graph->topology->edges[index];
    edge->count--;
    for (size_t k = 0; k < i % edge->count; k++) {
        double first[3];
        memcpy(first, edge->points, sizeof first);
        memmove(edge->points, edge->points + 3, 3 * (edge->count - 1) * sizeof *first);
        memcpy(edge->points + 3 * (edge->count - 1), first, sizeof first);
    }
    crease_status status = crease_edge_append(graph->context, edge, edge->points);
    if (status == CREASE_OK)
        status = crease_graph_vertex(graph, edge->points, vertex);
    if (status == CREASE_OK)
        edge->vertices[0] = edge->vertices[1] = *vertex;
    return status;
}

/* Cuts an edge in two at its point number i. */
static crease_status split_edge(crease_graph *graph, size_t index, size_t i, int32_t *vertex)
{
    crease_topology *const t = graph->topology;
    crease_edge rest = t->edges[index];
    rest.points = crease_duplicate(
        graph->context, rest.points + 3 * i, rest.count - i, 3 * sizeof *rest.points);
    if (!rest.points)
        return CREASE_ERROR_NO_MEMORY;
    rest.count = rest.room = rest.count - i;
    rest.closed = false;
    crease_status status = crease_graph_vertex(graph, rest.points, vertex);
    if (status != CREASE_OK) {
        crease_edge_clear(&rest);
        return status;
    }
    rest.vertices[0] = *vertex;
    t->edges[index].vertices[1] = *vertex;
    t->edges[index].count = i + 1;
    t->edges[index].closed = false;
    return crease_graph_take(graph, &rest);
}

static crease_status cut_edge(crease_graph *graph, size_t index, size_t i, int32_t *vertex)
{
    return graph->topology->edges[index].vertices[0] == CREASE_NO_VERTEX
        ? begin_edge_at(graph, index, i, vertex)
        : split_edge(graph, index, i, vertex);
}

/* --------------------------------------------------------------------------- cutting rims -- */

/* A place of the parameter that runs round on one region's chart. */
struct cut {
    const crease_chart *chart;
    int direction;
    double angle;
};

static double angle_of(const struct cut *cut, const double place[3])
{
    double uv[2];
    crease_chart_at(cut->chart, place, uv);
    return uv[cut->direction];
}

/* The vertex of the loop at the angle, if it has one. */
static int32_t vertex_at(const crease_graph *graph, const crease_loop *loop, const struct cut *cut)
{
    for (size_t i = 0; i < loop->count; i++) {
        const int32_t v = crease_half_vertex(graph, loop->halves[i], 0);
        if (v == CREASE_NO_VERTEX)
            continue;
        const double angle = angle_of(cut, graph->topology->vertices[v].place);
        if (fabs(crease_chart_near(angle, cut->angle) - cut->angle) < SAME_ANGLE)
            return v;
    }
    return CREASE_NO_VERTEX;
}

/* Angles of two consecutive points, the second within half a turn of the first, and the cut's. */
struct passage {
    double from, to, target;
};

static bool passes(const struct cut *cut, const double *points, struct passage *at)
{
    at->from = angle_of(cut, points);
    at->to = crease_chart_near(angle_of(cut, points + 3), at->from);
    at->target = crease_chart_near(cut->angle, 0.5 * (at->from + at->to));
    return (at->from <= at->target && at->target < at->to) ||
        (at->to < at->target && at->target <= at->from);
}

/* The place between two points of an edge, on its surfaces, that is at the angle. */
static void place_between(const crease_graph *graph, const crease_edge *edge, const struct cut *cut,
    size_t i, const struct passage *at, double place[3])
{
    const double *const a = edge->points + 3 * i, *const b = a + 3;
    double along[3], low = 0.0, high = 1.0;
    for (int c = 0; c < 3; c++)
        along[c] = b[c] - a[c];
    crease_vector_normalise(along);
    for (int k = 0; k < BISECTIONS; k++) {
        const double share = 0.5 * (low + high);
        for (int c = 0; c < 3; c++)
            place[c] = a[c] + share * (b[c] - a[c]);
        crease_graph_onto(graph, edge, along, place);
        const double angle = crease_chart_near(angle_of(cut, place), at->target);
        if ((angle < at->target) == (at->from < at->to))
            low = share;
        else
            high = share;
    }
}

/* Makes a place a point of the edge, between numbers i and i + 1 or instead of one of them; its
 * number goes to *at. */
static crease_status put_point(
    crease_graph *graph, crease_edge *edge, size_t i, const double place[3], size_t *at)
{
    const double beside = BESIDE * graph->survey->spacing;
    const bool free_ends = edge->vertices[0] == CREASE_NO_VERTEX;
    *at = i + 1;
    if (crease_vector_distance(edge->points + 3 * i, place) < beside && (i > 0 || free_ends))
        *at = i;
    else if (!(crease_vector_distance(edge->points + 3 * i + 3, place) < beside &&
                 i + 2 < edge->count))
        return crease_edge_insert(graph->context, edge, i + 1, place);
    memcpy(edge->points + 3 * *at, place, 3 * sizeof *place);
    if (*at == 0)
        memcpy(edge->points + 3 * (edge->count - 1), place, 3 * sizeof *place);
    return CREASE_OK;
}

/* Puts a vertex on the loop's edges at the angle, unless it has one there. None when the loop does
 * not pass the angle. */
static crease_status cut_loop(
    crease_graph *graph, const crease_loop *loop, const struct cut *cut, int32_t *vertex)
{
    *vertex = vertex_at(graph, loop, cut);
    for (size_t h = 0; h < loop->count && *vertex == CREASE_NO_VERTEX; h++) {
        crease_edge *const edge = &graph->topology->edges[loop->halves[h].edge];
        struct passage at;
        size_t i = 0, number = 0;
        while (i + 1 < edge->count && !passes(cut, edge->points + 3 * i, &at))
            i++;
        if (i + 1 >= edge->count)
            continue;
        double place[3];
        place_between(graph, edge, cut, i, &at, place);
        crease_status status = put_point(graph, edge, i, place, &number);
        if (status == CREASE_OK)
            status = cut_edge(graph, loop->halves[h].edge, number, vertex);
        return status;
    }
    return CREASE_OK;
}

/* -------------------------------------------------------------------------------- seams -- */

/* Loops that run round in the direction, or in the other one. */
static bool is_rim(const crease_loop *loop)
{
    return loop->turns[0] != 0 || loop->turns[1] != 0;
}

static bool has_vertex(const crease_graph *graph, const crease_loop *loop, int32_t vertex)
{
    for (size_t i = 0; i < loop->count; i++)
        if (crease_half_vertex(graph, loop->halves[i], 0) == vertex)
            return true;
    return false;
}

/* How far an angle is from all holes of the face, at most 3. */
static double clearance(const crease_loops *loops, int direction, double angle)
{
    double least = 3.0;
    for (size_t i = 0; i < loops->count; i++)
        for (size_t k = 0; k < loops->items[i].uv_count && !is_rim(&loops->items[i]); k++) {
            const double at = loops->items[i].uv[2 * k + (size_t)direction];
            least = fmin(least, fabs(crease_chart_near(at, angle) - angle));
        }
    return least;
}

/* The angle farthest from holes; that of a rim's vertex rather than another. A tube's is 0: its
 * chart cannot be turned. */
static double choose_angle(const crease_graph *graph, const crease_loops *loops, struct cut cut)
{
    double best = -1.0, chosen = 0.0;
    bool vertex = false;
    if (cut.direction == 1)
        return 0.0;
    for (size_t i = 0; i < loops->count; i++)
        for (size_t h = 0; h < loops->items[i].count && is_rim(&loops->items[i]); h++) {
            const int32_t v = crease_half_vertex(graph, loops->items[i].halves[h], 0);
            if (v == CREASE_NO_VERTEX)
                continue;
            const double angle = angle_of(&cut, graph->topology->vertices[v].place);
            const double clear = clearance(loops, cut.direction, angle);
            if (clear > CLEAR && clear > best) {
                vertex = true;
                best = clear;
                chosen = angle;
            }
        }
    for (int i = 0; i < ANGLES && !vertex; i++) {
        const double angle = TURN * i / ANGLES, clear = clearance(loops, cut.direction, angle);
        if (clear > best) {
            best = clear;
            chosen = angle;
        }
    }
    return chosen;
}

static const crease_loop *next_rim(
    const crease_graph *graph, const crease_loops *loops, int32_t without)
{
    for (size_t i = 0; i < loops->count; i++)
        if (is_rim(&loops->items[i]) &&
            (without == CREASE_NO_VERTEX || !has_vertex(graph, &loops->items[i], without)))
            return &loops->items[i];
    return NULL;
}

/* Cuts the rims of a region, the loops being those before. */
static crease_status cut_rims(
    crease_graph *graph, uint32_t region, const crease_loops *loops, int32_t seam[2])
{
    crease_chart *const chart = &graph->topology->charts[region];
    const crease_loop *const first = next_rim(graph, loops, CREASE_NO_VERTEX);
    struct cut cut = {chart, first->turns[0] != 0 ? 0 : 1, 0.0};
    crease_loops after;
    bool closed;
    cut.angle = choose_angle(graph, loops, cut);
    crease_status status = cut_loop(graph, first, &cut, &seam[0]);
    if (status != CREASE_OK || seam[0] == CREASE_NO_VERTEX)
        return status;
    status = crease_loops_of(graph, region, &after, &closed);
    const crease_loop *const second = status == CREASE_OK ? next_rim(graph, &after, seam[0]) : NULL;
    if (second)
        status = cut_loop(graph, second, &cut, &seam[1]);
    crease_loops_clear(&after);
    if (cut.direction == 0)
        crease_chart_begin_at(chart, graph->topology->vertices[seam[0]].place);
    return status;
}

/* Faces whose seam is free to be anywhere wait until their neighbours about the same axis, which
 * may not be, have theirs. */
static bool may_wait(const crease_graph *graph, uint32_t region, const crease_loops *loops)
{
    const crease_topology *const t = graph->topology;
    bool beside = false;
    for (size_t i = 0; i < loops->count; i++) {
        if (!is_rim(&loops->items[i]))
            return false;
        for (size_t h = 0; h < loops->items[i].count; h++) {
            const crease_edge *const edge = &t->edges[loops->items[i].halves[h].edge];
            const uint32_t other = edge->regions[edge->regions[0] == region];
            if (crease_edge_is_rim(edge))
                continue;
            if (edge->vertices[0] != CREASE_NO_VERTEX)
                return false;
            beside = beside || crease_chart_turns(&t->charts[other], 0);
        }
    }
    return beside;
}

static crease_status make_seam(crease_graph *graph, uint32_t region, bool waiting, int32_t seam[2])
{
    crease_loops loops;
    bool closed;
    crease_status status = crease_loops_of(graph, region, &loops, &closed);
    if (status == CREASE_OK && next_rim(graph, &loops, CREASE_NO_VERTEX) &&
        !(waiting && may_wait(graph, region, &loops)))
        status = cut_rims(graph, region, &loops, seam);
    crease_loops_clear(&loops);
    return status;
}

crease_status crease_turns_cut(crease_graph *graph, int32_t *seams)
{
    const crease_topology *const t = graph->topology;
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < 2 * t->region_count; i++)
        seams[i] = CREASE_NO_VERTEX;
    for (int round = 0; round < 2; round++)
        for (size_t i = 0; i < t->region_count && status == CREASE_OK; i++)
            if (crease_chart_turns(&t->charts[i], 0) && seams[2 * i] == CREASE_NO_VERTEX)
                status = make_seam(graph, (uint32_t)i, round == 0, seams + 2 * i);
    for (size_t i = 0; i < t->edge_count && status == CREASE_OK; i++) {
        int32_t vertex;
        if (t->edges[i].closed && t->edges[i].vertices[0] == CREASE_NO_VERTEX)
            status = begin_edge_at(graph, i, 0, &vertex);
    }
    return status;
}
