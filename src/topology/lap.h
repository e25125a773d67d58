/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Rims that are seen in part only, as that of a bore is whose one side is in shadow. */
#ifndef CREASE_TOPOLOGY_LAP_H
#define CREASE_TOPOLOGY_LAP_H

#include "topology/graph.h"

/* Lets every edge whose two ends lack an edge of the same two regions go on along their common
 * curve, from its end round to its beginning, where the curve leads there. */
crease_status crease_laps_close(crease_graph *graph);

#endif
