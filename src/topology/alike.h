/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Regions of one face, as the sides of a bore between which the scan has a shadow. */
#ifndef CREASE_TOPOLOGY_ALIKE_H
#define CREASE_TOPOLOGY_ALIKE_H

#include "crease/survey.h"

/* Gives the points of round regions to larger ones on the same surface, where nothing lies between
 * them. labels: of all points; may change. */
crease_status crease_alikes_join(
    crease_context *context, const crease_survey *survey, int32_t *labels);

#endif
