/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/complete.h"

#include "base/memory.h"
#include "segment/region.h"

#include <stdlib.h>
#include <string.h>

/* Room for some regions more, which have no points. */
static crease_status make_room(crease_context *context, crease_regions *regions, size_t more)
{
    const size_t count = regions->region_count + more;
    crease_model *const models = crease_reallocate(context, regions->models, count, sizeof *models);
    regions->models = models ? models : regions->models;
    size_t *const sizes = crease_reallocate(context, regions->sizes, count, sizeof *sizes);
    regions->sizes = sizes ? sizes : regions->sizes;
    double *const rms = crease_reallocate(context, regions->rms, count, sizeof *rms);
    regions->rms = rms ? rms : regions->rms;
    return models && sizes && rms ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
}

static crease_status add_planes(
    crease_context *context, crease_regions *regions, const crease_topology *topology)
{
    crease_status status = make_room(context, regions, topology->unseen_count);
    for (size_t i = 0; i < topology->unseen_count && status == CREASE_OK; i++) {
        const size_t number = regions->region_count++;
        regions->models[number] = topology->unseen[i];
        regions->sizes[number] = 0;
        regions->rms[number] = 0.0;
        regions->unseen_count++;
    }
    return status;
}

crease_status crease_regions_find_complete(crease_context *context, const crease_cloud *cloud,
    const crease_regions *regions, const crease_topology *topology, crease_regions **out)
{
    *out = NULL;
    if (topology->unseen_count == 0 || regions->unseen_count > 0)
        return CREASE_OK;
    crease_status status = crease_regions_find(context, cloud, &regions->options, out);
    if (status == CREASE_OK && regions->snapped)
        status = crease_regions_snap(context, *out);
    if (status == CREASE_OK)
        status = add_planes(context, *out, topology);
    if (status != CREASE_OK) {
        crease_regions_free(*out);
        *out = NULL;
    }
    return status;
}

size_t crease_regions_unseen(const crease_regions *regions)
{
    return regions->unseen_count;
}
