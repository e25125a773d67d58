/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The steps from regions to faces. */
#ifndef CREASE_TOPOLOGY_ASSEMBLY_H
#define CREASE_TOPOLOGY_ASSEMBLY_H

#include "topology/topology.h"

#ifdef __cplusplus
extern "C" {
#endif

/* bordered: the points end at a border, so that faces may have rims; otherwise they are of a closed
 * body, of which a scan may have missed something. Errors: NO_MEMORY, CANCELLED. */
CREASE_API crease_status crease_topology_find(
    crease_context *context, const crease_regions *regions, bool bordered, crease_topology **out);

#ifdef __cplusplus
}
#endif

#endif
