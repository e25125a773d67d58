/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/topology.h"

#include "base/memory.h"
#include "segment/region.h"

#include <stdlib.h>

void crease_edge_clear(crease_edge *edge)
{
    free(edge->points);
    edge->points = NULL;
    edge->count = edge->room = 0;
}

void crease_loop_clear(crease_loop *loop)
{
    free(loop->halves);
    free(loop->uv);
    *loop = (crease_loop){.count = 0};
}

void crease_topology_clear_edges(crease_topology *topology)
{
    for (size_t i = 0; i < topology->edge_count; i++)
        crease_edge_clear(&topology->edges[i]);
    topology->edge_count = 0;
}

crease_topology *crease_topology_create(crease_context *context, const crease_regions *regions)
{
    crease_topology *const out = crease_allocate(context, 1, sizeof *out);
    if (!out)
        return NULL;
    out->spacing = regions->noise->spacing;
    out->region_count = regions->region_count;
    out->open = crease_allocate(context, regions->region_count, sizeof *out->open);
    if (out->open)
        return out;
    free(out);
    return NULL;
}

static void clear_face(crease_face *face)
{
    for (size_t i = 0; i < face->loop_count; i++)
        crease_loop_clear(&face->loops[i]);
    free(face->loops);
}

void crease_topology_free(crease_topology *topology)
{
    if (!topology)
        return;
    crease_topology_clear_edges(topology);
    for (size_t i = 0; i < topology->face_count; i++)
        clear_face(&topology->faces[i]);
    for (size_t i = 0; topology->charts && i < topology->region_count; i++)
        free(topology->charts[i].heights);
    free(topology->charts);
    free(topology->open);
    free(topology->vertices);
    free(topology->edges);
    free(topology->faces);
    free(topology->unseen);
    free(topology);
}
