/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Regions for points that they were not found from: those of a cloud of which the regions are known
 * by a sample. */
#ifndef CREASE_SEGMENT_ASSIGN_H
#define CREASE_SEGMENT_ASSIGN_H

#include "segment/region.h"
#include "space/kdtree.h"

/* The regions with what is needed to ask them. */
typedef struct crease_assignment {
    const crease_regions *regions;
    crease_tree *tree; /* of their points */
    double sigma;      /* what distances from the surfaces are weighed by: see sigma_of() */
    double *farthest;  /* by region: distance from its surface beyond which a point is an outlier */
    int links;
} crease_assignment;

/* spacing: of the points that will be asked about. */
crease_status crease_assignment_create(
    crease_context *context, const crease_regions *regions, double spacing, crease_assignment *out);
void crease_assignment_free(crease_assignment *assignment);
/* The region of each point with own[i] != 0, or CREASE_NO_REGION, and its distance from the
 * region's surface: the one that is cheapest among those of the nearest points of the sample, by
 * the distance and by how many of these it has. Threaded. */
crease_status crease_assign(crease_context *context, const crease_assignment *assignment,
    const double *points, const uint8_t *own, size_t count, int32_t *labels, double *distances);

/* Frees what only the search for creases needs; the normals of the points are not to be had
 * afterwards. */
void crease_regions_slim(crease_regions *regions);

#endif
