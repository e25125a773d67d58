/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/missing.h"

#include "base/memory.h"
#include "base/vector.h"
#include "topology/bridge.h"
#include "topology/cycle.h"
#include "topology/meeting.h"
#include "topology/trail.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* In spacings. */
static const double SAME = 2.5; /* a corner and a vertex that is taken for it */

static const double FAR = 2.0; /* a corner in shadow from an end, in distances between the ends */

/* --------------------------------------------------------------------------------- cycles -- */

/* Ends that lead around a place: number i lacks an edge of regions i and i + 1. The missing edges
 * are the tree of the corners in which they meet, three at a time. Seen from the regions, the
 * corners are triangles of the polygon with the regions as its vertices; where a triangle has a
 * side of the polygon an end leads to the corner, and where two triangles meet an edge runs from
 * one corner to the other. Of all ways to cut the polygon that one is taken whose corners the
 * points show best. */
struct polygon {
    const crease_cycle *cycle;
    double costs[CREASE_MOST_SIDES][CREASE_MOST_SIDES]; /* of the polygon from one region to
                                                           another one */
    int middles[CREASE_MOST_SIDES][CREASE_MOST_SIDES];  /* third of the triangle on that diagonal */
    double places[CREASE_MOST_SIDES][CREASE_MOST_SIDES][3]; /* of its corner */
};

struct finding {
    crease_graph *graph;
    const crease_links *links;
    bool in_shadow; /* whether surfaces alone may tell where corners and edges are */
    crease_edge edges[2 * CREASE_MOST_SIDES];
    int edge_count;
};

/* How far apart the ends are. */
static double width_of(const struct finding *run, const crease_cycle *cycle)
{
    const crease_vertex *const v = run->graph->topology->vertices;
    double most = 0.0;
    for (int i = 0; i < cycle->count; i++)
        for (int k = 0; k < i; k++)
            most = fmax(most,
                crease_vector_distance(
                    v[cycle->ends[i]->vertex].place, v[cycle->ends[k]->vertex].place));
    return most;
}

/* The same where no points show the corner, as in the shadow of a scan: from the ends of the cycle
 * that lead there. */
static double cost_in_shadow(
    const struct finding *run, const crease_cycle *cycle, const int at[3], double place[3])
{
    const uint32_t regions[3] = {
        cycle->regions[at[0]], cycle->regions[at[1]], cycle->regions[at[2]]};
    const double reach = FAR * width_of(run, cycle);
    double least = INFINITY;
    for (int i = 0; i < cycle->count; i++) {
        double there[3];
        int common = 0;
        for (int k = 0; k < 3; k++)
            common += regions[k] == cycle->ends[i]->regions[0] ||
                regions[k] == cycle->ends[i]->regions[1];
        if (common < 2)
            continue;
        const double cost =
            crease_meeting_in_shadow(run->graph, cycle->ends[i]->vertex, regions, reach, there);
        if (cost < least) {
            least = cost;
            memcpy(place, there, sizeof there);
        }
    }
    return least;
}

/* How far the links of three regions of the cycle are from a corner of theirs. */
static double cost_of_corner(
    const struct finding *run, const crease_cycle *cycle, const int at[3], double place[3])
{
    uint32_t regions[3];
    int32_t vertices[3];
    if (run->in_shadow)
        return cost_in_shadow(run, cycle, at, place);
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
static bool cut(const struct finding *run, struct polygon *polygon)
{
    const crease_cycle *const cycle = polygon->cycle;
    for (int width = 1; width < cycle->count; width++)
        for (int low = 0; low + width < cycle->count; low++) {
            const int high = low + width;
            polygon->costs[low][high] = width == 1 ? 0.0 : INFINITY;
            for (int middle = low + 1; middle < high; middle++) {
                const double parts = polygon->costs[low][middle] + polygon->costs[middle][high];
                double place[3] = {0.0};
                if (!(parts < polygon->costs[low][high]))
                    continue;
                const double cost =
                    parts + cost_of_corner(run, cycle, (const int[]){low, middle, high}, place);
                if (!(cost < polygon->costs[low][high]))
                    continue;
                polygon->costs[low][high] = cost;
                polygon->middles[low][high] = middle;
                memcpy(polygon->places[low][high], place, sizeof place);
            }
        }
    return polygon->costs[0][cycle->count - 1] < INFINITY;
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
static crease_status corner_vertex(crease_graph *graph, const crease_cycle *cycle, int32_t before,
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
static crease_status lay(struct finding *run, const crease_cycle *cycle, int low, int high,
    const int32_t vertices[2], bool *found)
{
    const uint32_t a = cycle->regions[low], b = cycle->regions[high];
    crease_loose loose = {.regions = {a < b ? a : b, a < b ? b : a}};
    size_t part[2];
    crease_status status = CREASE_OK;
    if (vertices[0] == vertices[1])
        return CREASE_OK;
    if (run->in_shadow)
        return crease_bridge_lay(
            run->graph, loose.regions, vertices, &run->edges[run->edge_count++], found);
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
    struct finding *run, struct polygon *polygon, int low, int high, int32_t inner, bool *found)
{
    const crease_cycle *const cycle = polygon->cycle;
    if (high == low + 1)
        return lay(run, cycle, low, high, (int32_t[]){cycle->ends[low]->vertex, inner}, found);
    int32_t corner;
    crease_status status =
        corner_vertex(run->graph, cycle, inner, polygon->places[low][high], &corner);
    const int32_t from = inner != CREASE_NO_VERTEX ? inner : cycle->ends[high]->vertex;
    if (status == CREASE_OK)
        status = lay(run, cycle, low, high, (int32_t[]){from, corner}, found);
    const int middle = polygon->middles[low][high];
    if (status == CREASE_OK && *found)
        status = lay_from(run, polygon, low, middle, corner, found);
    if (status == CREASE_OK && *found)
        status = lay_from(run, polygon, middle, high, corner, found);
    return status;
}

/* Adds the edges of the cycle, all or none of them. */
static crease_status join(struct finding *run, struct polygon *polygon)
{
    const crease_cycle *const cycle = polygon->cycle;
    bool all = true;
    run->edge_count = 0;
    crease_status status = lay_from(run, polygon, 0, cycle->count - 1, CREASE_NO_VERTEX, &all);
    for (int i = 0; i < run->edge_count; i++) {
        if (all && status == CREASE_OK)
            status = crease_graph_take(run->graph, &run->edges[i]);
        crease_edge_clear(&run->edges[i]);
    }
    return status;
}

/* ---------------------------------------------------------------------------------- search -- */

static crease_status fill(void *user, const crease_cycle *cycle)
{
    struct finding *const run = user;
    struct polygon polygon = {.cycle = cycle};
    return cut(run, &polygon) ? join(run, &polygon) : CREASE_OK;
}

/* Two ends of which the one leads to the other, as that is the corner of their three regions: lays
 * the edge that the first lacks. The third region then lacks one at the corner. */
static crease_status lead(struct finding *run, const crease_end *from, const crease_end *to)
{
    crease_graph *const graph = run->graph;
    const double reach = SAME * graph->survey->spacing;
    uint32_t regions[3];
    double place[3];
    crease_edge edge = {.count = 0};
    bool found = false;
    if (!crease_edge_common(from->regions, to->regions, regions) ||
        !(crease_meeting_in_shadow(graph, to->vertex, regions, reach, place) < reach) ||
        crease_vector_distance(graph->topology->vertices[from->vertex].place, place) < reach)
        return CREASE_OK;
    crease_status status = crease_bridge_lay(
        graph, from->regions, (int32_t[]){from->vertex, to->vertex}, &edge, &found);
    if (found)
        status = crease_graph_take(graph, &edge);
    crease_edge_clear(&edge);
    return status;
}

static crease_status lead_ends(struct finding *run)
{
    crease_end *ends = NULL;
    size_t count = 0;
    crease_status status = crease_ends_list(run->graph, &ends, &count);
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < count && status == CREASE_OK; k++)
            if (i != k && crease_end_is_odd(run->graph, &ends[i]) &&
                crease_end_is_odd(run->graph, &ends[k]))
                status = lead(run, &ends[i], &ends[k]);
    free(ends);
    return status;
}

crease_status crease_missing_find(crease_graph *graph, const crease_links *links)
{
    struct finding run = {.graph = graph, .links = links};
    crease_status status = crease_cycles_visit(graph, fill, &run);
    run.in_shadow = true;
    if (status == CREASE_OK)
        status = crease_cycles_visit(graph, fill, &run);
    return status == CREASE_OK ? lead_ends(&run) : status;
}
