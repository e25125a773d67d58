/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/ring.h"

#include "base/memory.h"
#include "base/vector.h"
#include "topology/contact.h"
#include "topology/trail.h"

#include <stdlib.h>
#include <string.h>

static const double BESIDE = 2.5; /* spacings, and 2 sigma: links that a way passes by */

static const double LEAST_ACROSS = 10.0; /* spacings from one side of a ring to the other */

/* Shares of the links. */
static const double ENOUGH = 0.4;       /* there may be two rings */
static const double LEAST_ALONE = 0.15; /* that the way back alone passes by */

/* A way from one side of the links to the other, and another one back. */
struct ring {
    crease_graph *graph;
    const crease_loose *loose;
    int32_t vertices[2];
    crease_edge ways[2];
    bool *beside[2]; /* of each link, whether a way passes by */
    bool found;
};

/* ---------------------------------------------------------------------------------- links -- */

/* Marks the links that an edge passes by, and returns how many that are. */
static size_t mark(
    const crease_graph *graph, const crease_loose *loose, const crease_edge *edge, bool *beside)
{
    const double reach = BESIDE * graph->survey->spacing + 2.0 * graph->survey->sigma;
    size_t count = 0;
    for (size_t i = 0; i < loose->count; i++) {
        beside[i] = beside[i] || crease_edge_distance(edge, loose->places + 3 * i) < reach;
        count += beside[i];
    }
    return count;
}

static const double *farthest(const crease_loose *loose, const double from[3])
{
    const double *out = loose->places;
    for (size_t i = 0; i < loose->count; i++)
        if (crease_vector_distance(loose->places + 3 * i, from) > crease_vector_distance(out, from))
            out = loose->places + 3 * i;
    return out;
}

/* ----------------------------------------------------------------------------------- ways -- */

static crease_status add_vertex(struct ring *ring, int which, const double place[3])
{
    const crease_model *const all = ring->graph->survey->regions->models;
    const crease_model *const models[2] = {
        &all[ring->loose->regions[0]], &all[ring->loose->regions[1]]};
    double at[3] = {place[0], place[1], place[2]};
    crease_contact_midway(models, at);
    return crease_graph_vertex(ring->graph, at, &ring->vertices[which]);
}

/* The way back, past the links that the way there has not passed. */
static crease_status lay_back(struct ring *ring)
{
    const crease_loose *const loose = ring->loose;
    const int32_t vertices[2] = {ring->vertices[1], ring->vertices[0]};
    crease_loose rest = {.regions = {loose->regions[0], loose->regions[1]}};
    rest.places = crease_allocate(ring->graph->context, loose->count, 3 * sizeof *rest.places);
    if (!rest.places)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < loose->count; i++)
        if (!ring->beside[0][i])
            memcpy(rest.places + 3 * rest.count++, loose->places + 3 * i, 3 * sizeof *rest.places);
    const crease_status status =
        crease_trail_lay(ring->graph, &rest, vertices, &ring->ways[1], &ring->found);
    crease_loose_clear(&rest);
    return status;
}

static crease_status lay(struct ring *ring)
{
    const double *const one = farthest(ring->loose, ring->loose->places);
    const double *const other = farthest(ring->loose, one);
    if (crease_vector_distance(one, other) < LEAST_ACROSS * ring->graph->survey->spacing)
        return CREASE_OK;
    crease_status status = add_vertex(ring, 0, one);
    if (status == CREASE_OK)
        status = add_vertex(ring, 1, other);
    if (status == CREASE_OK)
        status = crease_trail_lay(
            ring->graph, ring->loose, ring->vertices, &ring->ways[0], &ring->found);
    if (status != CREASE_OK || !ring->found)
        return status;
    mark(ring->graph, ring->loose, &ring->ways[0], ring->beside[0]);
    return lay_back(ring);
}

/* Whether the ways pass by enough links, more than other edges do, and each has its own. */
static bool is_better(const struct ring *ring, size_t others)
{
    const size_t count = ring->loose->count;
    size_t all = 0, alone = 0;
    mark(ring->graph, ring->loose, &ring->ways[1], ring->beside[1]);
    for (size_t i = 0; i < count; i++) {
        all += ring->beside[0][i] || ring->beside[1][i];
        alone += ring->beside[1][i] && !ring->beside[0][i];
    }
    return all > others && (double)all > ENOUGH * (double)count &&
        (double)alone > LEAST_ALONE * (double)count;
}

/* Takes the ways in the place of the edges from number `since` on. */
static crease_status take(struct ring *ring, size_t since)
{
    crease_topology *const t = ring->graph->topology;
    while (t->edge_count > since)
        crease_edge_clear(&t->edges[--t->edge_count]);
    const crease_status status = crease_graph_take(ring->graph, &ring->ways[0]);
    return status == CREASE_OK ? crease_graph_take(ring->graph, &ring->ways[1]) : status;
}

crease_status crease_ring_mend(crease_graph *graph, const crease_loose *loose, size_t since)
{
    crease_topology *const t = graph->topology;
    const size_t vertex_count = t->vertex_count;
    struct ring ring = {.graph = graph, .loose = loose};
    bool *const passed = crease_allocate(graph->context, loose->count, sizeof *passed);
    size_t others = 0;
    for (int i = 0; i < 2; i++)
        ring.beside[i] = crease_allocate(graph->context, loose->count, sizeof *ring.beside[i]);
    crease_status status =
        passed && ring.beside[0] && ring.beside[1] ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    for (size_t e = since; e < t->edge_count && status == CREASE_OK; e++)
        others = mark(graph, loose, &t->edges[e], passed);
    if (status == CREASE_OK && (double)others < ENOUGH * (double)loose->count)
        status = lay(&ring);
    if (status == CREASE_OK && ring.found && is_better(&ring, others))
        status = take(&ring, since);
    else
        t->vertex_count = vertex_count;
    for (int i = 0; i < 2; i++) {
        crease_edge_clear(&ring.ways[i]);
        free(ring.beside[i]);
    }
    free(passed);
    return status;
}
