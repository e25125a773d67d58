/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/lap.h"

#include "base/vector.h"
#include "crease/intersect.h"

#include <math.h>
#include <string.h>

/* In spacings. */
static const double STEP = 0.5;
static const double HOME = 1.0;  /* from the beginning of the edge: the lap is complete */
static const double SHORT = 3.0; /* of an edge that tells nothing */

static const double MOST = 6.0; /* of a lap, in lengths of what is seen */

static double length_of(const crease_edge *edge)
{
    double sum = 0.0;
    for (size_t i = 1; i < edge->count; i++)
        sum += crease_vector_distance(edge->points + 3 * i - 3, edge->points + 3 * i);
    return sum;
}

/* Whether both ends lack an edge of both regions, and of no other ones. */
static bool is_torn(const crease_graph *graph, const crease_edge *edge)
{
    if (edge->closed || edge->smooth || crease_edge_is_rim(edge) || edge->count < 3 ||
        edge->vertices[0] == edge->vertices[1])
        return false;
    for (int i = 0; i < 4; i++)
        if (!crease_graph_odd(graph, edge->vertices[i / 2], edge->regions[i % 2]))
            return false;
    return crease_graph_ends(graph, edge->vertices[0], -1) == 1 &&
        crease_graph_ends(graph, edge->vertices[1], -1) == 1;
}

/* Goes from the end of the edge to its beginning. *home: whether that was reached. */
static crease_status go_round(
    crease_graph *graph, const crease_edge *seen, crease_edge *lap, bool *home)
{
    const crease_model *const all = graph->survey->regions->models;
    const crease_model *const models[2] = {&all[seen->regions[0]], &all[seen->regions[1]]};
    const double s = graph->survey->spacing, most = MOST * length_of(seen);
    const double *const tip = seen->points + 3 * (seen->count - 1), *const begin = seen->points;
    double place[3] = {tip[0], tip[1], tip[2]}, tangent[3], ahead = 0.0, gone = 0.0;
    crease_status status = crease_edge_append(graph->context, lap, tip);
    *home = false;
    if (!crease_intersection_project(models, s, place, tangent))
        return status;
    for (int c = 0; c < 3; c++)
        ahead += tangent[c] * (tip[c] - tip[c - 3]);
    for (int c = 0; c < 3 && ahead < 0.0; c++)
        tangent[c] = -tangent[c];
    while (gone < most && !*home && status == CREASE_OK) {
        const double from[3] = {place[0], place[1], place[2]};
        if (!crease_intersection_step(models, STEP * s, place, tangent))
            return status;
        gone += crease_vector_distance(from, place);
        *home = gone > SHORT * s && crease_vector_distance(place, begin) < HOME * s;
        if (!*home)
            status = crease_edge_append(graph->context, lap, place);
    }
    return status == CREASE_OK ? crease_edge_append(graph->context, lap, begin) : status;
}

static crease_status close_lap(crease_graph *graph, size_t number)
{
    const crease_edge *const seen = &graph->topology->edges[number];
    crease_edge lap = crease_edge_between(seen->regions[0], seen->regions[1]);
    bool home = false;
    lap.vertices[0] = seen->vertices[1];
    lap.vertices[1] = seen->vertices[0];
    crease_status status = go_round(graph, seen, &lap, &home);
    if (status == CREASE_OK && home)
        return crease_graph_take(graph, &lap);
    crease_edge_clear(&lap);
    return status;
}

crease_status crease_laps_close(crease_graph *graph)
{
    const size_t count = graph->topology->edge_count;
    crease_status status = CREASE_OK;
    for (size_t e = 0; e < count && status == CREASE_OK; e++) {
        const crease_edge *const edge = &graph->topology->edges[e];
        if (is_torn(graph, edge) && length_of(edge) > SHORT * graph->survey->spacing)
            status = close_lap(graph, e);
    }
    return status;
}
