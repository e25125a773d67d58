/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Vertices at which a face ends in a cusp: two of its edges come to it at so small an angle that
 * they cross well before. All three surfaces meet where they cross: the vertex is there. */
#ifndef CREASE_TOPOLOGY_CUSP_H
#define CREASE_TOPOLOGY_CUSP_H

#include "topology/graph.h"

/* Moves such vertices, and the ends of their edges. */
crease_status crease_cusps_move(crease_graph *graph);

#endif
