/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Regions of faces that no point shows. Plain C without atomics, so that C++ can include it. */
#ifndef CREASE_TOPOLOGY_COMPLETE_H
#define CREASE_TOPOLOGY_COMPLETE_H

#include "topology/topology.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Finds the regions again as the given ones were found, and adds a plane without points for every
 * face that their topology says is there but not seen. *out: NULL when there is none. */
CREASE_API crease_status crease_regions_find_complete(crease_context *context,
    const crease_cloud *cloud, const crease_regions *regions, const crease_topology *topology,
    crease_regions **out);
/* How many of the regions, the last ones, are such planes. */
CREASE_API size_t crease_regions_unseen(const crease_regions *regions);

#ifdef __cplusplus
}
#endif

#endif
