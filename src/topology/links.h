/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Links between neighbouring points of different regions: they tell which regions meet, and where.
 * A link that no edge of its two regions accounts for is loose; many of them show that the regions
 * join smoothly there. */
#ifndef CREASE_TOPOLOGY_LINKS_H
#define CREASE_TOPOLOGY_LINKS_H

#include "topology/graph.h"

typedef struct crease_link {
    uint32_t regions[2]; /* ascending */
    double place[3];     /* middle of the two points */
} crease_link;

/* Sorted by regions, so that those of one pair are together. */
typedef struct crease_links {
    size_t count;
    crease_link *items;
} crease_links;

crease_status crease_links_find(
    crease_context *context, const crease_survey *survey, crease_links *out);
void crease_links_clear(crease_links *links);
/* The end of the run of links of one pair that begins at number `begin`. */
size_t crease_links_run(const crease_links *links, size_t begin);
/* The links of two regions, ascending: numbers run[0] up to, not including, run[1]. False when
 * there are none. */
bool crease_links_between(const crease_links *links, const uint32_t regions[2], size_t run[2]);

/* The loose links of two regions. */
typedef struct crease_loose {
    uint32_t regions[2];
    size_t count;
    double *places;
    crease_tree *tree; /* of the places; NULL when there are none */
} crease_loose;

/* Those of the run from begin to end. */
crease_status crease_loose_find(const crease_graph *graph, const crease_links *links, size_t begin,
    size_t end, crease_loose *out);
void crease_loose_clear(crease_loose *loose);
/* The main direction of those within a distance of a place, their number and mean. */
size_t crease_loose_direction(const crease_loose *loose, const double place[3], double distance,
    double mean[3], double direction[3]);
/* The nearest link to a place and its distance. False when none is within a distance. */
bool crease_loose_nearest(
    const crease_loose *loose, const double place[3], double within, double *away, double out[3]);

#endif
