/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Fillets: rounded edges between two planes, as cylinders that are exactly tangent to both. */
#ifndef CREASE_SEGMENT_FILLET_H
#define CREASE_SEGMENT_FILLET_H

#include "segment/segmentation.h"

/* Replaces what lies between two planes by the fillet, or by the sharp edge, that explains the
 * points as well with fewer parameters. The last of the stages: models fitted again would not stay
 * tangent. */
crease_status crease_fillets_find(crease_segmentation *seg);

#endif
