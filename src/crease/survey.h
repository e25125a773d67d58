/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What every step of the search for creases looks at. */
#ifndef CREASE_CREASE_SURVEY_H
#define CREASE_CREASE_SURVEY_H

#include "segment/region.h"
#include "space/kdtree.h"

typedef struct crease_survey {
    const crease_regions *regions;
    const crease_tree *tree; /* of the regions' points: its indices are their positions */
    double spacing, sigma;
    double least_bend; /* radians: what bends less is no crease */
} crease_survey;

#endif
