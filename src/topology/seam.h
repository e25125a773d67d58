/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Smooth edges: where regions join without an angle, as a fillet and its plane do. Parity tells
 * where they begin and end: at vertices where an edge is missing for both regions. */
#ifndef CREASE_TOPOLOGY_SEAM_H
#define CREASE_TOPOLOGY_SEAM_H

#include "topology/confluence.h"

/* Moves the vertices where a crease passes from one of two smoothly joined regions to the other:
 * onto the line where these touch. What three surfaces have in common there is badly determined
 * along the crease. */
crease_status crease_seams_relocate(crease_graph *graph, const crease_links *links);
/* Adds the smooth edges that the loose links show: from vertex to vertex along the line of contact,
 * or all the way round. Those of the confluences, NULL when there are none, are vertices as well.
 */
crease_status crease_seams_find(
    crease_graph *graph, const crease_links *links, const crease_confluences *confluences);

#endif
