/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/graph.h"

#include "base/memory.h"
#include "base/vector.h"
#include "crease/intersect.h"
#include "topology/contact.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PROJECT_REACH = 3.0; /* spacings */
static const double WILD = 0.707;        /* cosine of 45 degrees */

/* ---------------------------------------------------------------------------------- edges -- */

crease_edge crease_edge_between(uint32_t first, uint32_t second)
{
    return (crease_edge){
        .regions = {first < second ? first : second, first < second ? second : first},
        .vertices = {CREASE_NO_VERTEX, CREASE_NO_VERTEX}};
}

crease_status crease_edge_insert(
    crease_context *context, crease_edge *edge, size_t at, const double place[3])
{
    const double kept[3] = {place[0], place[1], place[2]};
    if (edge->count == edge->room) {
        const size_t room = 2 * edge->room + 16;
        double *const points =
            crease_reallocate(context, edge->points, room, 3 * sizeof *edge->points);
        if (!points)
            return CREASE_ERROR_NO_MEMORY;
        edge->points = points;
        edge->room = room;
    }
    memmove(edge->points + 3 * (at + 1), edge->points + 3 * at,
        3 * (edge->count - at) * sizeof *edge->points);
    memcpy(edge->points + 3 * at, kept, sizeof kept);
    edge->count++;
    return CREASE_OK;
}

crease_status crease_edge_append(crease_context *context, crease_edge *edge, const double place[3])
{
    return crease_edge_insert(context, edge, edge->count, place);
}

void crease_edge_erase(crease_edge *edge, size_t begin, size_t end)
{
    memmove(edge->points + 3 * begin, edge->points + 3 * end,
        3 * (edge->count - end) * sizeof *edge->points);
    edge->count -= end - begin;
}

void crease_edge_reverse(crease_edge *edge)
{
    for (size_t i = 0, j = edge->count; i + 1 < j; i++) {
        double kept[3];
        j--;
        memcpy(kept, edge->points + 3 * i, sizeof kept);
        memcpy(edge->points + 3 * i, edge->points + 3 * j, sizeof kept);
        memcpy(edge->points + 3 * j, kept, sizeof kept);
    }
    const int32_t first = edge->vertices[0];
    edge->vertices[0] = edge->vertices[1];
    edge->vertices[1] = first;
}

bool crease_edge_has(const crease_edge *edge, uint32_t region)
{
    return edge->regions[0] == region || edge->regions[1] == region;
}

bool crease_edge_common(const uint32_t a[2], const uint32_t b[2], uint32_t out[3])
{
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 2; k++) {
            out[0] = a[i];
            out[1] = a[1 - i];
            out[2] = b[1 - k];
            if (a[i] == b[k] && out[1] != out[2])
                return true;
        }
    return false;
}

static double segment_distance(const double a[3], const double b[3], const double place[3])
{
    double along[3], from[3], foot[3];
    for (int c = 0; c < 3; c++) {
        along[c] = b[c] - a[c];
        from[c] = place[c] - a[c];
    }
    const double squared = crease_vector_dot(along, along);
    const double share =
        squared > 0.0 ? fmin(fmax(crease_vector_dot(from, along) / squared, 0.0), 1.0) : 0.0;
    for (int c = 0; c < 3; c++)
        foot[c] = a[c] + share * along[c];
    return crease_vector_distance(foot, place);
}

double crease_edge_distance(const crease_edge *edge, const double place[3])
{
    double nearest = INFINITY;
    for (size_t i = 0; i + 1 < edge->count; i++)
        nearest = fmin(
            nearest, segment_distance(edge->points + 3 * i, edge->points + 3 * (i + 1), place));
    return nearest;
}

bool crease_edge_is_wild(const crease_edge *edge)
{
    for (size_t i = 2; i + 2 < edge->count; i++) {
        const double *const p = edge->points + 3 * i;
        double before[3], after[3];
        for (int c = 0; c < 3; c++) {
            before[c] = p[c] - p[c - 3];
            after[c] = p[c + 3] - p[c];
        }
        crease_vector_normalise(before);
        crease_vector_normalise(after);
        if (crease_vector_dot(before, after) < WILD)
            return true;
    }
    return false;
}

/* ---------------------------------------------------------------------------------- graph -- */

crease_status crease_graph_vertex(crease_graph *graph, const double place[3], int32_t *out)
{
    crease_topology *const t = graph->topology;
    if (t->vertex_count == t->vertex_room) {
        const size_t room = 2 * t->vertex_room + 16;
        crease_vertex *const vertices =
            crease_reallocate(graph->context, t->vertices, room, sizeof *vertices);
        if (!vertices)
            return CREASE_ERROR_NO_MEMORY;
        t->vertices = vertices;
        t->vertex_room = room;
    }
    t->vertices[t->vertex_count] = (crease_vertex){.place = {place[0], place[1], place[2]}};
    *out = (int32_t)t->vertex_count++;
    return CREASE_OK;
}

crease_status crease_graph_take(crease_graph *graph, crease_edge *edge)
{
    crease_topology *const t = graph->topology;
    if (t->edge_count == t->edge_room) {
        const size_t room = 2 * t->edge_room + 16;
        crease_edge *const edges = crease_reallocate(graph->context, t->edges, room, sizeof *edges);
        if (!edges) {
            crease_edge_clear(edge);
            return CREASE_ERROR_NO_MEMORY;
        }
        t->edges = edges;
        t->edge_room = room;
    }
    t->edges[t->edge_count++] = *edge;
    *edge = (crease_edge){.count = 0};
    return CREASE_OK;
}

static crease_status take_chain(crease_graph *graph, const crease_chain *chain)
{
    crease_edge edge = crease_edge_between(chain->regions[0], chain->regions[1]);
    crease_status status = CREASE_OK;
    edge.closed = chain->closed;
    for (int w = 0; w < 2 && !chain->closed; w++)
        edge.vertices[w] =
            chain->corners[w] == CREASE_NO_CORNER ? CREASE_NO_VERTEX : chain->corners[w];
    for (size_t i = 0; i < chain->count && status == CREASE_OK; i++)
        status = crease_edge_append(graph->context, &edge, chain->points + 3 * i);
    if (chain->closed && status == CREASE_OK)
        status = crease_edge_append(graph->context, &edge, chain->points);
    if (status == CREASE_OK)
        return crease_graph_take(graph, &edge);
    crease_edge_clear(&edge);
    return status;
}

crease_status crease_graph_begin(
    crease_graph *graph, const crease_chains *chains, const crease_junctions *corners)
{
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < corners->count && status == CREASE_OK; i++) {
        int32_t number;
        status = crease_graph_vertex(graph, corners->items[i].place, &number);
    }
    for (size_t i = 0; i < chains->count && status == CREASE_OK; i++)
        status = take_chain(graph, &chains->items[i]);
    return status;
}

void crease_graph_drop_empty(crease_graph *graph)
{
    crease_topology *const t = graph->topology;
    size_t kept = 0;
    for (size_t i = 0; i < t->edge_count; i++) {
        if (t->edges[i].count > 0)
            t->edges[kept++] = t->edges[i];
        else
            crease_edge_clear(&t->edges[i]);
    }
    t->edge_count = kept;
}

/* -------------------------------------------------------------------------------- queries -- */

size_t crease_graph_ends(const crease_graph *graph, int32_t vertex, int64_t region)
{
    const crease_topology *const t = graph->topology;
    size_t count = 0;
    for (size_t i = 0; i < t->edge_count; i++)
        for (int w = 0; w < 2; w++)
            count += t->edges[i].vertices[w] == vertex &&
                (region < 0 || crease_edge_has(&t->edges[i], (uint32_t)region));
    return count;
}

bool crease_graph_odd(const crease_graph *graph, int32_t vertex, uint32_t region)
{
    return crease_graph_ends(graph, vertex, region) % 2 == 1;
}

double crease_graph_distance(
    const crease_graph *graph, uint32_t region, const double place[3], double gradient[3])
{
    return crease_model_distance(&graph->survey->regions->models[region], place, gradient);
}

bool crease_graph_project(
    const crease_graph *graph, const uint32_t regions[2], double reach, double place[3])
{
    const crease_model *const all = graph->survey->regions->models;
    const crease_model *const models[2] = {&all[regions[0]], &all[regions[1]]};
    double to[3] = {place[0], place[1], place[2]}, tangent[3];
    if (!crease_intersection_project(models, reach, to, tangent))
        return false;
    memcpy(place, to, sizeof to);
    return true;
}

bool crease_graph_onto(
    const crease_graph *graph, const crease_edge *edge, const double along[3], double place[3])
{
    if (edge->loose)
        return true;
    if (crease_edge_is_rim(edge)) {
        double gradient[3];
        const double away = crease_graph_distance(graph, edge->regions[0], place, gradient);
        for (int c = 0; c < 3; c++)
            place[c] -= away * gradient[c];
        return true;
    }
    if (!edge->smooth)
        return crease_graph_project(
            graph, edge->regions, PROJECT_REACH * graph->survey->spacing, place);
    const crease_model *const all = graph->survey->regions->models;
    const crease_model *const models[2] = {&all[edge->regions[0]], &all[edge->regions[1]]};
    double to[3] = {place[0], place[1], place[2]};
    const double s = graph->survey->spacing;
    if (!crease_contact_place(models, along, s, to) || crease_vector_distance(to, place) > 2.0 * s)
        return false;
    memcpy(place, to, sizeof to);
    return true;
}
