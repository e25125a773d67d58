/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "model/missing.h"

#include "base/memory.h"
#include "base/vector.h"
#include "model/trail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* In spacings. */
static const double TOGETHER = 3.0; /* links of three pairs around a corner */
static const double KNOWN = 3.0;    /* from a corner that the three regions have already */
static const double SAME = 2.5;     /* a corner and a vertex that is taken for it */
static const double GAP = 10.0;     /* between ends around a hole in the points, at most, ... */
static const double MOVE = 4.0;     /* from their middle to the corner, ... */
static const double APART = 1.0;    /* and from there to each surface */

enum { ROUNDS = 20 };

/* A vertex that lacks an edge of exactly two regions. */
struct end {
    int32_t vertex;
    uint32_t regions[2]; /* ascending */
};

struct ends {
    size_t count;
    struct end *items;
};

/* ---------------------------------------------------------------------------------- ends -- */

/* The regions that lack an edge at a vertex; at most `most`. */
static size_t odd_regions(const crease_graph *graph, int32_t vertex, size_t most, uint32_t *out)
{
    const crease_topology *const t = graph->topology;
    size_t count = 0;
    for (size_t e = 0; e < t->edge_count; e++)
        for (int i = 0; i < 2; i++) {
            const uint32_t region = t->edges[e].regions[i];
            size_t k = 0;
            if (t->edges[e].vertices[0] != vertex && t->edges[e].vertices[1] != vertex)
                continue;
            while (k < count && out[k] != region)
                k++;
            if (k == count && count < most && crease_graph_odd(graph, vertex, region))
                out[count++] = region;
        }
    return count;
}

static crease_status list_ends(const crease_graph *graph, struct ends *out)
{
    const size_t vertices = graph->topology->vertex_count;
    *out = (struct ends){.items = crease_allocate(graph->context, vertices, sizeof *out->items)};
    if (!out->items)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t v = 0; v < vertices; v++) {
        uint32_t odd[3];
        if (odd_regions(graph, (int32_t)v, 3, odd) != 2)
            continue;
        const uint32_t low = odd[0] < odd[1] ? odd[0] : odd[1];
        out->items[out->count++] = (struct end){(int32_t)v, {low, odd[0] + odd[1] - low}};
    }
    return CREASE_OK;
}

static bool lacks(const struct end *end, uint32_t a, uint32_t b)
{
    return end->regions[0] == (a < b ? a : b) && end->regions[1] == (a < b ? b : a);
}

/* -------------------------------------------------------------------------------- corners -- */

/* The link of a run nearest to a place, and its distance. */
static double nearest(
    const crease_links *links, const size_t run[2], const double place[3], const double **out)
{
    double least = INFINITY;
    for (size_t i = run[0]; i < run[1]; i++) {
        const double away = crease_vector_distance(links->items[i].place, place);
        if (away < least) {
            least = away;
            *out = links->items[i].place;
        }
    }
    return least;
}

/* Whether the three regions meet in a vertex beside a place already. */
static bool is_known(const crease_graph *graph, const uint32_t regions[3], const double place[3])
{
    const crease_topology *const t = graph->topology;
    for (size_t v = 0; v < t->vertex_count; v++) {
        bool all = crease_vector_distance(t->vertices[v].place, place) < KNOWN * t->spacing;
        for (int i = 0; i < 3 && all; i++)
            all = crease_graph_ends(graph, (int32_t)v, regions[i]) > 0;
        if (all)
            return true;
    }
    return false;
}

/* Where the points of three regions come together. False when they do not, or where they have a
 * corner already. */
static bool find_corner(const crease_graph *graph, const crease_links *links,
    const uint32_t regions[3], double place[3])
{
    size_t runs[3][2];
    double least = TOGETHER * graph->survey->spacing;
    bool found = false;
    for (int i = 0; i < 3; i++) {
        const uint32_t a = regions[i], b = regions[(i + 1) % 3];
        if (!crease_links_between(links, (uint32_t[]){a < b ? a : b, a < b ? b : a}, runs[i]))
            return false;
    }
    for (size_t i = runs[0][0]; i < runs[0][1]; i++) {
        const double *const at = links->items[i].place, *second = NULL, *third = NULL;
        const double away =
            fmax(nearest(links, runs[1], at, &second), nearest(links, runs[2], at, &third));
        if (away >= least || is_known(graph, regions, at))
            continue;
        least = away;
        found = true;
        for (int c = 0; c < 3; c++)
            place[c] = (at[c] + second[c] + third[c]) / 3.0;
    }
    return found;
}

/* Where the points leave a hole around the corner: the place beside the ends that is nearest to all
 * three surfaces. False when the ends are far from each other, or the surfaces from the place. */
static bool find_in_hole(const crease_graph *graph, const struct end *const ends[3],
    const uint32_t regions[3], double place[3])
{
    const crease_vertex *const v = graph->topology->vertices;
    const double s = graph->survey->spacing;
    double middle[3], gradient[3], most = 0.0;
    for (int i = 0; i < 3; i++)
        if (crease_vector_distance(v[ends[i]->vertex].place, v[ends[(i + 1) % 3]->vertex].place) >
            GAP * s)
            return false;
    for (int c = 0; c < 3; c++) {
        middle[c] = 0.0;
        for (int i = 0; i < 3; i++)
            middle[c] += v[ends[i]->vertex].place[c] / 3.0;
        place[c] = middle[c];
    }
    for (int i = 0; i < 3 * ROUNDS; i++) {
        const double away = crease_graph_distance(graph, regions[i % 3], place, gradient);
        for (int c = 0; c < 3; c++)
            place[c] -= away * gradient[c];
    }
    for (int i = 0; i < 3; i++)
        most = fmax(most, fabs(crease_graph_distance(graph, regions[i], place, gradient)));
    return most < APART * s && crease_vector_distance(place, middle) < MOVE * s &&
        !is_known(graph, regions, place);
}

/* The vertex that the three ends lead to: one of theirs, or a new one. */
static crease_status corner_vertex(
    crease_graph *graph, const struct end *const ends[3], const double place[3], int32_t *out)
{
    const double s = graph->survey->spacing;
    double least = SAME * s;
    *out = CREASE_NO_VERTEX;
    for (int i = 0; i < 3; i++) {
        const int32_t vertex = ends[i]->vertex;
        const double away = crease_vector_distance(graph->topology->vertices[vertex].place, place);
        if (away < least) {
            least = away;
            *out = vertex;
        }
    }
    return *out == CREASE_NO_VERTEX ? crease_graph_vertex(graph, place, out) : CREASE_OK;
}

static crease_status lay(const crease_graph *graph, const crease_links *links,
    const struct end *end, int32_t corner, crease_edge *out, bool *found)
{
    const int32_t vertices[2] = {end->vertex, corner};
    crease_loose loose = {.regions = {end->regions[0], end->regions[1]}};
    size_t run[2];
    crease_status status = CREASE_OK;
    if (crease_links_between(links, end->regions, run))
        status = crease_loose_find(graph, links, run[0], run[1], &loose);
    if (status == CREASE_OK)
        status = crease_trail_lay(graph, &loose, vertices, out, found);
    crease_loose_clear(&loose);
    return status;
}

/* Adds the edges from three ends to a corner, all or none of them. */
static crease_status join(
    crease_graph *graph, const crease_links *links, const struct end *const ends[3], int32_t corner)
{
    crease_edge edges[3] = {{.count = 0}};
    crease_status status = CREASE_OK;
    bool all = true;
    for (int i = 0; i < 3 && all && status == CREASE_OK; i++)
        if (ends[i]->vertex != corner)
            status = lay(graph, links, ends[i], corner, &edges[i], &all);
    for (int i = 0; i < 3; i++) {
        if (all && status == CREASE_OK && edges[i].count > 0)
            status = crease_graph_take(graph, &edges[i]);
        crease_edge_clear(&edges[i]);
    }
    return status;
}

static bool is_still_odd(const crease_graph *graph, const struct end *end)
{
    return crease_graph_odd(graph, end->vertex, end->regions[0]) &&
        crease_graph_odd(graph, end->vertex, end->regions[1]);
}

static crease_status try_three(
    crease_graph *graph, const crease_links *links, const struct end *const ends[3])
{
    uint32_t regions[3];
    double place[3];
    int32_t corner;
    for (int i = 0; i < 3; i++)
        if (!is_still_odd(graph, ends[i]))
            return CREASE_OK;
    if (!crease_edge_common(ends[0]->regions, ends[1]->regions, regions) ||
        (!find_corner(graph, links, regions, place) && !find_in_hole(graph, ends, regions, place)))
        return CREASE_OK;
    const crease_status status = corner_vertex(graph, ends, place, &corner);
    return status == CREASE_OK ? join(graph, links, ends, corner) : status;
}

crease_status crease_missing_find(crease_graph *graph, const crease_links *links)
{
    struct ends ends;
    crease_status status = list_ends(graph, &ends);
    for (size_t a = 0; a < ends.count && status == CREASE_OK; a++)
        for (size_t b = a + 1; b < ends.count && status == CREASE_OK; b++) {
            const struct end *three[3] = {&ends.items[a], &ends.items[b], NULL};
            uint32_t regions[3];
            if (!crease_edge_common(three[0]->regions, three[1]->regions, regions))
                continue;
            for (size_t c = b + 1; c < ends.count && status == CREASE_OK; c++) {
                three[2] = &ends.items[c];
                if (lacks(three[2], regions[1], regions[2]))
                    status = try_three(graph, links, three);
            }
        }
    free(ends.items);
    return status;
}
