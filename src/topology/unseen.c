/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/unseen.h"

#include "base/memory.h"
#include "base/vector.h"
#include "crease/intersect.h"
#include "topology/bridge.h"
#include "topology/overshoot.h"
#include "topology/rest.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_CYCLES = 60 /* that are looked at */ };

/* In spacings. */
static const double CLOSE = 0.05; /* surfaces that cut each other */
static const double BESIDE = 1.0; /* of an edge that goes on past its corner */

static const double FAR = 1.5;     /* of a corner from its end, in distances between the ends */
static const double ALIKE = 0.995; /* cosine between directions that are one */
static const double STEEP = 0.3;   /* least sine of the angle with each neighbour */

struct finding {
    crease_graph *graph;
    const crease_rests *rests;
    crease_unseens *out;
    size_t room, looked_at;
};

/* ------------------------------------------------------------------------------ directions -- */

static const crease_model *model_of(const crease_graph *graph, uint32_t region)
{
    return &graph->survey->regions->models[region];
}

/* The normal of a plane, or the axis of a round surface; NULL where there is none. */
static const double *direction_of(const crease_model *model)
{
    return model->type == CREASE_REGION_PLANE || model->type == CREASE_REGION_CYLINDER ||
            model->type == CREASE_REGION_CONE
        ? model->axes + 6
        : NULL;
}

/* Whether a region before this one has the direction. */
static bool is_known(const crease_graph *graph, uint32_t region)
{
    const double *const direction = direction_of(model_of(graph, region));
    for (uint32_t i = 0; i < region; i++) {
        const double *const other = direction_of(model_of(graph, i));
        if (other && fabs(crease_vector_dot(direction, other)) > ALIKE)
            return true;
    }
    return false;
}

/* -------------------------------------------------------------------------------- corners -- */

/* At right angles to the direction of a model. */
static crease_model plane_at(const crease_model *like, double offset, const double beside[3])
{
    const double *const normal = like->axes + 6;
    crease_model plane = {.type = CREASE_REGION_PLANE};
    const double away = offset - crease_vector_dot(normal, beside);
    memcpy(plane.axes, like->axes, sizeof plane.axes);
    for (int c = 0; c < 3; c++)
        plane.centre[c] = beside[c] + away * normal[c];
    memcpy(plane.pivot, plane.centre, sizeof plane.pivot);
    return plane;
}

/* Where the plane cuts the lines that lead to it; false where it does not, or far away. */
static bool find_corners(const crease_graph *graph, crease_unseen *unseen)
{
    const crease_vertex *const v = graph->topology->vertices;
    const crease_cycle *const cycle = &unseen->cycle;
    const double s = graph->survey->spacing;
    double width = 0.0;
    for (int i = 0; i < cycle->count; i++)
        for (int k = 0; k < i; k++)
            width = fmax(width,
                crease_vector_distance(
                    v[unseen->ends[i].vertex].place, v[unseen->ends[k].vertex].place));
    for (int i = 0; i < cycle->count; i++) {
        const crease_model *const models[3] = {model_of(graph, unseen->ends[i].regions[0]),
            model_of(graph, unseen->ends[i].regions[1]), &unseen->plane};
        memcpy(unseen->corners[i], v[unseen->ends[i].vertex].place, sizeof unseen->corners[i]);
        if (!crease_intersection_meet(models, 3, FAR * width, CLOSE * s, unseen->corners[i]))
            return false;
    }
    return true;
}

/* --------------------------------------------------------------------------------- planes -- */

/* Whether an edge of the two regions of an end leads there. */
static bool is_traced(const crease_graph *graph, const crease_end *end)
{
    const crease_topology *const t = graph->topology;
    for (size_t e = 0; e < t->edge_count; e++)
        if ((t->edges[e].vertices[0] == end->vertex || t->edges[e].vertices[1] == end->vertex) &&
            memcmp(t->edges[e].regions, end->regions, sizeof end->regions) == 0)
            return true;
    return false;
}

/* The best plane of one direction: that at which the points of most neighbours end. Returns how
 * long their borders are. */
static double try_direction(
    const struct finding *run, const crease_cycle *cycle, const double normal[3], double *offset)
{
    const crease_vertex *const v = run->graph->topology->vertices;
    crease_rest_side sides[CREASE_MOST_SIDES];
    double best = 0.0;
    for (int i = 0; i < cycle->count; i++) {
        const int before = (i + cycle->count - 1) % cycle->count;
        const double *const from = v[cycle->ends[before]->vertex].place;
        const double *const to = v[cycle->ends[i]->vertex].place;
        double gradient[3];
        crease_graph_distance(run->graph, cycle->regions[i], from, gradient);
        sides[i] = (crease_rest_side){.region = cycle->regions[i]};
        crease_vector_cross(normal, gradient, sides[i].along);
        if (crease_vector_length(sides[i].along) < STEEP)
            return 0.0;
        crease_vector_normalise(sides[i].along);
        const double a = crease_vector_dot(sides[i].along, from);
        const double b = crease_vector_dot(sides[i].along, to);
        sides[i].low = fmin(a, b);
        sides[i].high = fmax(a, b);
    }
    for (int i = 0; i < cycle->count; i++) {
        if (!is_traced(run->graph, cycle->ends[i]))
            continue;
        double at = crease_vector_dot(normal, v[cycle->ends[i]->vertex].place);
        const double length = crease_rests_end(run->rests, sides, cycle->count, normal, &at);
        if (length > best) {
            best = length;
            *offset = at;
        }
    }
    return best;
}

static bool find_plane(const struct finding *run, const crease_cycle *cycle, crease_unseen *out)
{
    const crease_graph *const graph = run->graph;
    double best = 0.0;
    for (uint32_t r = 0; r < graph->survey->regions->region_count; r++) {
        const double *const normal = direction_of(model_of(graph, r));
        double offset = 0.0;
        if (!normal || is_known(graph, r))
            continue;
        const double length = try_direction(run, cycle, normal, &offset);
        if (length <= best)
            continue;
        crease_unseen trial = {.cycle = *cycle};
        for (int i = 0; i < cycle->count; i++) {
            trial.ends[i] = *cycle->ends[i];
            trial.cycle.ends[i] = NULL;
        }
        trial.plane = plane_at(
            model_of(graph, r), offset, graph->topology->vertices[cycle->ends[0]->vertex].place);
        if (find_corners(graph, &trial)) {
            best = length;
            *out = trial;
        }
    }
    return best > 0.0;
}

/* Whether one of the ends leads to an unseen face already. */
static bool is_taken(const crease_unseens *unseens, const crease_cycle *cycle)
{
    for (size_t u = 0; u < unseens->count; u++)
        for (int i = 0; i < unseens->items[u].cycle.count; i++)
            for (int k = 0; k < cycle->count; k++)
                if (unseens->items[u].ends[i].vertex == cycle->ends[k]->vertex)
                    return true;
    return false;
}

static crease_status look_at(void *user, const crease_cycle *cycle)
{
    struct finding *const run = user;
    crease_unseens *const all = run->out;
    crease_unseen found;
    if (is_taken(all, cycle) || run->looked_at++ >= MOST_CYCLES || !find_plane(run, cycle, &found))
        return CREASE_OK;
    if (all->count == run->room) {
        const size_t room = 2 * run->room + 4;
        crease_unseen *const items =
            crease_reallocate(run->graph->context, all->items, room, sizeof *items);
        if (!items)
            return CREASE_ERROR_NO_MEMORY;
        all->items = items;
        run->room = room;
    }
    all->items[all->count++] = found;
    return CREASE_OK;
}

crease_status crease_unseens_find(crease_graph *graph, crease_unseens *out)
{
    crease_rests *rests = NULL;
    *out = (crease_unseens){.count = 0};
    crease_status status = crease_rests_create(graph, &rests);
    struct finding run = {.graph = graph, .rests = rests, .out = out};
    if (status == CREASE_OK)
        status = crease_cycles_visit(graph, look_at, &run);
    crease_rests_free(rests);
    return status;
}

void crease_unseens_clear(crease_unseens *unseens)
{
    free(unseens->items);
    *unseens = (crease_unseens){.count = 0};
}

/* ---------------------------------------------------------------------------------- edges -- */

/* The edge of the end's regions that goes on past the corner; NULL where none does. */
static crease_edge *passing(
    const crease_graph *graph, const crease_end *end, const double corner[3], int *which)
{
    const crease_topology *const t = graph->topology;
    for (size_t e = 0; e < t->edge_count; e++) {
        crease_edge *const edge = &t->edges[e];
        *which = edge->vertices[1] == end->vertex;
        if (edge->vertices[*which] == end->vertex &&
            memcmp(edge->regions, end->regions, sizeof end->regions) == 0 &&
            crease_edge_distance(edge, corner) < BESIDE * graph->survey->spacing)
            return edge;
    }
    return NULL;
}

/* Leads the edge of an end to the vertex at its corner. */
static crease_status lead(
    crease_graph *graph, const crease_end *end, int32_t vertex, crease_edge *out, bool *found)
{
    int which = 0;
    crease_edge *const edge = passing(graph, end, graph->topology->vertices[vertex].place, &which);
    if (edge && crease_graph_ends(graph, end->vertex, -1) == 1)
        return crease_edge_retract(graph, edge, which, vertex);
    return crease_bridge_lay(graph, end->regions, (int32_t[]){end->vertex, vertex}, out, found);
}

crease_status crease_unseen_border(
    crease_graph *graph, const crease_unseen *unseen, uint32_t region)
{
    const int count = unseen->cycle.count;
    int32_t vertices[CREASE_MOST_SIDES];
    crease_edge edges[2 * CREASE_MOST_SIDES] = {{.count = 0}};
    bool all = true;
    crease_status status = CREASE_OK;
    for (int i = 0; i < count && status == CREASE_OK; i++)
        status = crease_graph_vertex(graph, unseen->corners[i], &vertices[i]);
    for (int i = 0; i < count && status == CREASE_OK && all; i++)
        status = crease_bridge_lay(graph, (uint32_t[]){unseen->cycle.regions[i], region},
            (int32_t[]){vertices[(i + count - 1) % count], vertices[i]}, &edges[i], &all);
    for (int i = 0; i < count && status == CREASE_OK && all; i++)
        status = lead(graph, &unseen->ends[i], vertices[i], &edges[count + i], &all);
    for (int i = 0; i < 2 * count; i++) {
        if (all && status == CREASE_OK && edges[i].count > 0)
            status = crease_graph_take(graph, &edges[i]);
        crease_edge_clear(&edges[i]);
    }
    return status;
}
