/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/missing.h"

#include "base/memory.h"
#include "base/vector.h"
#include "topology/meeting.h"
#include "topology/trail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    MOST_SIDES = 6,    /* of a cycle */
    MOST_TRIALS = 4000 /* cycles looked at */
};

/* In spacings. */
static const double SAME = 2.5; /* a corner and a vertex that is taken for it */

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

/* --------------------------------------------------------------------------------- cycles -- */

/* Ends that lead around a place: number i lacks an edge of regions i and i + 1. The missing edges
 * are the tree of the corners in which they meet, three at a time. Seen from the regions, the
 * corners are triangles of the polygon with the regions as its vertices; where a triangle has a
 * side of the polygon an end leads to the corner, and where two triangles meet an edge runs from
 * one corner to the other. Of all ways to cut the polygon that one is taken whose corners the
 * points show best. */
struct cycle {
    int count;
    const struct end *ends[MOST_SIDES];
    uint32_t regions[MOST_SIDES];
    double costs[MOST_SIDES][MOST_SIDES];     /* of the polygon from one region to another one */
    int middles[MOST_SIDES][MOST_SIDES];      /* third of the triangle on that diagonal */
    double places[MOST_SIDES][MOST_SIDES][3]; /* of its corner */
};

struct finding {
    crease_graph *graph;
    const crease_links *links;
    const struct ends *ends;
    size_t trials;
    crease_edge edges[2 * MOST_SIDES];
    int edge_count;
};

static bool is_still_odd(const crease_graph *graph, const struct end *end)
{
    return crease_graph_odd(graph, end->vertex, end->regions[0]) &&
        crease_graph_odd(graph, end->vertex, end->regions[1]);
}

/* How far the links of three regions of the cycle are from a corner of theirs. */
static double cost_of_corner(
    const struct finding *run, const struct cycle *cycle, const int at[3], double place[3])
{
    uint32_t regions[3];
    int32_t vertices[3];
    for (int i = 0; i < 3; i++) {
        regions[i] = cycle->regions[at[i]];
        vertices[i] = cycle->ends[i]->vertex;
    }
    const double cost = crease_meeting_find(run->graph, run->links, regions, place);
    if (cost == INFINITY && cycle->count == 3 &&
        crease_meeting_in_hole(run->graph, vertices, regions, place))
        return 0.0;
    return cost;
}

/* Cuts the polygon into triangles, smaller parts first.
 *
 * Based on: Klincsek. Minimal triangulations of polygonal domains. 1980. */
static bool cut(const struct finding *run, struct cycle *cycle)
{
    for (int width = 1; width < cycle->count; width++)
        for (int low = 0; low + width < cycle->count; low++) {
            const int high = low + width;
            cycle->costs[low][high] = width == 1 ? 0.0 : INFINITY;
            for (int middle = low + 1; middle < high; middle++) {
                const double parts = cycle->costs[low][middle] + cycle->costs[middle][high];
                double place[3] = {0.0};
                if (!(parts < cycle->costs[low][high]))
                    continue;
                const double cost =
                    parts + cost_of_corner(run, cycle, (const int[]){low, middle, high}, place);
                if (!(cost < cycle->costs[low][high]))
                    continue;
                cycle->costs[low][high] = cost;
                cycle->middles[low][high] = middle;
                memcpy(cycle->places[low][high], place, sizeof place);
            }
        }
    return cycle->costs[0][cycle->count - 1] < INFINITY;
}

/* -------------------------------------------------------------------------------- corners -- */

static void keep_nearer(
    const crease_graph *graph, int32_t vertex, const double place[3], double *least, int32_t *out)
{
    const double away = crease_vector_distance(graph->topology->vertices[vertex].place, place);
    if (away < *least) {
        *least = away;
        *out = vertex;
    }
}

/* The vertex beside a corner: that of an end, of the corner before it, or a new one. */
static crease_status corner_vertex(crease_graph *graph, const struct cycle *cycle, int32_t before,
    const double place[3], int32_t *out)
{
    double least = SAME * graph->survey->spacing;
    *out = CREASE_NO_VERTEX;
    if (before != CREASE_NO_VERTEX)
        keep_nearer(graph, before, place, &least, out);
    for (int i = 0; i < cycle->count; i++)
        keep_nearer(graph, cycle->ends[i]->vertex, place, &least, out);
    return *out == CREASE_NO_VERTEX ? crease_graph_vertex(graph, place, out) : CREASE_OK;
}

/* Lays an edge between two regions of the cycle. */
static crease_status lay(struct finding *run, const struct cycle *cycle, int low, int high,
    const int32_t vertices[2], bool *found)
{
    const uint32_t a = cycle->regions[low], b = cycle->regions[high];
    crease_loose loose = {.regions = {a < b ? a : b, a < b ? b : a}};
    size_t part[2];
    crease_status status = CREASE_OK;
    if (vertices[0] == vertices[1])
        return CREASE_OK;
    if (crease_links_between(run->links, loose.regions, part))
        status = crease_loose_find(run->graph, run->links, part[0], part[1], &loose);
    if (status == CREASE_OK)
        status =
            crease_trail_lay(run->graph, &loose, vertices, &run->edges[run->edge_count++], found);
    crease_loose_clear(&loose);
    return status;
}

/* Lays the edge across the side low, high of a triangle whose corner is `inner`, then those of the
 * triangle beyond. */
static crease_status lay_from(
    struct finding *run, struct cycle *cycle, int low, int high, int32_t inner, bool *found)
{
    if (high == low + 1)
        return lay(run, cycle, low, high, (int32_t[]){cycle->ends[low]->vertex, inner}, found);
    int32_t corner;
    crease_status status =
        corner_vertex(run->graph, cycle, inner, cycle->places[low][high], &corner);
    const int32_t from = inner != CREASE_NO_VERTEX ? inner : cycle->ends[high]->vertex;
    if (status == CREASE_OK)
        status = lay(run, cycle, low, high, (int32_t[]){from, corner}, found);
    const int middle = cycle->middles[low][high];
    if (status == CREASE_OK && *found)
        status = lay_from(run, cycle, low, middle, corner, found);
    if (status == CREASE_OK && *found)
        status = lay_from(run, cycle, middle, high, corner, found);
    return status;
}

/* Adds the edges of the cycle, all or none of them. */
static crease_status join(struct finding *run, struct cycle *cycle)
{
    bool all = true;
    run->edge_count = 0;
    crease_status status = lay_from(run, cycle, 0, cycle->count - 1, CREASE_NO_VERTEX, &all);
    for (int i = 0; i < run->edge_count; i++) {
        if (all && status == CREASE_OK)
            status = crease_graph_take(run->graph, &run->edges[i]);
        crease_edge_clear(&run->edges[i]);
    }
    return status;
}

/* ---------------------------------------------------------------------------------- search -- */

static bool has_region(const struct cycle *cycle, int known, uint32_t region)
{
    for (int i = 0; i < known; i++)
        if (cycle->regions[i] == region)
            return true;
    return false;
}

/* Goes on with every end that leads from the last region of the cycle to a new one, or, for its
 * last side, back to the first. */
static crease_status extend(struct finding *run, struct cycle *cycle, int sides)
{
    const uint32_t from = cycle->regions[sides];
    const bool closing = sides + 1 == cycle->count || sides + 1 == MOST_SIDES;
    crease_status status = CREASE_OK;
    for (const struct end *end = cycle->ends[0] + 1;
         end < run->ends->items + run->ends->count && status == CREASE_OK; end++) {
        if (end->regions[0] != from && end->regions[1] != from)
            continue;
        const uint32_t to = end->regions[0] == from ? end->regions[1] : end->regions[0];
        if (closing ? to != cycle->regions[0] : has_region(cycle, sides, to))
            continue;
        if (run->trials++ >= MOST_TRIALS || !is_still_odd(run->graph, cycle->ends[0]))
            break;
        cycle->ends[sides] = end;
        if (!is_still_odd(run->graph, end))
            continue;
        if (!closing) {
            cycle->regions[sides + 1] = to;
            status = extend(run, cycle, sides + 1);
        } else if (cut(run, cycle))
            status = join(run, cycle);
    }
    return status;
}

static crease_status try_cycles(struct finding *run, int count)
{
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < run->ends->count && status == CREASE_OK; i++) {
        const struct end *const first = &run->ends->items[i];
        struct cycle cycle = {
            .count = count, .ends = {first}, .regions = {first->regions[0], first->regions[1]}};
        status = extend(run, &cycle, 1);
    }
    return status;
}

crease_status crease_missing_find(crease_graph *graph, const crease_links *links)
{
    struct ends ends;
    crease_status status = list_ends(graph, &ends);
    struct finding run = {.graph = graph, .links = links, .ends = &ends};
    for (int count = 3; count <= MOST_SIDES && status == CREASE_OK; count++)
        status = try_cycles(&run, count);
    free(ends.items);
    return status;
}
