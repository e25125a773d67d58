/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Corners that no points show: creases that end in a hole of the data go on to where they meet. */
#ifndef CREASE_TOPOLOGY_EXTEND_H
#define CREASE_TOPOLOGY_EXTEND_H

#include "topology/graph.h"

/* Brings open ends of two edges with a region in common to the corner of their three surfaces when
 * it lies ahead of both, shortest extension first; other ends of the same surfaces join them. */
crease_status crease_ends_extend(crease_graph *graph);

#endif
