/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/bridge.h"

#include "base/memory.h"
#include "base/vector.h"
#include "topology/contact.h"
#include "topology/overshoot.h"
#include "topology/trail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* In spacings. */
static const double STEP = 0.5;
static const double REACH = 2.0;     /* of vertices from the curve that they are on */
static const double ONE = 1.0;       /* between surfaces that are nearly one */
static const double LONGEST = 15.0;  /* bridge between such */
static const double NEAR = 6.0;      /* bridge where no points are linked, over a gap in them */
static const double SAME_EDGE = 1.0; /* between a bridge and an edge that is there already */

static const double ALIKE = 0.9; /* cosine between the normals of surfaces that are nearly one */

/* Two vertices that lack an edge of the same two regions. */
struct gap {
    int32_t vertices[2];
    uint32_t regions[2];
    double length;
};

/* All gaps. */
struct gaps {
    size_t count, room;
    struct gap *items;
};

/* --------------------------------------------------------------------------------- gaps -- */

static crease_status add_gap(crease_graph *graph, struct gaps *gaps, const struct gap *gap)
{
    if (gaps->count == gaps->room) {
        const size_t room = 2 * gaps->room + 16;
        struct gap *const items =
            crease_reallocate(graph->context, gaps->items, room, sizeof *items);
        if (!items)
            return CREASE_ERROR_NO_MEMORY;
        gaps->items = items;
        gaps->room = room;
    }
    gaps->items[gaps->count++] = *gap;
    return CREASE_OK;
}

/* Regions that have edges at both vertices and lack one there; at most 8. */
static size_t common_regions(const crease_graph *graph, int32_t a, int32_t b, uint32_t out[8])
{
    const crease_topology *const t = graph->topology;
    size_t count = 0;
    for (size_t e = 0; e < t->edge_count; e++)
        for (int i = 0; i < 2; i++) {
            const uint32_t r = t->edges[e].regions[i];
            bool known = t->edges[e].vertices[0] != a && t->edges[e].vertices[1] != a;
            for (size_t k = 0; k < count; k++)
                known = known || out[k] == r;
            if (!known && count < 8 && crease_graph_odd(graph, a, r) &&
                crease_graph_odd(graph, b, r))
                out[count++] = r;
        }
    return count;
}

static bool is_odd(const crease_graph *graph, int32_t vertex)
{
    const crease_topology *const t = graph->topology;
    for (size_t e = 0; e < t->edge_count; e++)
        for (int i = 0; i < 2; i++)
            if ((t->edges[e].vertices[0] == vertex || t->edges[e].vertices[1] == vertex) &&
                crease_graph_odd(graph, vertex, t->edges[e].regions[i]))
                return true;
    return false;
}

static crease_status find_between(crease_graph *graph, struct gaps *gaps, int32_t a, int32_t b)
{
    const crease_vertex *const v = graph->topology->vertices;
    uint32_t regions[8];
    const size_t count = common_regions(graph, a, b, regions);
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < count; i++)
        for (size_t k = i + 1; k < count && status == CREASE_OK; k++) {
            const uint32_t low = regions[i] < regions[k] ? regions[i] : regions[k];
            const struct gap gap = {{a, b}, {low, regions[i] + regions[k] - low},
                crease_vector_distance(v[a].place, v[b].place)};
            status = add_gap(graph, gaps, &gap);
        }
    return status;
}

static crease_status find_gaps(crease_graph *graph, struct gaps *gaps)
{
    const size_t count = graph->topology->vertex_count;
    bool *const odd = crease_allocate(graph->context, count, sizeof *odd);
    crease_status status = odd ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    for (size_t v = 0; v < count && status == CREASE_OK; v++)
        odd[v] = is_odd(graph, (int32_t)v);
    for (size_t a = 0; a < count && status == CREASE_OK; a++)
        for (size_t b = a + 1; b < count && odd[a] && status == CREASE_OK; b++)
            if (odd[b])
                status = find_between(graph, gaps, (int32_t)a, (int32_t)b);
    free(odd);
    return status;
}

static int shorter(const void *first, const void *second)
{
    const struct gap *const a = first, *const b = second;
    if (a->length != b->length)
        return a->length < b->length ? -1 : 1;
    return memcmp(a, b, offsetof(struct gap, length));
}

/* ------------------------------------------------------------------------------- bridges -- */

static void place_at(const crease_graph *graph, const struct gap *gap, double share, double out[3])
{
    const crease_vertex *const v = graph->topology->vertices;
    for (int c = 0; c < 3; c++)
        out[c] =
            (1.0 - share) * v[gap->vertices[0]].place[c] + share * v[gap->vertices[1]].place[c];
}

/* Whether the surfaces cut each other at both ends and between. */
static bool is_crossed(const crease_graph *graph, const struct gap *gap)
{
    const double s = graph->survey->spacing;
    for (int i = 0; i <= 2; i++) {
        double place[3];
        place_at(graph, gap, 0.5 * i, place);
        if (!crease_graph_project(
                graph, gap->regions, REACH * s + (i == 1 ? gap->length : 0.0), place))
            return false;
    }
    return true;
}

/* Whether the surfaces are nearly one from end to end. */
static bool is_one(const crease_graph *graph, const struct gap *gap)
{
    const double s = graph->survey->spacing;
    bool one = gap->length < LONGEST * s;
    for (int i = 0; i <= 4 && one; i++) {
        double place[3], first[3], second[3];
        place_at(graph, gap, 0.25 * i, place);
        one = fabs(crease_graph_distance(graph, gap->regions[0], place, first)) < ONE * s &&
            fabs(crease_graph_distance(graph, gap->regions[1], place, second)) < ONE * s &&
            fabs(crease_vector_dot(first, second)) > ALIKE;
    }
    return one;
}

/* Points between the ends that lie on the edge's surfaces. */
static crease_status lay(crease_graph *graph, const struct gap *gap, crease_edge *edge)
{
    const crease_model *const all = graph->survey->regions->models;
    const crease_model *const models[2] = {&all[gap->regions[0]], &all[gap->regions[1]]};
    const crease_vertex *const v = graph->topology->vertices;
    const size_t steps = (size_t)fmax(2.0, gap->length / (STEP * graph->survey->spacing));
    crease_status status = crease_edge_append(graph->context, edge, v[gap->vertices[0]].place);
    for (size_t i = 1; i < steps && status == CREASE_OK; i++) {
        double place[3];
        bool on = true;
        place_at(graph, gap, (double)i / (double)steps, place);
        if (edge->loose)
            crease_contact_midway(models, place);
        else
            on = crease_graph_project(graph, gap->regions, gap->length, place);
        if (on)
            status = crease_edge_append(graph->context, edge, place);
    }
    if (status == CREASE_OK)
        status = crease_edge_append(graph->context, edge, v[gap->vertices[1]].place);
    return status;
}

/* Whether most of the edge runs where its two regions have one. */
static bool is_there(const crease_graph *graph, const crease_edge *edge)
{
    const crease_topology *const t = graph->topology;
    size_t beside = 0;
    for (size_t i = 1; i + 1 < edge->count; i++) {
        double least = INFINITY;
        for (size_t e = 0; e < t->edge_count; e++)
            if (memcmp(t->edges[e].regions, edge->regions, sizeof edge->regions) == 0)
                least = fmin(least, crease_edge_distance(&t->edges[e], edge->points + 3 * i));
        beside += least < SAME_EDGE * graph->survey->spacing;
    }
    return 2 * beside > edge->count - 2;
}

/* Lets an edge of the two regions that ends by itself at one of the vertices, having passed by the
 * other one, end there. */
static crease_status retract(const crease_graph *graph, const struct gap *gap, int which)
{
    const crease_topology *const t = graph->topology;
    const int32_t leaf = gap->vertices[which], to = gap->vertices[1 - which];
    const double *const place = t->vertices[to].place;
    for (size_t e = 0; e < t->edge_count; e++) {
        crease_edge *const edge = &t->edges[e];
        const int end = edge->vertices[1] == leaf;
        if (memcmp(edge->regions, gap->regions, sizeof edge->regions) != 0 ||
            edge->vertices[end] != leaf || edge->vertices[1 - end] == to ||
            crease_edge_distance(edge, place) > SAME_EDGE * graph->survey->spacing)
            continue;
        return crease_edge_retract(graph, edge, end, to);
    }
    return CREASE_OK;
}

static crease_status retract_leaves(const crease_graph *graph, const struct gap *gap)
{
    for (int w = 0; w < 2; w++)
        if (crease_graph_ends(graph, gap->vertices[w], -1) == 1)
            return retract(graph, gap, w);
    return CREASE_OK;
}

static bool is_open(const crease_graph *graph, const struct gap *gap)
{
    for (int i = 0; i < 4; i++)
        if (!crease_graph_odd(graph, gap->vertices[i / 2], gap->regions[i % 2]))
            return false;
    return true;
}

static crease_status make(crease_graph *graph, const struct gap *gap, crease_edge *out, bool *found)
{
    const bool crossed = is_crossed(graph, gap);
    *found = false;
    *out = crease_edge_between(gap->regions[0], gap->regions[1]);
    if (!crossed && !is_one(graph, gap))
        return CREASE_OK;
    out->smooth = out->loose = !crossed;
    memcpy(out->vertices, gap->vertices, sizeof out->vertices);
    const crease_status status = lay(graph, gap, out);
    *found = status == CREASE_OK && !(crossed && crease_edge_is_wild(out));
    if (!*found)
        crease_edge_clear(out);
    return status;
}

crease_status crease_bridge_lay(crease_graph *graph, const uint32_t regions[2],
    const int32_t vertices[2], crease_edge *out, bool *found)
{
    const crease_vertex *const v = graph->topology->vertices;
    const struct gap gap = {{vertices[0], vertices[1]}, {regions[0], regions[1]},
        crease_vector_distance(v[vertices[0]].place, v[vertices[1]].place)};
    return make(graph, &gap, out, found);
}

static crease_status bridge(crease_graph *graph, const struct gap *gap)
{
    crease_edge edge;
    bool found;
    if (!is_open(graph, gap))
        return CREASE_OK;
    crease_status status = make(graph, gap, &edge, &found);
    if (found)
        status =
            is_there(graph, &edge) ? retract_leaves(graph, gap) : crease_graph_take(graph, &edge);
    crease_edge_clear(&edge);
    return status;
}

/* Where no surface tells the way, along the links between the two regions. */
static crease_status follow_links(
    crease_graph *graph, const crease_links *links, const struct gap *gap)
{
    crease_loose loose = {.regions = {gap->regions[0], gap->regions[1]}};
    crease_edge edge = {.count = 0};
    bool found = false;
    size_t run[2];
    crease_status status = CREASE_OK;
    if (!is_open(graph, gap))
        return status;
    if (crease_links_between(links, gap->regions, run))
        status = crease_loose_find(graph, links, run[0], run[1], &loose);
    else if (gap->length > NEAR * graph->survey->spacing)
        return status;
    if (status == CREASE_OK)
        status = crease_trail_lay(graph, &loose, gap->vertices, &edge, &found);
    if (status == CREASE_OK && found)
        status =
            is_there(graph, &edge) ? retract_leaves(graph, gap) : crease_graph_take(graph, &edge);
    crease_edge_clear(&edge);
    crease_loose_clear(&loose);
    return status;
}

crease_status crease_bridges_build(crease_graph *graph, const crease_links *links)
{
    struct gaps gaps = {.count = 0};
    crease_status status = find_gaps(graph, &gaps);
    if (gaps.count > 0)
        qsort(gaps.items, gaps.count, sizeof *gaps.items, shorter);
    for (size_t i = 0; i < gaps.count && status == CREASE_OK; i++)
        status = bridge(graph, &gaps.items[i]);
    for (size_t i = 0; i < gaps.count && status == CREASE_OK; i++)
        status = follow_links(graph, links, &gaps.items[i]);
    free(gaps.items);
    return status;
}
