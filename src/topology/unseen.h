/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Plane faces that no point shows, as the wall of a pocket that is in shadow: a cycle of vertices
 * at which edges are missing goes around them. Where they run is what their neighbours say: they
 * stand as another surface does, and two neighbours or more whose points end along one line each
 * end at them. */
#ifndef CREASE_TOPOLOGY_UNSEEN_H
#define CREASE_TOPOLOGY_UNSEEN_H

#include "topology/cycle.h"

typedef struct crease_unseen {
    crease_model plane;
    crease_cycle cycle; /* of its neighbours; without the ends, which are these: */
    crease_end ends[CREASE_MOST_SIDES];
    double corners[CREASE_MOST_SIDES][3]; /* number i with regions i and i + 1 */
} crease_unseen;

typedef struct crease_unseens {
    size_t count;
    crease_unseen *items;
} crease_unseens;

crease_status crease_unseens_find(crease_graph *graph, crease_unseens *out);
void crease_unseens_clear(crease_unseens *unseens);
/* Adds the edges around a face whose plane is the model of a region. */
crease_status crease_unseen_border(
    crease_graph *graph, const crease_unseen *unseen, uint32_t region);

#endif
