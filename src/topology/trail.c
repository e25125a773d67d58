/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/trail.h"

#include "base/memory.h"
#include "base/vector.h"
#include "topology/relax.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    MOST_LINKS = 4000, /* the search is quadratic: no seam of a part that the other ways leave over
                          is so long */
    ROUNDS = 24
};

/* In spacings. */
static const double LONGEST_HOP = 12.0;
static const double STEP = 0.5;
static const double REACH = 2.0; /* of the common curve */

static const double CROSSING_COSINE = 0.966; /* 15 degrees: more, and surfaces cut each other */
static const double SMOOTH_COSINE = 0.9;     /* less, and they do not join smoothly all along */

/* The places of the links, then the first and the last vertex; the search for the way. */
struct search {
    size_t count;
    double (*places)[3];
    double *costs;
    size_t *before;
    bool *done;
};

static void clear_search(struct search *search)
{
    free(search->places);
    free(search->costs);
    free(search->before);
    free(search->done);
}

static crease_status begin_search(const crease_graph *graph, const crease_loose *loose,
    const int32_t vertices[2], struct search *out)
{
    crease_context *const context = graph->context;
    const size_t count = loose->count + 2;
    *out = (struct search){.count = count};
    out->places = crease_allocate(context, count, sizeof *out->places);
    out->costs = crease_allocate(context, count, sizeof *out->costs);
    out->before = crease_allocate(context, count, sizeof *out->before);
    out->done = crease_allocate(context, count, sizeof *out->done);
    if (!out->places || !out->costs || !out->before || !out->done)
        return CREASE_ERROR_NO_MEMORY;
    if (loose->count > 0)
        memcpy(out->places, loose->places, loose->count * sizeof *out->places);
    for (size_t i = 0; i < 2; i++)
        memcpy(out->places[loose->count + i], graph->topology->vertices[vertices[i]].place,
            sizeof *out->places);
    for (size_t i = 0; i < count; i++)
        out->costs[i] = INFINITY;
    out->costs[count - 2] = 0.0;
    return CREASE_OK;
}

/* The cheapest place that the way has not gone on from, or SIZE_MAX. */
static size_t cheapest(const struct search *search)
{
    size_t best = SIZE_MAX;
    for (size_t i = 0; i < search->count; i++)
        if (!search->done[i] && search->costs[i] < INFINITY &&
            (best == SIZE_MAX || search->costs[i] < search->costs[best]))
            best = i;
    return best;
}

/* Dijkstra, with the squares of the hops as their cost: many short ones rather than a long one.
 * False when there is no way. */
static bool find_way(struct search *search, double s)
{
    for (;;) {
        const size_t at = cheapest(search);
        if (at == SIZE_MAX || at == search->count - 1)
            return at != SIZE_MAX;
        search->done[at] = true;
        for (size_t i = 0; i < search->count; i++) {
            const double hop = crease_vector_distance(search->places[at], search->places[i]);
            if (!search->done[i] && hop <= LONGEST_HOP * s &&
                search->costs[at] + hop * hop < search->costs[i]) {
                search->costs[i] = search->costs[at] + hop * hop;
                search->before[i] = at;
            }
        }
    }
}

/* The way as a line of even steps. */
static crease_status take_way(
    const crease_graph *graph, const struct search *search, crease_edge *out)
{
    const double step = STEP * graph->survey->spacing;
    crease_status status =
        crease_edge_append(graph->context, out, search->places[search->count - 1]);
    for (size_t i = search->count - 1; i != search->count - 2 && status == CREASE_OK;
         i = search->before[i]) {
        const double *const from = search->places[i], *const to = search->places[search->before[i]];
        const size_t steps = (size_t)ceil(fmax(crease_vector_distance(from, to) / step, 1.0));
        for (size_t k = 1; k <= steps && status == CREASE_OK; k++) {
            double place[3];
            for (int c = 0; c < 3; c++)
                place[c] = from[c] + (double)k / (double)steps * (to[c] - from[c]);
            status = crease_edge_append(graph->context, out, place);
        }
    }
    if (status == CREASE_OK)
        crease_edge_reverse(out);
    return status;
}

/* The largest cosine of the angle between the surfaces along the line, and the least. */
static void angles_along(const crease_graph *graph, const crease_edge *edge, double out[2])
{
    out[0] = 0.0;
    out[1] = 1.0;
    for (size_t i = 0; i < edge->count; i++) {
        double first[3], second[3];
        crease_graph_distance(graph, edge->regions[0], edge->points + 3 * i, first);
        crease_graph_distance(graph, edge->regions[1], edge->points + 3 * i, second);
        const double cosine = fabs(crease_vector_dot(first, second));
        out[0] = fmax(out[0], cosine);
        out[1] = fmin(out[1], cosine);
    }
}

/* Moves the points between the ends to the curve in which the surfaces cut each other; none where
 * that is out of reach of some. */
static crease_status lay_on_curve(const crease_graph *graph, crease_edge *edge, bool *found)
{
    const double reach = REACH * graph->survey->spacing;
    double *const kept =
        crease_duplicate(graph->context, edge->points, edge->count, 3 * sizeof *kept);
    if (!kept)
        return CREASE_ERROR_NO_MEMORY;
    *found = true;
    for (size_t i = 1; i + 1 < edge->count && *found; i++)
        *found = crease_graph_project(graph, edge->regions, reach, edge->points + 3 * i);
    if (!*found)
        memcpy(edge->points, kept, 3 * edge->count * sizeof *kept);
    free(kept);
    return CREASE_OK;
}

/* The same where they do so, for surfaces that join smoothly on one part of the way and with an
 * angle on another. Where they wave around each other the line stays as it is. */
static crease_status lay_on_part(const crease_graph *graph, crease_edge *edge)
{
    const double reach = REACH * graph->survey->spacing;
    double *const kept =
        crease_duplicate(graph->context, edge->points, edge->count, 3 * sizeof *kept);
    if (!kept)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 1; i + 1 < edge->count; i++) {
        double *const place = edge->points + 3 * i, first[3], second[3];
        crease_graph_distance(graph, edge->regions[0], place, first);
        crease_graph_distance(graph, edge->regions[1], place, second);
        if (fabs(crease_vector_dot(first, second)) < CROSSING_COSINE)
            crease_graph_project(graph, edge->regions, reach, place);
    }
    if (crease_edge_is_wild(edge))
        memcpy(edge->points, kept, 3 * edge->count * sizeof *kept);
    free(kept);
    return CREASE_OK;
}

static crease_status lay(const crease_graph *graph, crease_edge *edge, bool *found)
{
    double cosines[2];
    crease_status status = CREASE_OK;
    crease_edge_smooth(edge, ROUNDS);
    angles_along(graph, edge, cosines);
    if (cosines[0] < CROSSING_COSINE) {
        status = lay_on_curve(graph, edge, found);
        if (status != CREASE_OK || *found)
            return status;
    } else if (cosines[1] < SMOOTH_COSINE)
        status = lay_on_part(graph, edge);
    edge->smooth = edge->loose = true;
    *found = status == CREASE_OK && crease_edge_lay_midway(graph, edge);
    return status;
}

crease_status crease_trail_lay(const crease_graph *graph, const crease_loose *loose,
    const int32_t vertices[2], crease_edge *out, bool *found)
{
    struct search search;
    *found = false;
    *out = crease_edge_between(loose->regions[0], loose->regions[1]);
    if (loose->count > MOST_LINKS)
        return CREASE_OK;
    crease_status status = begin_search(graph, loose, vertices, &search);
    if (status == CREASE_OK && find_way(&search, graph->survey->spacing)) {
        status = take_way(graph, &search, out);
        if (status == CREASE_OK)
            status = lay(graph, out, found);
    }
    clear_search(&search);
    memcpy(out->vertices, vertices, sizeof out->vertices);
    if (!*found)
        crease_edge_clear(out);
    return status;
}
