/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/relax.h"

#include "base/vector.h"
#include "topology/contact.h"

#include <math.h>
#include <string.h>

enum { ROUNDS = 24 };

/* In spacings. */
static const double STEP = 0.5;
static const double APART = 2.0;      /* that surfaces may be at most, and twice the noise, ... */
static const double MEAN_APART = 0.6; /* and on average, and the noise */
static const double BESIDE = 1.5;     /* points so near to a vertex may lead past it */
static const double ASTRAY = 0.25;    /* across the edge */

void crease_edge_smooth(crease_edge *edge, int rounds)
{
    double *const p = edge->points;
    for (int round = 0; round < rounds; round++)
        for (size_t c = 0; c < 3; c++) {
            double last = p[c];
            for (size_t i = 1; i + 1 < edge->count; i++) {
                const double here = p[3 * i + c];
                p[3 * i + c] = 0.25 * last + 0.5 * here + 0.25 * p[3 * i + 3 + c];
                last = here;
            }
        }
}

bool crease_edge_lay_midway(const crease_graph *graph, crease_edge *edge)
{
    const crease_model *const all = graph->survey->regions->models;
    const crease_model *const models[2] = {&all[edge->regions[0]], &all[edge->regions[1]]};
    const double s = graph->survey->spacing;
    double sum = 0.0, most = 0.0;
    for (size_t i = 1; i + 1 < edge->count; i++) {
        const double apart = crease_contact_midway(models, edge->points + 3 * i);
        sum += apart;
        most = fmax(most, apart);
    }
    const double noise = graph->survey->sigma;
    return most <= APART * s + 2.0 * noise && sum <= (MEAN_APART * s + noise) * (double)edge->count;
}

/* Appends even steps from the last point to a place. */
static crease_status go_to(
    const crease_graph *graph, crease_edge *edge, const double to[3], double step)
{
    double from[3];
    memcpy(from, edge->points + 3 * (edge->count - 1), sizeof from);
    const size_t steps = (size_t)fmax(round(crease_vector_distance(from, to) / step), 1.0);
    crease_status status = CREASE_OK;
    for (size_t k = 1; k <= steps && status == CREASE_OK; k++) {
        double place[3];
        for (int c = 0; c < 3; c++)
            place[c] = from[c] + (double)k / (double)steps * (to[c] - from[c]);
        status = crease_edge_append(graph->context, edge, place);
    }
    return status;
}

/* The edge from vertex to vertex without what lies beside these, smoothed. */
static crease_status even(const crease_graph *graph, const crease_edge *edge, crease_edge *out)
{
    const double s = graph->survey->spacing;
    const crease_vertex *const v = graph->topology->vertices;
    const double *const ends[2] = {v[edge->vertices[0]].place, v[edge->vertices[1]].place};
    *out = *edge;
    out->points = NULL;
    out->count = out->room = 0;
    crease_status status = crease_edge_append(graph->context, out, ends[0]);
    for (size_t i = 1; i + 1 < edge->count && status == CREASE_OK; i++) {
        const double *const at = edge->points + 3 * i;
        if (crease_vector_distance(at, ends[0]) > BESIDE * s &&
            crease_vector_distance(at, ends[1]) > BESIDE * s)
            status = go_to(graph, out, at, STEP * s);
    }
    if (status == CREASE_OK)
        status = go_to(graph, out, ends[1], STEP * s);
    if (status == CREASE_OK)
        crease_edge_smooth(out, ROUNDS);
    else
        crease_edge_clear(out);
    return status;
}

static bool leads_astray(const crease_graph *graph, const crease_edge *edge, int end)
{
    const double *const tip = edge->points + (end ? 3 * (edge->count - 1) : 0);
    const double *const next = end ? tip - 3 : tip + 3;
    double along[3], place[3];
    memcpy(place, tip, sizeof place);
    for (int c = 0; c < 3; c++)
        along[c] = next[c] - tip[c];
    crease_vector_normalise(along);
    return !crease_graph_onto(graph, edge, along, place) ||
        crease_vector_distance(place, tip) > ASTRAY * graph->survey->spacing;
}

/* Whether the edge is far from what it should be. */
static bool is_astray(const crease_graph *graph, const crease_edge *edge, const crease_edge *even)
{
    for (size_t i = 0; i < even->count; i++)
        if (crease_edge_distance(edge, even->points + 3 * i) > ASTRAY * graph->survey->spacing)
            return true;
    for (size_t i = 0; i < edge->count; i++)
        if (crease_edge_distance(even, edge->points + 3 * i) > ASTRAY * graph->survey->spacing)
            return true;
    return leads_astray(graph, edge, 0) || leads_astray(graph, edge, 1);
}

crease_status crease_seams_relax(crease_graph *graph)
{
    const crease_topology *const t = graph->topology;
    crease_status status = CREASE_OK;
    for (size_t e = 0; e < t->edge_count && status == CREASE_OK; e++) {
        crease_edge *const edge = &t->edges[e], relaxed;
        if (!edge->smooth || edge->loose || edge->closed || edge->count < 2)
            continue;
        status = even(graph, edge, &relaxed);
        if (status != CREASE_OK)
            break;
        relaxed.loose = true;
        if (is_astray(graph, edge, &relaxed) && crease_edge_lay_midway(graph, &relaxed)) {
            crease_edge_clear(edge);
            *edge = relaxed;
        } else {
            crease_edge_clear(&relaxed);
        }
    }
    return status;
}
