/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Landings: where rims come to other edges. */
#ifndef CREASE_TOPOLOGY_LANDING_H
#define CREASE_TOPOLOGY_LANDING_H

#include "topology/rim.h"
#include "trim/contour.h"

/* A stretch of the border of one region. */
typedef struct crease_rim {
    uint32_t region;
    crease_contour contour;
    int32_t vertices[2]; /* at which an open one begins and ends */
} crease_rim;

typedef struct crease_rims {
    size_t count, room;
    crease_rim *items;
} crease_rims;

/* Moves a rim to the end of the list; it is cleared when there is no room. */
crease_status crease_rims_take(crease_context *context, crease_rims *rims, crease_rim *rim);
/* Joins the ends of open rims to the vertices at which their regions lack an edge, which move to
 * where the rims meet the edge there, and adds all rims to the graph. */
crease_status crease_rims_land(crease_graph *graph, const crease_ground *ground, crease_rims *rims);
void crease_rims_clear(crease_rims *rims);

#endif
