/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Edges that go on past the vertex where another face takes over: the last piece is the border of
 * that one, or is there already. */
#ifndef CREASE_TOPOLOGY_OVERSHOOT_H
#define CREASE_TOPOLOGY_OVERSHOOT_H

#include "topology/graph.h"

/* Lets an edge that passes by a vertex end there. */
crease_status crease_edge_retract(
    const crease_graph *graph, crease_edge *edge, int end, int32_t vertex);
/* Lets those edges end at the vertex that they pass by which leave fewer edges missing then, or as
 * many where else an edge would be asked for that runs along them. */
crease_status crease_overshoots_retract(crease_graph *graph);

#endif
