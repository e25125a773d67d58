/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/landing.h"

#include "base/memory.h"
#include "base/vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* In spacings. */
static const double REACH = 9.0;      /* from the end of a rim to its vertex */
static const double LOOK_BACK = 2.0;  /* for the direction of an end */
static const double MOST_MOVE = 6.0;  /* of a vertex along its edge */
static const double STEP = 0.5;       /* between new points of an edge */
static const double SHORT_OF = 0.3;   /* of a vertex, where the points before it end */
static const double LAST_PART = 10.0; /* of a line, that may lie beyond its vertex */

/* Sine of the angle between rim and edge below which they do not cut each other. */
static const double LEAST_SINE = 0.3;

/* ---------------------------------------------------------------------------------- lists -- */

crease_status crease_rims_take(crease_context *context, crease_rims *rims, crease_rim *rim)
{
    if (rims->count == rims->room) {
        const size_t room = 2 * rims->room + 16;
        crease_rim *const items = crease_reallocate(context, rims->items, room, sizeof *items);
        if (!items) {
            crease_contour_clear(&rim->contour);
            return CREASE_ERROR_NO_MEMORY;
        }
        rims->items = items;
        rims->room = room;
    }
    rim->vertices[0] = rim->vertices[1] = CREASE_NO_VERTEX;
    rims->items[rims->count++] = *rim;
    return CREASE_OK;
}

void crease_rims_clear(crease_rims *rims)
{
    for (size_t i = 0; i < rims->count; i++)
        crease_contour_clear(&rims->items[i].contour);
    free(rims->items);
    *rims = (crease_rims){.count = 0};
}

/* ----------------------------------------------------------------------------------- ends -- */

/* The last points of a line at one of its ends. */
struct end {
    const double *tip;
    ptrdiff_t back; /* from a point to the one before it */
    size_t count;
};

static struct end end_of(const double *points, size_t count, int which)
{
    return (struct end){points + (which ? 3 * (count - 1) : 0), which ? -3 : 3, count};
}

static struct end end_of_rim(const crease_rim *rim, int which)
{
    const crease_stretch *const stretch = &rim->contour.items[which ? rim->contour.count - 1 : 0];
    return end_of(stretch->points, stretch->count, which);
}

/* The direction in which a line ends. */
static void heading(struct end end, double spacing, double out[3])
{
    const double *from = end.tip;
    for (size_t i = 1; i < end.count; i++) {
        from += end.back;
        if (crease_vector_distance(from, end.tip) >= LOOK_BACK * spacing)
            break;
    }
    for (int c = 0; c < 3; c++)
        out[c] = end.tip[c] - from[c];
    crease_vector_normalise(out);
}

/* --------------------------------------------------------------------------------- choosing -- */

static bool is_taken(const crease_rims *rims, uint32_t region, int32_t vertex)
{
    for (size_t i = 0; i < rims->count; i++)
        for (int w = 0; w < 2; w++)
            if (rims->items[i].region == region && rims->items[i].vertices[w] == vertex)
                return true;
    return false;
}

/* The nearest pair of an end of a rim and a vertex at which its region lacks an edge. */
struct pair {
    double away;
    size_t rim;
    int which;
    int32_t vertex;
};

static struct pair nearest_pair(const crease_graph *graph, const crease_rims *rims)
{
    const crease_topology *const t = graph->topology;
    struct pair best = {.away = REACH * graph->survey->spacing, .vertex = CREASE_NO_VERTEX};
    for (size_t i = 0; i < rims->count; i++)
        for (int w = 0; w < 2; w++) {
            const crease_rim *const rim = &rims->items[i];
            if (rim->contour.closed || rim->vertices[w] != CREASE_NO_VERTEX)
                continue;
            const double *const tip = end_of_rim(rim, w).tip;
            for (size_t v = 0; v < t->vertex_count; v++) {
                const double away = crease_vector_distance(t->vertices[v].place, tip);
                if (away < best.away && crease_graph_odd(graph, (int32_t)v, rim->region) &&
                    !is_taken(rims, rim->region, (int32_t)v))
                    best = (struct pair){away, i, w, (int32_t)v};
            }
        }
    return best;
}

static void choose_vertices(const crease_graph *graph, crease_rims *rims)
{
    for (;;) {
        const struct pair pair = nearest_pair(graph, rims);
        if (pair.vertex == CREASE_NO_VERTEX)
            return;
        rims->items[pair.rim].vertices[pair.which] = pair.vertex;
    }
}

/* ---------------------------------------------------------------------------------- moving -- */

/* How far ahead of the edge's end a rim meets it. */
static bool meeting(struct end edge, struct end rim, double spacing, double *ahead)
{
    double d[3], a[3], b[3];
    heading(edge, spacing, a);
    heading(rim, spacing, b);
    for (int c = 0; c < 3; c++)
        d[c] = rim.tip[c] - edge.tip[c];
    const double ab = crease_vector_dot(a, b), sine = 1.0 - ab * ab;
    *ahead = sine < LEAST_SINE * LEAST_SINE
        ? crease_vector_dot(d, a)
        : (crease_vector_dot(d, a) - ab * crease_vector_dot(d, b)) / sine;
    return fabs(*ahead) <= MOST_MOVE * spacing;
}

/* Lets a line end at a place: drops the points that are not before it. */
static size_t cut_before(double *points, size_t count, const double place[3], double spacing)
{
    double length = 0.0, towards[3];
    heading(end_of(points, count, 1), spacing, towards);
    while (count > 2) {
        const double *const last = points + 3 * (count - 1);
        const double d[3] = {place[0] - last[0], place[1] - last[1], place[2] - last[2]};
        if (crease_vector_dot(d, towards) > SHORT_OF * spacing || length > LAST_PART * spacing)
            break;
        length += crease_vector_distance(last, last - 3);
        count--;
    }
    const double *const last = points + 3 * (count - 1);
    return count > 1 && crease_vector_distance(last, place) < SHORT_OF * spacing ? count - 1
                                                                                 : count;
}

/* Points of an edge from its end to a place ahead of it, and the place. */
static crease_status go_on_to(
    crease_graph *graph, const crease_ground *ground, crease_edge *edge, const double place[3])
{
    const double s = graph->survey->spacing;
    edge->count = cut_before(edge->points, edge->count, place, s);
    const double from[3] = {edge->points[3 * edge->count - 3], edge->points[3 * edge->count - 2],
        edge->points[3 * edge->count - 1]};
    const size_t steps = (size_t)(crease_vector_distance(from, place) / (STEP * s));
    crease_status status = CREASE_OK;
    for (size_t i = 1; i < steps && status == CREASE_OK; i++) {
        double at[3];
        for (int c = 0; c < 3; c++)
            at[c] = from[c] + (double)i / (double)steps * (place[c] - from[c]);
        if (ground->cross(ground->user, edge, at))
            status = crease_edge_append(graph->context, edge, at);
    }
    return status == CREASE_OK ? crease_edge_append(graph->context, edge, place) : status;
}

/* Moves a vertex along the one edge that ends there to where the rims that come to it do. */
static crease_status move_vertex(crease_graph *graph, const crease_ground *ground,
    const crease_rims *rims, int32_t vertex, crease_edge *edge)
{
    const double s = graph->survey->spacing;
    const int which = edge->vertices[1] == vertex;
    const struct end end = end_of(edge->points, edge->count, which);
    double sum = 0.0, place[3], ahead[3];
    size_t count = 0;
    for (size_t i = 0; i < rims->count; i++)
        for (int w = 0; w < 2; w++) {
            double by;
            if (rims->items[i].vertices[w] != vertex ||
                !meeting(end, end_of_rim(&rims->items[i], w), s, &by))
                continue;
            sum += by;
            count++;
        }
    if (count == 0)
        return CREASE_OK;
    heading(end, s, ahead);
    for (int c = 0; c < 3; c++)
        place[c] = end.tip[c] + sum / (double)count * ahead[c];
    if (!ground->cross(ground->user, edge, place))
        return CREASE_OK;
    if (!which)
        crease_edge_reverse(edge);
    const crease_status status = go_on_to(graph, ground, edge, place);
    if (!which)
        crease_edge_reverse(edge);
    memcpy(graph->topology->vertices[vertex].place, place, sizeof place);
    return status;
}

static crease_status move_vertices(
    crease_graph *graph, const crease_ground *ground, const crease_rims *rims)
{
    crease_topology *const t = graph->topology;
    crease_status status = CREASE_OK;
    for (size_t e = 0; e < t->edge_count; e++)
        for (int w = 0; w < 2 && status == CREASE_OK; w++)
            if (!t->edges[e].closed && t->edges[e].vertices[w] != CREASE_NO_VERTEX &&
                crease_graph_ends(graph, t->edges[e].vertices[w], -1) == 1)
                status = move_vertex(graph, ground, rims, t->edges[e].vertices[w], &t->edges[e]);
    return status;
}

/* ---------------------------------------------------------------------------------- adding -- */

static void reverse_points(double *points, size_t count)
{
    for (size_t i = 0, k = count; i + 1 < k; i++) {
        double kept[3];
        k--;
        memcpy(kept, points + 3 * i, sizeof kept);
        memcpy(points + 3 * i, points + 3 * k, sizeof kept);
        memcpy(points + 3 * k, kept, sizeof kept);
    }
}

/* Lets the last point of a stretch (the first, if `which` is 0) be a vertex. */
static void end_at(crease_stretch *stretch, int which, const double place[3], double spacing)
{
    if (!which)
        reverse_points(stretch->points, stretch->count);
    size_t count = cut_before(stretch->points, stretch->count, place, spacing);
    if (count == stretch->room)
        count--;
    memcpy(stretch->points + 3 * count, place, 3 * sizeof *place);
    stretch->count = count + 1;
    if (!which)
        reverse_points(stretch->points, stretch->count);
}

static crease_status add_stretch(
    crease_graph *graph, const crease_rim *rim, size_t i, const int32_t vertices[2])
{
    const crease_stretch *const stretch = &rim->contour.items[i];
    crease_edge edge = crease_edge_between(rim->region, CREASE_NO_OTHER);
    crease_status status = CREASE_OK;
    edge.closed = rim->contour.closed && rim->contour.count == 1;
    for (size_t k = 0; k < stretch->count && status == CREASE_OK; k++)
        status = crease_edge_append(graph->context, &edge, stretch->points + 3 * k);
    if (edge.closed && status == CREASE_OK)
        memcpy(edge.points + 3 * (edge.count - 1), edge.points, 3 * sizeof *edge.points);
    for (int w = 0; w < 2 && vertices; w++)
        edge.vertices[w] = vertices[w];
    if (status == CREASE_OK)
        return crease_graph_take(graph, &edge);
    crease_edge_clear(&edge);
    return status;
}

/* The stretches of a rim, with vertices at the corners between them. */
static crease_status add_rim(crease_graph *graph, crease_rim *rim)
{
    crease_contour *const contour = &rim->contour;
    const double s = graph->survey->spacing;
    int32_t vertices[2], first = CREASE_NO_VERTEX;
    crease_status status = CREASE_OK;
    for (int w = 0; w < 2 && !contour->closed; w++)
        if (rim->vertices[w] != CREASE_NO_VERTEX)
            end_at(&contour->items[w ? contour->count - 1 : 0], w,
                graph->topology->vertices[rim->vertices[w]].place, s);
    if (contour->closed && contour->count == 1)
        return add_stretch(graph, rim, 0, NULL);
    vertices[0] = rim->vertices[0];
    if (contour->closed)
        status = crease_graph_vertex(graph, contour->items[0].points, &vertices[0]);
    first = vertices[0];
    for (size_t i = 0; i < contour->count && status == CREASE_OK; i++) {
        const crease_stretch *const stretch = &contour->items[i];
        if (i + 1 < contour->count)
            status = crease_graph_vertex(
                graph, stretch->points + 3 * (stretch->count - 1), &vertices[1]);
        else
            vertices[1] = contour->closed ? first : rim->vertices[1];
        if (status == CREASE_OK)
            status = add_stretch(graph, rim, i, vertices);
        vertices[0] = vertices[1];
    }
    return status;
}

crease_status crease_rims_land(crease_graph *graph, const crease_ground *ground, crease_rims *rims)
{
    choose_vertices(graph, rims);
    crease_status status = move_vertices(graph, ground, rims);
    for (size_t i = 0; i < rims->count && status == CREASE_OK; i++)
        status = add_rim(graph, &rims->items[i]);
    return status;
}
