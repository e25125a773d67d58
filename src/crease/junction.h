/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Corners: where ends of chains come together. */
#ifndef CREASE_CREASE_JUNCTION_H
#define CREASE_CREASE_JUNCTION_H

#include "crease/chain.h"
#include "crease/survey.h"

enum { CREASE_MOST_CORNER_REGIONS = 12 };

typedef struct crease_junction {
    double place[3];
    uint32_t valence; /* ends of chains */
    size_t region_count;
    uint32_t regions[CREASE_MOST_CORNER_REGIONS];
} crease_junction;

typedef struct crease_junctions {
    size_t count;
    crease_junction *items;
} crease_junctions;

/* Brings the ends of open chains that lie together, and whose chains have a region in common, to
 * one corner, where the models of all regions around it meet, and cuts the chains there. An end
 * that stays alone but where a third region begins ends on that region's model. Sets the corners of
 * the chains that have such ends; their points do not include the corner.
 * Errors: NO_MEMORY, CANCELLED. */
crease_status crease_junctions_find(crease_context *context, const crease_survey *survey,
    crease_chains *chains, crease_junctions *out);
void crease_junctions_clear(crease_junctions *junctions);

#endif
