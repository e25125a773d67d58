/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* An edge along the border between the points of two regions. Where surfaces join smoothly they may
 * say nothing of where one ends and the other begins, as when a free form is found as two: then the
 * labels of the points do. */
#ifndef CREASE_TOPOLOGY_TRAIL_H
#define CREASE_TOPOLOGY_TRAIL_H

#include "topology/links.h"

/* Makes an edge of two regions from vertex to vertex past the loose links between them: on their
 * common curve where they cut each other, else midway between them. *found: whether there is such a
 * way, and the surfaces are close to each other all along it; the edge is cleared otherwise. */
crease_status crease_trail_lay(const crease_graph *graph, const crease_loose *loose,
    const int32_t vertices[2], crease_edge *out, bool *found);

#endif
