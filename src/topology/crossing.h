/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Where the lines cross along which pairs of regions join smoothly. */
#ifndef CREASE_TOPOLOGY_CROSSING_H
#define CREASE_TOPOLOGY_CROSSING_H

#include "topology/links.h"

/* Moves a place to where the lines of the pairs cross. The surfaces tell it to a part of a spacing,
 * where they were fitted well enough; else the links do, and where these lead far away it stays. */
void crease_crossing_find(
    const crease_graph *graph, const crease_loose *const pairs[], size_t count, double place[3]);

#endif
