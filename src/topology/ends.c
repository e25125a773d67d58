/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/ends.h"

#include "base/vector.h"
#include "crease/intersect.h"
#include "topology/cusp.h"

#include <math.h>
#include <string.h>

enum { LOOK_BACK = 30, LEAF_POINTS = 16, LEAST_ENDS = 3 };

/* In spacings. */
static const double JOIN_REACH = 4.0;
static const double LONELY_REACH = 3.0;
static const double AHEAD = 0.1;
static const double SAME = 0.02;
static const double SPREAD_REACH = 3.0;
static const double CLOSE = 0.05; /* surfaces that meet */
static const double APART = 1.0;  /* surfaces side by side that do not meet */

static const double ALIKE = 0.95; /* cosine between the normals of such */

/* ------------------------------------------------------------------------------- joining -- */

/* Whether the surfaces of two regions run side by side at a place, as those of two bores around one
 * axis do: no edge of theirs begins there. */
static bool are_apart(const crease_graph *graph, uint32_t a, uint32_t b, const double place[3])
{
    double first[3], second[3];
    const double d = crease_graph_distance(graph, a, place, first);
    const double e = crease_graph_distance(graph, b, place, second);
    const double along = crease_vector_dot(first, second);
    return fabs(along) > ALIKE &&
        fabs(along > 0.0 ? d - e : d + e) > APART * graph->survey->spacing;
}

/* Whether the rims of a narrow ring end there: they have one region in common, and the others are
 * apart. */
static bool is_beside(
    const crease_graph *graph, const crease_edge *a, const crease_edge *b, const double place[3])
{
    uint32_t regions[3];
    return crease_edge_common(a->regions, b->regions, regions) &&
        are_apart(graph, regions[1], regions[2], place);
}

static bool is_of_another_rim(const crease_graph *graph, const crease_edge *edge, int32_t vertex)
{
    const crease_topology *const t = graph->topology;
    if (crease_graph_ends(graph, vertex, -1) != 1)
        return false;
    for (size_t e = 0; e < t->edge_count; e++)
        if ((t->edges[e].vertices[0] == vertex || t->edges[e].vertices[1] == vertex) &&
            is_beside(graph, edge, &t->edges[e], t->vertices[vertex].place))
            return true;
    return false;
}

static int32_t nearest_vertex(
    const crease_graph *graph, const crease_edge *edge, const double place[3], int32_t other)
{
    const crease_topology *const t = graph->topology;
    int32_t nearest = CREASE_NO_VERTEX;
    double least = JOIN_REACH * t->spacing;
    for (size_t v = 0; v < t->vertex_count; v++) {
        const double away = crease_vector_distance(t->vertices[v].place, place);
        if ((int32_t)v != other && away < least && !is_of_another_rim(graph, edge, (int32_t)v)) {
            least = away;
            nearest = (int32_t)v;
        }
    }
    return nearest;
}

/* The only end of an edge at a vertex: the edge, or NULL when there are more. */
static crease_edge *only_edge(const crease_graph *graph, int32_t vertex)
{
    const crease_topology *const t = graph->topology;
    if (crease_graph_ends(graph, vertex, -1) != 1)
        return NULL;
    size_t e = 0;
    while (t->edges[e].vertices[0] != vertex && t->edges[e].vertices[1] != vertex)
        e++;
    return &t->edges[e];
}

/* Two edges of one region that end by themselves side by side, each past the other or short of it,
 * end in one vertex: there the border between the two other regions begins. */
static void join_lonely(const crease_graph *graph)
{
    const crease_topology *const t = graph->topology;
    for (size_t v = 0; v < t->vertex_count; v++)
        for (size_t w = v + 1; w < t->vertex_count; w++) {
            double *const place = t->vertices[v].place, *const other = t->vertices[w].place;
            if (crease_vector_distance(place, other) > LONELY_REACH * t->spacing)
                continue;
            const crease_edge *const a = only_edge(graph, (int32_t)v);
            crease_edge *const b = only_edge(graph, (int32_t)w);
            uint32_t regions[3];
            if (!a || !b || a == b || !crease_edge_common(a->regions, b->regions, regions) ||
                are_apart(graph, regions[1], regions[2], place))
                continue;
            b->vertices[b->vertices[1] == (int32_t)w] = (int32_t)v;
            for (int c = 0; c < 3; c++)
                place[c] = 0.5 * (place[c] + other[c]);
        }
}

crease_status crease_ends_join(crease_graph *graph)
{
    const crease_topology *const t = graph->topology;
    crease_status status = CREASE_OK;
    for (size_t e = 0; e < t->edge_count; e++)
        for (int w = 0; w < 2 && !t->edges[e].closed && status == CREASE_OK; w++) {
            crease_edge *const edge = &t->edges[e];
            const double *const tip = edge->points + (w ? 3 * (edge->count - 1) : 0);
            if (edge->vertices[w] != CREASE_NO_VERTEX)
                continue;
            edge->vertices[w] = nearest_vertex(graph, edge, tip, edge->vertices[1 - w]);
            if (edge->vertices[w] == CREASE_NO_VERTEX)
                status = crease_graph_vertex(graph, tip, &edge->vertices[w]);
        }
    if (status == CREASE_OK)
        join_lonely(graph);
    return status;
}

/* ------------------------------------------------------------------------------- meeting -- */

/* Removes the first points of an edge that do not have a place behind them. */
static void cut_back(crease_edge *edge, const double place[3], double s)
{
    const double *const p = edge->points;
    double least = INFINITY;
    size_t first = 0;
    for (size_t i = 0; i < edge->count && i < LOOK_BACK; i++) {
        const double away = crease_vector_distance(p + 3 * i, place);
        first = away < least ? i : first;
        least = fmin(least, away);
    }
    for (; first + 1 < edge->count; first++) {
        double from[3], on[3];
        for (size_t c = 0; c < 3; c++) {
            from[c] = p[3 * first + c] - place[c];
            on[c] = p[3 * first + 3 + c] - p[3 * first + c];
        }
        if (crease_vector_dot(from, on) > AHEAD * s * crease_vector_length(on))
            break;
    }
    if (first + 1 == edge->count && first > 0 &&
        crease_vector_distance(p + 3 * first, place) < SAME * s)
        first--;
    crease_edge_erase(edge, 0, first);
}

static crease_status meet_first(crease_graph *graph, crease_edge *edge)
{
    const double *const place = graph->topology->vertices[edge->vertices[0]].place;
    const double s = graph->survey->spacing;
    cut_back(edge, place, s);
    if (edge->count > 1 && crease_vector_distance(edge->points, place) < SAME * s)
        crease_edge_erase(edge, 0, 1);
    return crease_edge_insert(graph->context, edge, 0, place);
}

crease_status crease_ends_meet(crease_graph *graph)
{
    const crease_topology *const t = graph->topology;
    crease_status status = CREASE_OK;
    for (size_t e = 0; e < t->edge_count; e++)
        for (int w = 0; w < 2 && !t->edges[e].closed && status == CREASE_OK; w++) {
            status = meet_first(graph, &t->edges[e]);
            crease_edge_reverse(&t->edges[e]);
        }
    return status;
}

/* ------------------------------------------------------------------------------- pruning -- */

static bool has_twin(const crease_topology *t, size_t leaf, int32_t vertex)
{
    const crease_edge *const edge = &t->edges[leaf];
    for (size_t i = 0; i < t->edge_count; i++) {
        const crease_edge *const other = &t->edges[i];
        if (i != leaf && other->count > 0 && other->regions[0] == edge->regions[0] &&
            other->regions[1] == edge->regions[1] &&
            (other->vertices[0] == vertex || other->vertices[1] == vertex))
            return true;
    }
    return false;
}

void crease_ends_prune(crease_graph *graph)
{
    const crease_topology *const t = graph->topology;
    for (size_t e = 0; e < t->edge_count; e++) {
        crease_edge *const edge = &t->edges[e];
        for (int w = 0; w < 2 && !edge->closed && edge->count < LEAF_POINTS; w++)
            if (crease_graph_ends(graph, edge->vertices[w], -1) == 1 &&
                has_twin(t, e, edge->vertices[1 - w]))
                crease_edge_clear(edge);
    }
    crease_graph_drop_empty(graph);
}

/* ---------------------------------------------------------------------------- dissolving -- */

static bool is_one_curve(const crease_edge *a, const crease_edge *b)
{
    return a->regions[0] == b->regions[0] && a->regions[1] == b->regions[1] &&
        a->smooth == b->smooth && a->loose == b->loose && !crease_edge_is_rim(a);
}

/* The two edges whose ends are all that there is at a vertex, which may be the same one. */
static bool pair_at(const crease_topology *t, int32_t vertex, crease_edge *out[2])
{
    int count = 0;
    for (size_t e = 0; e < t->edge_count; e++)
        for (int w = 0; w < 2; w++)
            if (t->edges[e].vertices[w] == vertex && t->edges[e].count > 0) {
                if (count < 2)
                    out[count] = &t->edges[e];
                count++;
            }
    return count == 2;
}

/* Where an edge ends, moved onto its surfaces. */
static void settle_end(const crease_graph *graph, crease_edge *edge)
{
    double along[3], *const tip = edge->points + 3 * (edge->count - 1);
    for (int c = 0; c < 3; c++)
        along[c] = tip[c - 3] - tip[c];
    crease_vector_normalise(along);
    crease_graph_onto(graph, edge, along, tip);
}

/* Lets an edge go on with the points of another, which then has none. */
static crease_status go_on(crease_graph *graph, crease_edge *edge, crease_edge *with, int32_t at)
{
    crease_status status = CREASE_OK;
    if (edge->vertices[1] != at)
        crease_edge_reverse(edge);
    if (with->vertices[0] != at)
        crease_edge_reverse(with);
    settle_end(graph, edge);
    for (size_t i = 1; i < with->count && status == CREASE_OK; i++)
        status = crease_edge_append(graph->context, edge, with->points + 3 * i);
    edge->vertices[1] = with->vertices[1];
    with->vertices[0] = with->vertices[1] = CREASE_NO_VERTEX;
    crease_edge_clear(with);
    return status;
}

static void close_up(const crease_graph *graph, crease_edge *edge)
{
    settle_end(graph, edge);
    memcpy(edge->points, edge->points + 3 * (edge->count - 1), 3 * sizeof *edge->points);
    edge->vertices[0] = edge->vertices[1] = CREASE_NO_VERTEX;
    edge->closed = true;
}

crease_status crease_ends_dissolve(crease_graph *graph)
{
    const crease_topology *const t = graph->topology;
    crease_status status = CREASE_OK;
    for (size_t v = 0; v < t->vertex_count && status == CREASE_OK; v++) {
        crease_edge *pair[2];
        if (!pair_at(t, (int32_t)v, pair) || !is_one_curve(pair[0], pair[1]))
            continue;
        if (pair[0] == pair[1])
            close_up(graph, pair[0]);
        else
            status = go_on(graph, pair[0], pair[1], (int32_t)v);
    }
    crease_graph_drop_empty(graph);
    return status;
}

/* ----------------------------------------------------------------------------- finishing -- */

static void spread_at(crease_graph *graph, const crease_edge *a, const crease_edge *b, int32_t v)
{
    crease_vertex *const vertex = &graph->topology->vertices[v];
    const double s = graph->survey->spacing;
    const crease_model *models[3];
    uint32_t regions[3];
    double place[3] = {vertex->place[0], vertex->place[1], vertex->place[2]};
    if (!crease_edge_common(a->regions, b->regions, regions))
        return;
    for (int i = 0; i < 3; i++)
        models[i] = &graph->survey->regions->models[regions[i]];
    if (crease_intersection_meet(models, 3, SPREAD_REACH * s, CLOSE * s, place))
        vertex->spread = fmax(vertex->spread, crease_vector_distance(place, vertex->place));
}

/* Any three of the surfaces that meet in a vertex may meet in another place, and even the only
 * three, when the vertex is where the points say that the edges end. */
static void find_spreads(crease_graph *graph)
{
    const crease_topology *const t = graph->topology;
    for (size_t a = 0; a < t->edge_count; a++)
        for (size_t b = a + 1; b < t->edge_count; b++)
            for (int w = 0; w < 2; w++) {
                const crease_edge *const x = &t->edges[a], *const y = &t->edges[b];
                const int32_t v = x->vertices[w];
                if ((y->vertices[0] == v || y->vertices[1] == v) && !x->smooth && !y->smooth &&
                    !crease_edge_is_rim(x) && !crease_edge_is_rim(y) &&
                    crease_graph_ends(graph, v, -1) >= LEAST_ENDS)
                    spread_at(graph, x, y, v);
            }
}

static void finish_edge(const crease_graph *graph, crease_edge *edge)
{
    for (int w = 0; w < 2 && !edge->closed; w++) {
        double along[3], *const tip = edge->points + (w ? 3 * (edge->count - 1) : 0);
        const double *const next = w ? tip - 3 : tip + 3;
        for (int c = 0; c < 3; c++)
            along[c] = next[c] - tip[c];
        crease_vector_normalise(along);
        crease_graph_onto(graph, edge, along, tip);
    }
}

crease_status crease_ends_finish(crease_graph *graph)
{
    for (size_t e = 0; e < graph->topology->edge_count; e++)
        finish_edge(graph, &graph->topology->edges[e]);
    const crease_status status = crease_cusps_move(graph);
    if (status == CREASE_OK)
        find_spreads(graph);
    return status;
}
