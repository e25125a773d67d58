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

#endif
