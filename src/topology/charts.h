/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The charts of all regions: as their models say, turned to where the face suits them best. */
#ifndef CREASE_TOPOLOGY_CHARTS_H
#define CREASE_TOPOLOGY_CHARTS_H

#include "topology/graph.h"

/* Makes the charts: u = 0 on the side where the face has no points, poles of spheres outside the
 * face, or in its middle where it is more than a cap. */
crease_status crease_charts_make(crease_graph *graph);
/* Samples the heights of free forms over all points of region and edges. */
crease_status crease_charts_cover(crease_graph *graph);

#endif
