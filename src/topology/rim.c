/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/rim.h"

#include "base/memory.h"
#include "base/vector.h"
#include "space/density.h"
#include "space/outline.h"
#include "topology/landing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LEAST_POINTS = 12 };

static const double DISC = 2.5;          /* spacings: radius of the disc that is rolled */
static const double SPARSE_DISC = 2.0;   /* the same where points are sparse, in spacings there */
static const double SPARSE_SHARE = 0.95; /* of the points that are denser than that */
static const double BESIDE = 0.9;        /* discs from an edge: its side, not the border */
static const double LEAST_RUN = 2.0;     /* discs: a shorter way off an edge is none */
static const double LEAST_LOOP = 8.0;    /* spacings around a hole or an island */

struct task {
    crease_graph *graph;
    const crease_ground *ground;
    uint32_t region;
    size_t count;
    double *points, *normals;
    double disc;
    crease_rims *rims;
};

/* The radius of the disc follows the sparse points. */
static crease_status choose_disc(struct task *task)
{
    double sparse = 0.0;
    const crease_status status = crease_density_spacings(
        task->graph->context, task->points, task->count, &SPARSE_SHARE, 1, &sparse);
    task->disc = fmax(DISC * task->graph->survey->spacing, SPARSE_DISC * sparse);
    return status;
}

/* ----------------------------------------------------------------------------------- runs -- */

static double edge_distance(const struct task *task, const double place[3])
{
    const crease_topology *const t = task->graph->topology;
    double least = INFINITY;
    for (size_t e = 0; e < t->edge_count; e++)
        if (crease_edge_has(&t->edges[e], task->region))
            least = fmin(least, crease_edge_distance(&t->edges[e], place));
    return least;
}

static double length_of(const double *points, size_t count, bool closed)
{
    double length = closed ? crease_vector_distance(points, points + 3 * (count - 1)) : 0.0;
    for (size_t i = 1; i < count; i++)
        length += crease_vector_distance(points + 3 * i, points + 3 * (i - 1));
    return length;
}

static crease_status add_run(
    struct task *task, const double *points, const double *normals, size_t count, bool closed)
{
    const crease_rag rag = {.count = count,
        .points = points,
        .normals = normals,
        .closed = closed,
        .spacing = task->graph->survey->spacing};
    crease_rim rim = {.region = task->region};
    crease_status status = crease_contour_fit(task->graph->context, &rag, &rim.contour);
    for (size_t i = 0; i < rim.contour.count && status == CREASE_OK; i++)
        status = task->ground->settle(task->ground->user, task->region, rim.contour.items[i].points,
            rim.contour.items[i].count);
    return status == CREASE_OK ? crease_rims_take(task->graph->context, task->rims, &rim) : status;
}

/* The runs of a loop's points that are beside no edge. points: of the loop, its first one being
 * beside an edge. */
static crease_status add_runs(struct task *task, const double *points, const double *normals,
    const bool *beside, size_t count)
{
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < count && status == CREASE_OK;) {
        size_t end = i;
        while (end < count && !beside[end])
            end++;
        if (end > i + 2 && length_of(points + 3 * i, end - i, false) >= LEAST_RUN * task->disc)
            status = add_run(task, points + 3 * i, normals + 3 * i, end - i, false);
        i = end + 1;
    }
    return status;
}

static crease_status add_loop(struct task *task, const uint32_t *loop, size_t count)
{
    crease_context *const context = task->graph->context;
    double *const points = crease_allocate(context, count, 6 * sizeof *points);
    bool *const beside = crease_allocate(context, count, sizeof *beside);
    size_t first = 0;
    crease_status status = points && beside ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK) {
        double *const normals = points + 3 * count;
        while (first < count &&
            edge_distance(task, task->points + 3 * (size_t)loop[first]) >= BESIDE * task->disc)
            first++;
        for (size_t i = 0; i < count; i++) {
            const size_t from = loop[(i + first) % count];
            memcpy(points + 3 * i, task->points + 3 * from, 3 * sizeof *points);
            memcpy(normals + 3 * i, task->normals + 3 * from, 3 * sizeof *points);
            beside[i] = edge_distance(task, points + 3 * i) < BESIDE * task->disc;
        }
        if (first < count)
            status = add_runs(task, points, normals, beside, count);
        else if (length_of(points, count, true) >= LEAST_LOOP * task->graph->survey->spacing)
            status = add_run(task, points, normals, count, true);
    }
    free(points);
    free(beside);
    return status;
}

static crease_status add_region(struct task *task)
{
    crease_outline outline = {.loop_count = 0};
    crease_status status = task->ground->points(
        task->ground->user, task->region, &task->count, &task->points, &task->normals);
    const bool enough = task->count >= LEAST_POINTS;
    if (status == CREASE_OK && enough)
        status = choose_disc(task);
    if (status == CREASE_OK && enough)
        status = crease_outline_find(task->graph->context, task->points, task->normals, task->count,
            NULL, task->disc, &outline);
    for (size_t i = 0; i < outline.loop_count && status == CREASE_OK; i++)
        status = add_loop(
            task, outline.points + outline.first[i], outline.first[i + 1] - outline.first[i]);
    crease_outline_clear(&outline);
    free(task->points);
    free(task->normals);
    return status;
}

crease_status crease_rims_add(crease_graph *graph, const crease_ground *ground)
{
    crease_rims rims = {.count = 0};
    crease_status status = CREASE_OK;
    for (size_t r = 0; r < graph->topology->region_count && status == CREASE_OK; r++) {
        struct task task = {.graph = graph, .ground = ground, .region = (uint32_t)r, .rims = &rims};
        status = add_region(&task);
    }
    if (status == CREASE_OK)
        status = crease_rims_land(graph, ground, &rims);
    crease_rims_clear(&rims);
    return status;
}
