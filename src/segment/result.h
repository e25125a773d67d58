/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What a segmentation leaves in the regions. */
#ifndef CREASE_SEGMENT_RESULT_H
#define CREASE_SEGMENT_RESULT_H

#include "segment/region.h"
#include "segment/segmentation.h"

/* Takes the models over, numbered from large regions to small; points far from their region's
 * surface lose their label. Errors: NO_MEMORY. */
crease_status crease_regions_take(
    crease_context *context, crease_regions *regions, crease_segmentation *seg);

#endif
