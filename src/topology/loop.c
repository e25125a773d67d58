/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/loop.h"

#include "base/memory.h"
#include "base/vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double TURN = 6.283185307179586476925;
static const double LOOK_AHEAD = 1.5; /* spacings: how far off the direction of an edge is taken */

int32_t crease_half_vertex(const crease_graph *graph, crease_half half, int end)
{
    return graph->topology->edges[half.edge].vertices[half.reversed ? 1 - end : end];
}

/* Point number i of an edge in the direction of the half. */
static const double *half_point(const crease_graph *graph, crease_half half, size_t i)
{
    const crease_edge *const edge = &graph->topology->edges[half.edge];
    return edge->points + 3 * (half.reversed ? edge->count - 1 - i : i);
}

/* ---------------------------------------------------------------------------------- lists -- */

void crease_loops_clear(crease_loops *loops)
{
    for (size_t i = 0; i < loops->count; i++)
        crease_loop_clear(&loops->items[i]);
    free(loops->items);
    *loops = (crease_loops){.count = 0};
}

static crease_status take_loop(crease_context *context, crease_loops *loops, crease_loop *loop)
{
    if (loops->count == loops->room) {
        const size_t room = 2 * loops->room + 4;
        crease_loop *const items = crease_reallocate(context, loops->items, room, sizeof *items);
        if (!items)
            return CREASE_ERROR_NO_MEMORY;
        loops->items = items;
        loops->room = room;
    }
    loops->items[loops->count++] = *loop;
    *loop = (crease_loop){.count = 0};
    return CREASE_OK;
}

/* -------------------------------------------------------------------------------- walking -- */

/* The edges of a region, those that a loop has passed already marked. */
struct walk {
    const crease_graph *graph;
    uint32_t region;
    size_t count;
    uint32_t *edges;
    bool *passed;
    crease_half *path; /* room for all */
};

/* Unit direction of a half edge at its beginning. */
static void departure(const crease_graph *graph, crease_half half, double out[3])
{
    const size_t count = graph->topology->edges[half.edge].count;
    const double *const from = half_point(graph, half, 0);
    size_t i = 1;
    while (i + 1 < count &&
        crease_vector_distance(half_point(graph, half, i), from) <
            LOOK_AHEAD * graph->survey->spacing)
        i++;
    for (int c = 0; c < 3; c++)
        out[c] = half_point(graph, half, i)[c] - from[c];
    crease_vector_normalise(out);
}

/* The angle by which a path that came along `last` goes on along `next`, to the left: the sharpest
 * corner has the least. */
static double turn_between(const struct walk *walk, crease_half last, crease_half next)
{
    const crease_half back = {last.edge, !last.reversed};
    double in[3], out[3], normal[3], cross[3];
    departure(walk->graph, back, in);
    departure(walk->graph, next, out);
    crease_graph_distance(walk->graph, walk->region, half_point(walk->graph, next, 0), normal);
    crease_vector_cross(out, in, cross);
    const double angle = atan2(crease_vector_dot(cross, normal), crease_vector_dot(in, out));
    return angle <= 0.0 ? angle + TURN : angle;
}

/* The next half edge after the last of the path; false when there is none. */
static bool go_on(const struct walk *walk, crease_half last, size_t *index, crease_half *next)
{
    const int32_t vertex = crease_half_vertex(walk->graph, last, 1);
    double least = INFINITY;
    for (size_t i = 0; i < walk->count; i++)
        for (int w = 0; w < 2 && !walk->passed[i]; w++) {
            const crease_half half = {walk->edges[i], w == 1};
            if (crease_half_vertex(walk->graph, half, 0) != vertex)
                continue;
            const double turn = turn_between(walk, last, half);
            if (turn < least) {
                least = turn;
                *index = i;
                *next = half;
            }
        }
    return least < INFINITY;
}

/* Follows the edges from one on; the number of halves of the loop, 0 when it does not close. */
static size_t follow(struct walk *walk, size_t index)
{
    const crease_topology *const t = walk->graph->topology;
    crease_half half = {walk->edges[index], false};
    const int32_t start = crease_half_vertex(walk->graph, half, 0);
    for (size_t count = 0; count < walk->count;) {
        walk->passed[index] = true;
        walk->path[count++] = half;
        if (t->edges[half.edge].closed || crease_half_vertex(walk->graph, half, 1) == start)
            return count;
        if (!go_on(walk, half, &index, &half))
            return 0;
    }
    return 0;
}

static crease_status begin_walk(const crease_graph *graph, uint32_t region, struct walk *walk)
{
    const crease_topology *const t = graph->topology;
    *walk = (struct walk){.graph = graph, .region = region};
    walk->edges = crease_allocate(graph->context, t->edge_count, sizeof *walk->edges);
    walk->passed = crease_allocate(graph->context, t->edge_count, sizeof *walk->passed);
    walk->path = crease_allocate(graph->context, t->edge_count, sizeof *walk->path);
    if (!walk->edges || !walk->passed || !walk->path)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < t->edge_count; i++)
        if (crease_edge_has(&t->edges[i], region))
            walk->edges[walk->count++] = (uint32_t)i;
    return CREASE_OK;
}

static crease_status walk_all(struct walk *walk, crease_loops *out, bool *closed)
{
    crease_context *const context = walk->graph->context;
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < walk->count && status == CREASE_OK && *closed; i++) {
        if (walk->passed[i])
            continue;
        crease_loop loop = {.count = follow(walk, i)};
        *closed = loop.count > 0;
        loop.halves = crease_duplicate(context, walk->path, loop.count, sizeof *loop.halves);
        status = loop.halves ? take_loop(context, out, &loop) : CREASE_ERROR_NO_MEMORY;
        crease_loop_clear(&loop);
    }
    return status;
}

crease_status crease_loops_walk(
    const crease_graph *graph, uint32_t region, crease_loops *out, bool *closed)
{
    struct walk walk;
    *out = (crease_loops){.count = 0};
    *closed = true;
    crease_status status = begin_walk(graph, region, &walk);
    if (status == CREASE_OK)
        status = walk_all(&walk, out, closed);
    if (status != CREASE_OK || !*closed)
        crease_loops_clear(out);
    free(walk.edges);
    free(walk.passed);
    free(walk.path);
    return status;
}

/* ------------------------------------------------------------------------------ measuring -- */

/* All points along a loop, the first once more at the end. */
static double *points_along(const crease_graph *graph, const crease_loop *loop, size_t *count)
{
    size_t total = 0;
    for (size_t i = 0; i < loop->count; i++)
        total += graph->topology->edges[loop->halves[i].edge].count;
    double *const points = crease_allocate(graph->context, total + 1, 3 * sizeof *points);
    *count = 0;
    if (!points)
        return NULL;
    for (size_t i = 0; i < loop->count; i++)
        for (size_t k = 0; k < graph->topology->edges[loop->halves[i].edge].count; k++)
            memcpy(
                points + 3 * (*count)++, half_point(graph, loop->halves[i], k), 3 * sizeof *points);
    memcpy(points + 3 * (*count)++, points, 3 * sizeof *points);
    return points;
}

crease_status crease_loop_measure(
    const crease_graph *graph, const crease_chart *chart, crease_loop *loop)
{
    double *const points = points_along(graph, loop, &loop->uv_count);
    free(loop->uv);
    loop->uv = crease_allocate(graph->context, loop->uv_count, 2 * sizeof *loop->uv);
    if (!points || !loop->uv) {
        free(points);
        return CREASE_ERROR_NO_MEMORY;
    }
    crease_chart_along(chart, points, loop->uv_count, loop->uv);
    free(points);
    const double *const uv = loop->uv, *const last = uv + 2 * (loop->uv_count - 1);
    for (int d = 0; d < 2; d++)
        loop->turns[d] = crease_chart_turns(chart, d) ? (int)lround((last[d] - uv[d]) / TURN) : 0;
    loop->area = 0.0;
    for (const double *p = uv; p < last; p += 2)
        loop->area += 0.5 * (p[0] * p[3] - p[1] * p[2]);
    return CREASE_OK;
}

crease_status crease_loops_of(
    const crease_graph *graph, uint32_t region, crease_loops *out, bool *closed)
{
    crease_status status = crease_loops_walk(graph, region, out, closed);
    for (size_t i = 0; i < out->count && status == CREASE_OK; i++)
        status = crease_loop_measure(graph, &graph->topology->charts[region], &out->items[i]);
    if (status != CREASE_OK)
        crease_loops_clear(out);
    return status;
}

void crease_loop_reverse(crease_loop *loop)
{
    for (size_t i = 0, j = loop->count; i < j; i++) {
        const crease_half kept = loop->halves[i];
        j--;
        loop->halves[i] = (crease_half){loop->halves[j].edge, !loop->halves[j].reversed};
        loop->halves[j] = (crease_half){kept.edge, !kept.reversed};
    }
    for (size_t i = 0, j = loop->uv_count; i + 1 < j; i++) {
        j--;
        for (size_t d = 0; d < 2; d++) {
            const double kept = loop->uv[2 * i + d];
            loop->uv[2 * i + d] = loop->uv[2 * j + d];
            loop->uv[2 * j + d] = kept;
        }
    }
    for (int d = 0; d < 2; d++)
        loop->turns[d] = -loop->turns[d];
    loop->area = -loop->area;
}

bool crease_loop_begin_at(const crease_graph *graph, crease_loop *loop, int32_t vertex)
{
    size_t tried = 0;
    for (; crease_half_vertex(graph, loop->halves[0], 0) != vertex; tried++) {
        if (tried == loop->count)
            return false;
        const crease_half first = loop->halves[0];
        memmove(loop->halves, loop->halves + 1, (loop->count - 1) * sizeof first);
        loop->halves[loop->count - 1] = first;
    }
    return true;
}

void crease_loop_shift(crease_loop *loop, int direction, double by)
{
    for (size_t i = 0; i < loop->uv_count; i++)
        loop->uv[2 * i + (size_t)direction] += by;
}

double crease_loop_mean(const crease_loop *loop, int direction)
{
    double sum = 0.0;
    for (size_t i = 0; i < loop->uv_count; i++)
        sum += loop->uv[2 * i + (size_t)direction];
    return sum / (double)loop->uv_count;
}

void crease_loop_area_vector(const crease_graph *graph, const crease_loop *loop, double out[3])
{
    const double *const origin = half_point(graph, loop->halves[0], 0);
    memset(out, 0, 3 * sizeof *out);
    for (size_t i = 0; i < loop->count; i++)
        for (size_t k = 0; k + 1 < graph->topology->edges[loop->halves[i].edge].count; k++) {
            double a[3], b[3], cross[3];
            for (int c = 0; c < 3; c++) {
                a[c] = half_point(graph, loop->halves[i], k)[c] - origin[c];
                b[c] = half_point(graph, loop->halves[i], k + 1)[c] - origin[c];
            }
            crease_vector_cross(a, b, cross);
            for (int c = 0; c < 3; c++)
                out[c] += 0.5 * cross[c];
        }
}
