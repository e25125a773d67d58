/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/meeting.h"

#include "base/vector.h"
#include "crease/intersect.h"

#include <math.h>

/* In spacings. */
static const double TOGETHER = 3.0; /* links of three pairs around a corner */
static const double KNOWN = 3.0;    /* from a corner that the three regions have already */
static const double GAP = 10.0;     /* between vertices around a hole in the points, at most, ... */
static const double MOVE = 4.0;     /* from their middle to the corner, ... */
static const double APART = 1.0;    /* and from there to each surface */

static const double CLOSE = 0.3; /* surfaces that cut or touch each other */

enum { ROUNDS = 20 };

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

double crease_meeting_find(const crease_graph *graph, const crease_links *links,
    const uint32_t regions[3], double place[3])
{
    size_t runs[3][2];
    const double together = TOGETHER * graph->survey->spacing;
    double least = together;
    for (int i = 0; i < 3; i++) {
        const uint32_t a = regions[i], b = regions[(i + 1) % 3];
        if (!crease_links_between(links, (uint32_t[]){a < b ? a : b, a < b ? b : a}, runs[i]))
            return INFINITY;
    }
    for (size_t i = runs[0][0]; i < runs[0][1]; i++) {
        const double *const at = links->items[i].place, *second = NULL, *third = NULL;
        const double away =
            fmax(nearest(links, runs[1], at, &second), nearest(links, runs[2], at, &third));
        if (away >= least || is_known(graph, regions, at))
            continue;
        least = away;
        for (int c = 0; c < 3; c++)
            place[c] = (at[c] + second[c] + third[c]) / 3.0;
    }
    return least < together ? least : INFINITY;
}

bool crease_meeting_in_hole(const crease_graph *graph, const int32_t vertices[3],
    const uint32_t regions[3], double place[3])
{
    const crease_vertex *const v = graph->topology->vertices;
    const double s = graph->survey->spacing;
    double middle[3], gradient[3], most = 0.0;
    for (int i = 0; i < 3; i++)
        if (crease_vector_distance(v[vertices[i]].place, v[vertices[(i + 1) % 3]].place) > GAP * s)
            return false;
    for (int c = 0; c < 3; c++) {
        middle[c] = 0.0;
        for (int i = 0; i < 3; i++)
            middle[c] += v[vertices[i]].place[c] / 3.0;
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

double crease_meeting_in_shadow(const crease_graph *graph, int32_t vertex,
    const uint32_t regions[3], double reach, double place[3])
{
    const double *const from = graph->topology->vertices[vertex].place;
    const crease_model *models[3];
    for (int i = 0; i < 3; i++) {
        models[i] = &graph->survey->regions->models[regions[i]];
        place[i] = from[i];
    }
    if (!crease_intersection_meet(models, 3, reach, CLOSE * graph->survey->spacing, place) ||
        is_known(graph, regions, place))
        return INFINITY;
    return crease_vector_distance(from, place);
}
