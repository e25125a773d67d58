/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "snap/coarser.h"

#include "segment/region.h"

crease_status crease_regions_find_coarser(crease_context *context, const crease_cloud *cloud,
    const crease_regions *regions, crease_regions **out)
{
    crease_regions_options options = regions->options;
    *out = NULL;
    if (options.united)
        return CREASE_OK;
    options.united = true;
    crease_status status = crease_regions_find(context, cloud, &options, out);
    if (status == CREASE_OK && regions->snapped)
        status = crease_regions_snap(context, *out);
    if (status != CREASE_OK) {
        crease_regions_free(*out);
        *out = NULL;
    }
    return status;
}
