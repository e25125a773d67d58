/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The ground of rims that lie on the models of regions. */
#include "base/memory.h"
#include "topology/rim.h"

#include <stdlib.h>
#include <string.h>

enum { STEPS = 4 };

static const double REACH = 3.0; /* spacings */

/* Normals are gradients, which are continuous where the surface is. */
static void settle(const crease_graph *graph, uint32_t region, double place[3], double normal[3])
{
    for (int step = 0; step < STEPS; step++) {
        const double away = crease_graph_distance(graph, region, place, normal);
        for (int c = 0; c < 3; c++)
            place[c] -= away * normal[c];
    }
}

static crease_status points_of(
    void *user, uint32_t region, size_t *count, double **points, double **normals)
{
    const crease_graph *const graph = user;
    const crease_regions *const r = graph->survey->regions;
    *count = 0;
    *points = crease_allocate(graph->context, r->sizes[region], 3 * sizeof **points);
    *normals = crease_allocate(graph->context, r->sizes[region], 3 * sizeof **normals);
    if (!*points || !*normals)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < r->count && *count < r->sizes[region]; i++) {
        if (r->labels[i] != (int32_t)region)
            continue;
        double *const place = *points + 3 * *count;
        memcpy(place, r->points + 3 * i, 3 * sizeof *place);
        settle(graph, region, place, *normals + 3 * *count);
        (*count)++;
    }
    return CREASE_OK;
}

static crease_status settle_all(void *user, uint32_t region, double *places, size_t count)
{
    double normal[3];
    for (size_t i = 0; i < count; i++)
        settle(user, region, places + 3 * i, normal);
    return CREASE_OK;
}

static bool cross(void *user, const crease_edge *edge, double place[3])
{
    const crease_graph *const graph = user;
    return crease_graph_project(graph, edge->regions, REACH * graph->survey->spacing, place);
}

crease_ground crease_ground_of_models(crease_graph *graph)
{
    return (crease_ground){graph, points_of, settle_all, cross};
}
