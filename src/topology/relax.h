/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Smooth edges where surfaces nearly lie on each other: a line of contact is then badly determined
 * across, while moving it a little costs next to nothing. */
#ifndef CREASE_TOPOLOGY_RELAX_H
#define CREASE_TOPOLOGY_RELAX_H

#include "topology/graph.h"

/* Takes the zigzag out of a line of even steps; the ends stay. */
void crease_edge_smooth(crease_edge *edge, int rounds);
/* Moves the points between the ends to midway between the edge's surfaces. False where these part.
 */
bool crease_edge_lay_midway(const crease_graph *graph, crease_edge *edge);
/* Lets smooth edges that zigzag, or that do not lead to their vertices, run evenly from vertex to
 * vertex. They are loose then. */
crease_status crease_seams_relax(crease_graph *graph);

#endif
