/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Edges that no surfaces or no points show: between vertices at which edges of the same two regions
 * are missing. */
#ifndef CREASE_TOPOLOGY_BRIDGE_H
#define CREASE_TOPOLOGY_BRIDGE_H

#include "topology/links.h"

/* Adds them, shortest first: along the common curve of the two surfaces, or, where these are nearly
 * one, straight, as in the shadow of a scan; then along the border between their points. Where the
 * two regions have an edge already, no second one runs. */
crease_status crease_bridges_build(crease_graph *graph, const crease_links *links);
/* Makes such an edge between two vertices, on the common curve of two regions, ascending, or where
 * they are nearly one. *found: whether there is one; the edge is cleared otherwise. */
crease_status crease_bridge_lay(crease_graph *graph, const uint32_t regions[2],
    const int32_t vertices[2], crease_edge *out, bool *found);

#endif
