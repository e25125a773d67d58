/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/extend.h"

#include "base/memory.h"
#include "base/vector.h"
#include "crease/intersect.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* In spacings. */
static const double STEP = 0.5;
static const double BEHIND = 3.0; /* that a corner may be behind an end */
static const double REACH = 10.0; /* and twice the distance of the ends: of a corner from them */
static const double CLOSE = 0.05; /* surfaces that meet */
static const double PROJECT = 5.0;
static const double OTHERS = 10.0; /* more, that other ends may be away */

/* An end of an edge without vertex. */
struct tip {
    size_t edge;
    int which;
    double place[3], ahead[3];
};

struct tips {
    size_t count;
    struct tip *items;
};

/* Two tips that would meet in a corner. */
struct corner {
    double length; /* of both extensions; INFINITY: none */
    double place[3];
    uint32_t regions[3];
    size_t tips[2];
};

static struct tip tip_of(const crease_edge *edge, size_t number, int which)
{
    const double *const end = edge->points + (which ? 3 * (edge->count - 1) : 0);
    const double *const before = which ? end - 3 : end + 3;
    struct tip tip = {.edge = number, .which = which};
    for (int c = 0; c < 3; c++) {
        tip.place[c] = end[c];
        tip.ahead[c] = end[c] - before[c];
    }
    crease_vector_normalise(tip.ahead);
    return tip;
}

static void list_tips(const crease_graph *graph, struct tips *tips)
{
    const crease_topology *const t = graph->topology;
    tips->count = 0;
    for (size_t e = 0; e < t->edge_count; e++)
        for (int w = 0; w < 2; w++)
            if (!t->edges[e].closed && t->edges[e].count > 1 &&
                t->edges[e].vertices[w] == CREASE_NO_VERTEX)
                tips->items[tips->count++] = tip_of(&t->edges[e], e, w);
}

/* How far ahead of a tip a place is. */
static double ahead_of(const struct tip *tip, const double place[3])
{
    double d[3];
    for (int c = 0; c < 3; c++)
        d[c] = place[c] - tip->place[c];
    return crease_vector_dot(d, tip->ahead);
}

static void try_corner(
    const crease_graph *graph, const struct tips *tips, size_t a, size_t b, struct corner *best)
{
    const crease_topology *const t = graph->topology;
    const struct tip *const x = &tips->items[a], *const y = &tips->items[b];
    const double s = graph->survey->spacing;
    const double span = crease_vector_distance(x->place, y->place);
    const crease_model *models[3];
    struct corner corner = {.tips = {a, b}};
    if (span > best->length ||
        !crease_edge_common(t->edges[x->edge].regions, t->edges[y->edge].regions, corner.regions))
        return;
    for (int i = 0; i < 3; i++) {
        models[i] = &graph->survey->regions->models[corner.regions[i]];
        corner.place[i] = 0.5 * (x->place[i] + y->place[i]);
    }
    if (!crease_intersection_meet(models, 3, 2.0 * span + REACH * s, CLOSE * s, corner.place))
        return;
    corner.length = crease_vector_distance(corner.place, x->place) +
        crease_vector_distance(corner.place, y->place);
    if (corner.length < best->length && ahead_of(x, corner.place) > -BEHIND * s &&
        ahead_of(y, corner.place) > -BEHIND * s)
        *best = corner;
}

/* ---------------------------------------------------------------------------- extending -- */

/* Points from an end towards a place, on both surfaces. */
static crease_status fill(crease_graph *graph, const struct tip *tip, const double place[3])
{
    crease_edge *const edge = &graph->topology->edges[tip->edge];
    const double s = graph->survey->spacing;
    const size_t steps = (size_t)(crease_vector_distance(tip->place, place) / (STEP * s));
    crease_status status = CREASE_OK;
    for (size_t i = 1; i < steps && status == CREASE_OK && ahead_of(tip, place) > 0.0; i++) {
        double at[3];
        for (int c = 0; c < 3; c++)
            at[c] = tip->place[c] + (double)i / (double)steps * (place[c] - tip->place[c]);
        if (crease_graph_project(graph, edge->regions, PROJECT * s, at))
            status = crease_edge_insert(graph->context, edge, tip->which ? edge->count : 0, at);
    }
    return status;
}

static bool is_one_of(const struct corner *corner, uint32_t region)
{
    return corner->regions[0] == region || corner->regions[1] == region ||
        corner->regions[2] == region;
}

/* Whether an end other than the two that made the corner comes to it as well. */
static bool joins(
    const crease_graph *graph, const struct tip *tip, const struct corner *corner, int32_t vertex)
{
    const crease_edge *const edge = &graph->topology->edges[tip->edge];
    const double s = graph->survey->spacing;
    return is_one_of(corner, edge->regions[0]) && is_one_of(corner, edge->regions[1]) &&
        edge->vertices[1 - tip->which] != vertex && ahead_of(tip, corner->place) > -BEHIND * s &&
        crease_vector_distance(tip->place, corner->place) < corner->length + OTHERS * s;
}

static crease_status make_corner(
    crease_graph *graph, const struct tips *tips, const struct corner *corner)
{
    int32_t vertex;
    crease_status status = crease_graph_vertex(graph, corner->place, &vertex);
    for (size_t i = 0; i < tips->count && status == CREASE_OK; i++) {
        const struct tip *const tip = &tips->items[i];
        if (i != corner->tips[0] && i != corner->tips[1] && !joins(graph, tip, corner, vertex))
            continue;
        graph->topology->edges[tip->edge].vertices[tip->which] = vertex;
        status = fill(graph, tip, corner->place);
    }
    return status;
}

crease_status crease_ends_extend(crease_graph *graph)
{
    struct tips tips = {.count = 0};
    struct corner best;
    tips.items =
        crease_allocate(graph->context, graph->topology->edge_count, 2 * sizeof *tips.items);
    crease_status status = tips.items ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    for (best.length = 0.0; best.length < INFINITY && status == CREASE_OK;) {
        best.length = INFINITY;
        list_tips(graph, &tips);
        for (size_t a = 0; a < tips.count; a++)
            for (size_t b = a + 1; b < tips.count; b++)
                try_corner(graph, &tips, a, b, &best);
        if (best.length < INFINITY)
            status = make_corner(graph, &tips, &best);
    }
    free(tips.items);
    return status;
}
