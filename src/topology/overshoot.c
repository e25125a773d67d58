/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/overshoot.h"

#include "base/vector.h"

#include <math.h>

/* In spacings. */
static const double BESIDE = 1.0; /* an edge that passes by a vertex */
static const double MOST = 10.0;  /* that an edge goes on */

static size_t nearest_point(const crease_edge *edge, const double place[3])
{
    size_t nearest = 0;
    for (size_t i = 0; i < edge->count; i++)
        if (crease_vector_distance(edge->points + 3 * i, place) <
            crease_vector_distance(edge->points + 3 * nearest, place))
            nearest = i;
    return nearest;
}

crease_status crease_edge_retract(
    const crease_graph *graph, crease_edge *edge, int end, int32_t vertex)
{
    const double *const place = graph->topology->vertices[vertex].place;
    if (!end)
        crease_edge_reverse(edge);
    const size_t nearest = nearest_point(edge, place);
    crease_edge_erase(edge, nearest > 0 ? nearest : 1, edge->count);
    edge->vertices[1] = vertex;
    return crease_edge_append(graph->context, edge, place);
}

/* Whether the edge, whose one end is at a vertex, passes by another one before. */
static bool passes(const crease_graph *graph, const crease_edge *edge, int end, int32_t vertex)
{
    const crease_vertex *const v = graph->topology->vertices;
    const double s = graph->survey->spacing, *const place = v[vertex].place;
    if (edge->vertices[0] == vertex || edge->vertices[1] == vertex ||
        crease_vector_distance(place, v[edge->vertices[end]].place) > MOST * s ||
        crease_edge_distance(edge, place) > BESIDE * s)
        return false;
    const size_t nearest = nearest_point(edge, place);
    return nearest > 0 && nearest + 1 < edge->count;
}

/* How many edges fewer, or more, of the edge's regions are missing at two vertices when it ends at
 * the one instead of the other. */
static int change(const crease_graph *graph, const crease_edge *edge, int32_t from, int32_t to)
{
    int sum = 0;
    for (int i = 0; i < 2; i++) {
        sum += crease_graph_odd(graph, from, edge->regions[i]) ? -1 : 1;
        sum += crease_graph_odd(graph, to, edge->regions[i]) ? -1 : 1;
    }
    return sum;
}

/* Whether both vertices lack an edge of one of the edge's regions and the same other one: it would
 * run where the edge does. */
static bool is_taken(const crease_graph *graph, const crease_edge *edge, int32_t a, int32_t b)
{
    const uint32_t regions = (uint32_t)graph->topology->region_count;
    bool own = false, other = false;
    for (uint32_t r = 0; r < regions; r++) {
        if (!crease_graph_odd(graph, a, r) || !crease_graph_odd(graph, b, r))
            continue;
        if (crease_edge_has(edge, r))
            own = true;
        else
            other = true;
    }
    return own && other;
}

static crease_status retract(crease_graph *graph, crease_edge *edge, int end)
{
    const size_t count = graph->topology->vertex_count;
    for (size_t v = 0; v < count; v++) {
        const int32_t from = edge->vertices[end], to = (int32_t)v;
        if (!passes(graph, edge, end, to))
            continue;
        const int more = change(graph, edge, from, to);
        if (more < 0 || (more == 0 && is_taken(graph, edge, from, to)))
            return crease_edge_retract(graph, edge, end, to);
    }
    return CREASE_OK;
}

crease_status crease_overshoots_retract(crease_graph *graph)
{
    const crease_topology *const t = graph->topology;
    crease_status status = CREASE_OK;
    for (size_t e = 0; e < t->edge_count && status == CREASE_OK; e++)
        for (int end = 0; end < 2 && status == CREASE_OK; end++)
            if (!t->edges[e].closed && t->edges[e].vertices[0] != CREASE_NO_VERTEX &&
                t->edges[e].vertices[1] != CREASE_NO_VERTEX && !crease_edge_is_rim(&t->edges[e]))
                status = retract(graph, &t->edges[e], end);
    return status;
}
