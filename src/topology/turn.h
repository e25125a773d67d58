/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Faces that run all the way round need a seam: where their parameter jumps from a whole turn back
 * to 0. */
#ifndef CREASE_TOPOLOGY_TURN_H
#define CREASE_TOPOLOGY_TURN_H

#include "topology/graph.h"

/* Chooses the place of each seam, puts vertices there on the rims of the face and turns its chart.
 * Neighbours about one axis share the vertices on their common rim. seams: two vertices for each
 * region, CREASE_NO_VERTEX where there are none. */
crease_status crease_turns_cut(crease_graph *graph, int32_t *seams);

#endif
