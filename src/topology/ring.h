/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A smooth border all the way round, where the surfaces do not tell where it is: two halves of a
 * body without any edge are nearly one surface far beyond it. The links between their points tell.
 */
#ifndef CREASE_TOPOLOGY_RING_H
#define CREASE_TOPOLOGY_RING_H

#include "topology/links.h"

/* Where the edges of the graph from number `since` on pass by less than about half of the loose
 * links, seeks two ways past the links from one side to the other and back, and takes these instead
 * if they pass by more. */
crease_status crease_ring_mend(crease_graph *graph, const crease_loose *loose, size_t since);

#endif
