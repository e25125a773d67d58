/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Rims: edges along the border of the data, which have one face only. */
#ifndef CREASE_TOPOLOGY_RIM_H
#define CREASE_TOPOLOGY_RIM_H

#include "topology/graph.h"

/* What the rims lie on: where the points of a region and its surface are. */
typedef struct crease_ground {
    void *user;
    /* The points of a region on its surface, and the normals there; the caller frees both. */
    crease_status (*points)(
        void *user, uint32_t region, size_t *count, double **points, double **normals);
    /* Moves places onto the surface of a region. */
    crease_status (*settle)(void *user, uint32_t region, double *places, size_t count);
    /* Moves a place onto the common curve of an edge's two surfaces; false when that is far away.
     */
    bool (*cross)(void *user, const crease_edge *edge, double place[3]);
} crease_ground;

/* The models of the graph's regions. user: the graph. */
crease_ground crease_ground_of_models(crease_graph *graph);

/* Adds the rims: along the outermost points of each region where no other edge of it runs. Edges
 * that come to the border are cut or go on to where the rims of their regions meet them. */
crease_status crease_rims_add(crease_graph *graph, const crease_ground *ground);

#endif
