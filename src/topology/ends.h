/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Ends of edges and the vertices that they lead to. */
#ifndef CREASE_TOPOLOGY_ENDS_H
#define CREASE_TOPOLOGY_ENDS_H

#include "topology/graph.h"

/* Gives ends without a vertex the nearest one, or one of their own. */
crease_status crease_ends_join(crease_graph *graph);
/* Cuts edges back to where their vertices are ahead, and makes these their first and last points.
 */
crease_status crease_ends_meet(crease_graph *graph);
/* Removes short edges that lead to nowhere beside a longer one of the same two regions. */
void crease_ends_prune(crease_graph *graph);
/* Joins the edges of the same two regions at vertices where nothing else ends: there a crease was
 * lost from sight for a while. All around, they become closed edges without a vertex. */
crease_status crease_ends_dissolve(crease_graph *graph);
/* Moves the ends of edges onto their two surfaces, vertices to where two edges of a face cross
 * before, and finds the spread of the vertices. */
crease_status crease_ends_finish(crease_graph *graph);

#endif
