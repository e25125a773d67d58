/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/seam.h"

#include "base/memory.h"
#include "base/vector.h"
#include "crease/intersect.h"
#include "topology/contact.h"
#include "topology/ring.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    LEAST_LINKS = 12,
    LEAST_LINKS_AROUND = 3, /* at a vertex that a seam begins at */
    LEAST_RING_LINKS = 30,
    RING_STARTS = 16,
    LONELY_STEPS = 12,
    SNAP_FROM = 8,  /* steps that a seam has at least */
    SNAP_PAST = 12, /* steps beyond the last links */
    SNAP_SHORT = 16
};

/* In spacings. */
static const double STEP = 0.5;
static const double LONGEST_STEP = 1.2; /* of a step */
static const double PLACE_REACH = 2.5;
static const double CROSS_REACH = 2.0;
static const double LONELY = 4.0;
static const double GOOD = 2.5;
static const double HIT = 1.5;
static const double SNAP = 5.0;
static const double SNAP_ONE_SIDED = 1.5;
static const double AROUND = 6.0;
static const double RING_LEAST = 4.0;
static const double MOVE_AROUND = 12.0;
static const double MOVE_REACH = 8.0;

static const double CROSSING = 0.45;   /* radians: surfaces that cut each other rather than touch */
static const double LEAST_CROSS = 0.2; /* cosine between a seam and the normal of what ends it */

struct seam {
    crease_graph *graph;
    const crease_loose *loose;
    const crease_model *models[2];
    const crease_confluences *confluences; /* NULL: none */
};

/* -------------------------------------------------------------------------------- places -- */

static bool crosses(const crease_model *const models[2], const double place[3])
{
    double first[3], second[3];
    crease_model_distance(models[0], place, first);
    crease_model_distance(models[1], place, second);
    return fabs(crease_vector_dot(first, second)) < cos(CROSSING);
}

/* Moves a place onto the seam; false, and the place stays, where it is not near. */
static bool place_on(const crease_model *const models[2], const double along[3], double s,
    bool crossing, double place[3])
{
    double to[3] = {place[0], place[1], place[2]}, tangent[3];
    if (crossing || crosses(models, place)) {
        if (crease_intersection_project(models, CROSS_REACH * s, to, tangent)) {
            memcpy(place, to, sizeof to);
            return true;
        }
        memcpy(to, place, sizeof to);
    }
    if (!crease_contact_place(models, along, s, to) ||
        crease_vector_distance(to, place) > PLACE_REACH * s)
        return false;
    memcpy(place, to, sizeof to);
    return true;
}

/* -------------------------------------------------------------------------------- marches -- */

enum { LOST = -1, HOME = -2 };

/* A walk along a seam, by steps of about half a spacing. */
struct march {
    const struct seam *seam;
    double place[3], along[3], home[3];
    int32_t from; /* vertex, or CREASE_NO_VERTEX for a ring */
    bool crossing;
    double length;
    int lonely;       /* steps since there were links */
    size_t good;      /* points up to the last that had links beside */
    crease_edge edge; /* what was passed */
};

static bool is_odd_for_both(const struct seam *seam, int32_t vertex)
{
    const crease_confluence *const confluence = crease_confluence_at(seam->confluences, vertex);
    if (confluence)
        return crease_confluence_awaits(seam->graph, confluence, seam->loose->regions);
    return crease_graph_odd(seam->graph, vertex, seam->loose->regions[0]) &&
        crease_graph_odd(seam->graph, vertex, seam->loose->regions[1]);
}

static bool is_odd_for_one(const struct seam *seam, int32_t vertex)
{
    if (crease_confluence_at(seam->confluences, vertex))
        return is_odd_for_both(seam, vertex);
    return crease_graph_odd(seam->graph, vertex, seam->loose->regions[0]) ||
        crease_graph_odd(seam->graph, vertex, seam->loose->regions[1]);
}

/* One step; false when it leads nowhere. */
static bool step_on(struct march *march)
{
    const double s = march->seam->graph->survey->spacing, step = STEP * s;
    double to[3], passed[3];
    for (int c = 0; c < 3; c++)
        to[c] = march->place[c] + step * march->along[c];
    place_on(march->seam->models, march->along, s, march->crossing, to);
    for (int c = 0; c < 3; c++)
        passed[c] = to[c] - march->place[c];
    const double length = crease_vector_length(passed);
    if (length < 1e-3 * s)
        return false;
    const double shorter = fmin(length, LONGEST_STEP * step);
    for (int c = 0; c < 3; c++) {
        march->along[c] += passed[c] / length;
        march->place[c] += shorter / length * passed[c];
    }
    crease_vector_normalise(march->along);
    march->length += shorter;
    return true;
}

/* Whether there still are links beside, or were until a moment ago. */
static bool has_company(struct march *march)
{
    const double s = march->seam->graph->survey->spacing;
    size_t beside = 0, near = 0;
    uint32_t found;
    crease_tree_within(march->seam->loose->tree, march->place, LONELY * s, 1, &found, &beside);
    crease_tree_within(march->seam->loose->tree, march->place, GOOD * s, 1, &found, &near);
    march->lonely = beside ? 0 : march->lonely + 1;
    march->good = near ? march->edge.count : march->good;
    return march->lonely <= LONELY_STEPS;
}

/* A vertex that the march has come to and does not come nearer to. */
static int32_t vertex_reached(const struct march *march)
{
    const crease_topology *const t = march->seam->graph->topology;
    const double s = t->spacing;
    double least = HIT * s, ahead[3];
    int32_t hit = CREASE_NO_VERTEX;
    for (size_t v = 0; v < t->vertex_count; v++) {
        const double away = crease_vector_distance(t->vertices[v].place, march->place);
        if (away < least && is_odd_for_both(march->seam, (int32_t)v) &&
            ((int32_t)v != march->from || march->length > AROUND * s)) {
            least = away;
            hit = (int32_t)v;
        }
    }
    if (hit == CREASE_NO_VERTEX)
        return hit;
    for (int c = 0; c < 3; c++)
        ahead[c] = t->vertices[hit].place[c] - march->place[c];
    return crease_vector_dot(ahead, march->along) < 0.6 * STEP * s ? hit : CREASE_NO_VERTEX;
}

static bool is_home(const struct march *march)
{
    const double s = march->seam->graph->survey->spacing;
    double ahead[3];
    for (int c = 0; c < 3; c++)
        ahead[c] = march->home[c] - march->place[c];
    return march->from == CREASE_NO_VERTEX && march->length > RING_LEAST * s &&
        crease_vector_length(ahead) < 1.6 * STEP * s &&
        crease_vector_dot(ahead, march->along) < 0.6 * STEP * s;
}

/* Where a march that has lost its way had passed close to a vertex, it ends there. */
static int32_t snap(struct march *march)
{
    const crease_topology *const t = march->seam->graph->topology;
    const double s = t->spacing;
    double least = SNAP * s;
    int32_t hit = LOST;
    size_t at = 0;
    if (march->from == CREASE_NO_VERTEX)
        return LOST;
    for (size_t v = 0; v < t->vertex_count; v++) {
        if ((int32_t)v == march->from || !is_odd_for_one(march->seam, (int32_t)v))
            continue;
        const double more = is_odd_for_both(march->seam, (int32_t)v) ? 0.0 : SNAP_ONE_SIDED * s;
        for (size_t i = SNAP_FROM; i < march->edge.count && i < march->good + SNAP_PAST; i++) {
            const double away =
                crease_vector_distance(march->edge.points + 3 * i, t->vertices[v].place) + more;
            if (away < least) {
                least = away;
                hit = (int32_t)v;
                at = i;
            }
        }
    }
    if (hit == LOST || at + SNAP_SHORT < march->good)
        return LOST;
    while (at > 2 &&
        crease_vector_distance(march->edge.points + 3 * (at - 1), t->vertices[hit].place) < s)
        at--;
    march->edge.count = at;
    return hit;
}

/* Goes on until it ends: at a vertex, whose number goes to *hit, at HOME, or LOST. */
static crease_status go(struct march *march, int32_t *hit)
{
    crease_context *const context = march->seam->graph->context;
    const size_t most = 8 * march->seam->loose->count + 100;
    crease_status status = crease_edge_append(context, &march->edge, march->place);
    *hit = LOST;
    for (size_t i = 0; i < most && status == CREASE_OK; i++) {
        if (!step_on(march) || !has_company(march)) {
            *hit = snap(march);
            return CREASE_OK;
        }
        *hit = vertex_reached(march);
        if (*hit == CREASE_NO_VERTEX)
            *hit = is_home(march) ? HOME : LOST;
        if (*hit != LOST)
            return CREASE_OK;
        status = crease_edge_append(context, &march->edge, march->place);
    }
    return status;
}

static struct march march_from(
    const struct seam *seam, const double place[3], const double along[3], int32_t vertex)
{
    struct march march = {.seam = seam, .from = vertex, .good = 1};
    march.edge = crease_edge_between(seam->loose->regions[0], seam->loose->regions[1]);
    march.edge.smooth = true;
    memcpy(march.place, place, sizeof march.place);
    memcpy(march.home, place, sizeof march.home);
    memcpy(march.along, along, sizeof march.along);
    return march;
}

/* --------------------------------------------------------------------------- open seams -- */

static crease_status seam_from(struct seam *seam, int32_t vertex)
{
    crease_graph *const graph = seam->graph;
    const double *const place = graph->topology->vertices[vertex].place;
    double mean[3], along[3];
    int32_t hit;
    if (crease_loose_direction(seam->loose, place, AROUND * graph->survey->spacing, mean, along) <
        LEAST_LINKS_AROUND)
        return CREASE_OK;
    for (int c = 0; c < 3; c++)
        along[c] = mean[c] - place[c];
    crease_vector_normalise(along);
    struct march march = march_from(seam, place, along, vertex);
    crease_status status = go(&march, &hit);
    if (status == CREASE_OK && hit >= 0 && hit != vertex) {
        march.edge.vertices[0] = vertex;
        march.edge.vertices[1] = hit;
        status =
            crease_edge_append(graph->context, &march.edge, graph->topology->vertices[hit].place);
        if (status == CREASE_OK)
            status = crease_graph_take(graph, &march.edge);
    }
    crease_edge_clear(&march.edge);
    return status;
}

/* -------------------------------------------------------------------------------- rings -- */

/* Starts beside one of the links, in the direction that the surfaces say or else the links. */
static crease_status ring_from(struct seam *seam, size_t link, bool by_links, bool *found)
{
    crease_graph *const graph = seam->graph;
    const double s = graph->survey->spacing;
    double start[3], along[3];
    int32_t hit;
    crease_loose_direction(seam->loose, seam->loose->places + 3 * link, AROUND * s, start, along);
    if (!by_links && !crease_contact_direction(seam->models, start, s, along))
        return CREASE_OK;
    if (!place_on(seam->models, along, s, by_links, start))
        return CREASE_OK;
    struct march march = march_from(seam, start, along, CREASE_NO_VERTEX);
    march.crossing = by_links;
    crease_status status = go(&march, &hit);
    *found = status == CREASE_OK && hit == HOME;
    if (*found) {
        march.edge.closed = true;
        status = crease_edge_append(graph->context, &march.edge, march.home);
        if (status == CREASE_OK)
            status = crease_graph_take(graph, &march.edge);
    }
    crease_edge_clear(&march.edge);
    return status;
}

static crease_status find_ring(struct seam *seam)
{
    crease_status status = CREASE_OK;
    bool found = false;
    for (size_t i = 0; i < RING_STARTS && !found && status == CREASE_OK; i++)
        status = ring_from(seam, i % 8 * seam->loose->count / 8, i >= RING_STARTS / 2, &found);
    return status;
}

/* ------------------------------------------------------------------------------- finding -- */

static crease_status seams_of(struct seam *seam)
{
    const crease_topology *const t = seam->graph->topology;
    crease_status status = CREASE_OK;
    bool any = false;
    for (size_t v = 0; v < t->vertex_count && status == CREASE_OK; v++) {
        if (!is_odd_for_both(seam, (int32_t)v))
            continue;
        any = true;
        status = seam_from(seam, (int32_t)v);
    }
    if (any || status != CREASE_OK || seam->loose->count <= LEAST_RING_LINKS)
        return status;
    const size_t before = t->edge_count;
    status = find_ring(seam);
    return status == CREASE_OK ? crease_ring_mend(seam->graph, seam->loose, before) : status;
}

crease_status crease_seams_find(
    crease_graph *graph, const crease_links *links, const crease_confluences *confluences)
{
    const crease_model *const models = graph->survey->regions->models;
    crease_status status = CREASE_OK;
    for (int round = 0; round < 2; round++)
        for (size_t begin = 0; begin < links->count && status == CREASE_OK;) {
            const size_t end = crease_links_run(links, begin);
            crease_loose loose = {.count = 0};
            if (end - begin >= LEAST_LINKS)
                status = crease_loose_find(graph, links, begin, end, &loose);
            struct seam seam = {
                graph, &loose, {&models[loose.regions[0]], &models[loose.regions[1]]}, confluences};
            if (status == CREASE_OK && loose.count >= LEAST_LINKS)
                status = seams_of(&seam);
            crease_loose_clear(&loose);
            begin = end;
        }
    return status;
}

/* ------------------------------------------------------------------------------ relocation -- */

/* The two regions that lack an edge at a vertex, and the one that does not. False when it is not
 * so. */
static bool lacks_seam(const crease_graph *graph, int32_t vertex, uint32_t out[3])
{
    const crease_topology *const t = graph->topology;
    uint32_t regions[3];
    size_t count = 0, odd = 0;
    for (size_t e = 0; e < t->edge_count; e++)
        for (int i = 0; i < 2; i++) {
            const uint32_t r = t->edges[e].regions[i];
            size_t k = 0;
            if (t->edges[e].vertices[0] != vertex && t->edges[e].vertices[1] != vertex)
                continue;
            while (k < count && regions[k] != r)
                k++;
            if (k == 3)
                return false;
            if (k == count)
                regions[count++] = r;
        }
    for (size_t k = 0; k < count; k++) {
        if (crease_graph_odd(graph, vertex, regions[k]))
            out[odd++ < 2 ? odd - 1 : 1] = regions[k];
        else
            out[2] = regions[k];
    }
    return count == 3 && odd == 2;
}

/* Moves a place to where the seam of two regions meets the third; false when it does not. */
static bool meet_third(
    const crease_graph *graph, const uint32_t regions[3], const double along[3], double place[3])
{
    const crease_model *const all = graph->survey->regions->models;
    const crease_model *const models[2] = {&all[regions[0]], &all[regions[1]]};
    const double s = graph->survey->spacing;
    for (int i = 0; i < 30; i++) {
        double gradient[3];
        if (!place_on(models, along, s, false, place))
            return false;
        const double distance = crease_graph_distance(graph, regions[2], place, gradient);
        const double slope = crease_vector_dot(gradient, along);
        if (fabs(slope) < LEAST_CROSS)
            return false;
        for (int c = 0; c < 3; c++)
            place[c] -= distance / slope * along[c];
        if (fabs(distance) < 1e-10 * s)
            return true;
    }
    return false;
}

static crease_status relocate(
    crease_graph *graph, const crease_links *links, size_t begin, size_t end)
{
    crease_topology *const t = graph->topology;
    const double s = graph->survey->spacing;
    crease_loose loose;
    const crease_status status = crease_loose_find(graph, links, begin, end, &loose);
    for (size_t v = 0; v < t->vertex_count && loose.count > 0; v++) {
        uint32_t regions[3];
        double place[3], along[3];
        if (!lacks_seam(graph, (int32_t)v, regions) ||
            !((regions[0] == loose.regions[0] && regions[1] == loose.regions[1]) ||
                (regions[0] == loose.regions[1] && regions[1] == loose.regions[0])))
            continue;
        if (crease_loose_direction(&loose, t->vertices[v].place, MOVE_AROUND * s, place, along) < 2)
            continue;
        if (meet_third(graph, regions, along, place) &&
            crease_vector_distance(place, t->vertices[v].place) < MOVE_REACH * s)
            memcpy(t->vertices[v].place, place, sizeof place);
    }
    crease_loose_clear(&loose);
    return status;
}

crease_status crease_seams_relocate(crease_graph *graph, const crease_links *links)
{
    crease_status status = CREASE_OK;
    for (size_t begin = 0; begin < links->count && status == CREASE_OK;) {
        const size_t end = crease_links_run(links, begin);
        if (end - begin >= LEAST_LINKS)
            status = relocate(graph, links, begin, end);
        begin = end;
    }
    return status;
}
