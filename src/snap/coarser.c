/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "snap/coarser.h"

#include "segment/region.h"

crease_status crease_regions_find_coarser(
    crease_context *context, const crease_regions *regions, crease_regions **out)
{
    *out = NULL;
    if (regions->options.united)
        return CREASE_OK;
    crease_status status = crease_regions_unite(context, regions, out);
    if (status == CREASE_OK && regions->snapped)
        status = crease_regions_snap(context, *out);
    if (status != CREASE_OK) {
        crease_regions_free(*out);
        *out = NULL;
    }
    return status;
}
