/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/cusp.h"

#include "base/vector.h"

#include <math.h>
#include <string.h>

/* In spacings. */
static const double REACH = 2.5;  /* of a crossing from the vertex */
static const double LEAST = 0.02; /* nearer ones do no harm */
static const double TOGETHER =
    1.0; /* edges that cross, where they do: loose ones are beside the face */

/* An edge seen from one of its ends. */
struct view {
    const crease_edge *edge;
    int end;
};

static const double *point_of(const struct view *view, size_t i)
{
    return view->edge->points + 3 * (view->end ? view->edge->count - 1 - i : i);
}

/* Where the segments of two edges cross as seen along the normal; false when they do not. */
static bool crossing(const double *const a[2], const double *const b[2], const double normal[3],
    double together, double place[3])
{
    double along[3], other[3], between[3], turn[3];
    for (int c = 0; c < 3; c++) {
        along[c] = a[1][c] - a[0][c];
        other[c] = b[1][c] - b[0][c];
        between[c] = b[0][c] - a[0][c];
    }
    crease_vector_cross(along, other, turn);
    const double slant = crease_vector_dot(turn, normal);
    if (slant == 0.0)
        return false;
    crease_vector_cross(between, other, turn);
    const double t = crease_vector_dot(turn, normal) / slant;
    crease_vector_cross(between, along, turn);
    const double u = crease_vector_dot(turn, normal) / slant;
    if (!(t >= 0.0 && t <= 1.0 && u >= 0.0 && u <= 1.0))
        return false;
    double there[3];
    for (int c = 0; c < 3; c++) {
        place[c] = a[0][c] + t * along[c];
        there[c] = b[0][c] + u * other[c];
    }
    return crease_vector_distance(place, there) <= together;
}

/* The crossing of two edges that is farthest from the vertex that they share. */
static bool farthest(const crease_graph *graph, const struct view *a, const struct view *b,
    uint32_t region, const double vertex[3], double place[3])
{
    const double s = graph->survey->spacing;
    double normal[3], least = LEAST * s;
    bool found = false;
    crease_graph_distance(graph, region, vertex, normal);
    for (size_t i = 0; i + 1 < a->edge->count; i++) {
        const double *const from[2] = {point_of(a, i), point_of(a, i + 1)};
        if (crease_vector_distance(from[0], vertex) > REACH * s)
            break;
        for (size_t k = 0; k + 1 < b->edge->count; k++) {
            const double *const to[2] = {point_of(b, k), point_of(b, k + 1)};
            double at[3];
            if (crease_vector_distance(to[0], vertex) > REACH * s)
                break;
            if (!crossing(from, to, normal, TOGETHER * s, at))
                continue;
            const double away = crease_vector_distance(at, vertex);
            if (away < least || away > REACH * s)
                continue;
            least = away;
            found = true;
            memcpy(place, at, sizeof at);
        }
    }
    return found;
}

/* Lets an edge of the vertex end at another place: cut back to it, or led on. */
static crease_status lead(
    const crease_graph *graph, crease_edge *edge, int end, const double place[3])
{
    if (end)
        crease_edge_reverse(edge);
    double *const tip = edge->points, along[3], step[3];
    size_t nearest = 0;
    for (size_t i = 1; i + 1 < edge->count; i++)
        if (crease_vector_distance(tip + 3 * i, place) <
            crease_vector_distance(tip + 3 * nearest, place))
            nearest = i;
    for (int c = 0; c < 3; c++) {
        along[c] = tip[3 + c] - tip[c];
        step[c] = place[c] - tip[c];
    }
    crease_status status = CREASE_OK;
    crease_edge_erase(edge, 0, nearest);
    if (nearest == 0 && crease_vector_dot(along, step) <= 0.0)
        status = crease_edge_insert(graph->context, edge, 0, place);
    if (status == CREASE_OK)
        memcpy(edge->points, place, 3 * sizeof *place);
    if (end)
        crease_edge_reverse(edge);
    return status;
}

static crease_status move(crease_graph *graph, int32_t vertex, const double place[3])
{
    const crease_topology *const t = graph->topology;
    crease_status status = CREASE_OK;
    for (size_t e = 0; e < t->edge_count; e++)
        for (int end = 0; end < 2 && status == CREASE_OK; end++)
            if (!t->edges[e].closed && t->edges[e].vertices[end] == vertex)
                status = lead(graph, &t->edges[e], end, place);
    memcpy(t->vertices[vertex].place, place, 3 * sizeof *place);
    return status;
}

/* Looks at all edges after the given one that share the vertex and exactly one region with it. */
static crease_status look(crease_graph *graph, size_t first, int end)
{
    const crease_topology *const t = graph->topology;
    const struct view a = {&t->edges[first], end};
    const int32_t vertex = a.edge->vertices[end];
    double place[3], from[3];
    memcpy(from, t->vertices[vertex].place, sizeof from);
    for (size_t e = first + 1; e < t->edge_count; e++)
        for (int w = 0; w < 2; w++) {
            const struct view b = {&t->edges[e], w};
            uint32_t regions[3];
            if (b.edge->closed || b.edge->vertices[w] != vertex || crease_edge_is_rim(b.edge) ||
                !crease_edge_common(a.edge->regions, b.edge->regions, regions))
                continue;
            if (farthest(graph, &a, &b, regions[0], from, place))
                return move(graph, vertex, place);
        }
    return CREASE_OK;
}

crease_status crease_cusps_move(crease_graph *graph)
{
    const crease_topology *const t = graph->topology;
    crease_status status = CREASE_OK;
    for (size_t e = 0; e < t->edge_count && status == CREASE_OK; e++)
        for (int end = 0; end < 2 && status == CREASE_OK; end++)
            if (!t->edges[e].closed && !crease_edge_is_rim(&t->edges[e]))
                status = look(graph, e, end);
    return status;
}
