/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Edges that parity still asks for when creases, seams and bridges are there: from vertices
 * that lack an edge of two regions each, and whose pairs of regions form a cycle, to the corners in
 * which these meet smoothly, of which no surface tells where they are. */
#ifndef CREASE_TOPOLOGY_MISSING_H
#define CREASE_TOPOLOGY_MISSING_H

#include "topology/links.h"

/* Adds those that the borders between the points show, see trail.h. */
crease_status crease_missing_find(crease_graph *graph, const crease_links *links);

#endif
