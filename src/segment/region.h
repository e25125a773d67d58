/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The smooth regions of a cloud. Internal view, for the stage that finds the creases between them.
 *
 * Points are kept in Morton order ("position"), so that neighbours are near in memory and the
 * result does not depend on the order of the file; `order` leads back to the index in the cloud.
 * Everything below is by position, except what is said to be by index. */
#ifndef CREASE_SEGMENT_REGION_H
#define CREASE_SEGMENT_REGION_H

#include "noise/noise.h"
#include "primitive/model.h"
#include "segment/snaps.h"
#include "space/neighbours.h"

enum { CREASE_NO_REGION = -1 };

struct crease_regions {
    size_t count;                  /* points */
    double *points;                /* count x 3 */
    uint32_t *order;               /* index in the cloud */
    crease_neighbours *neighbours; /* CREASE_NOISE_NEIGHBOURS of each point (fewer in tiny clouds),
                                      the point itself first; as positions */
    crease_noise *noise;           /* spacing, normals, scores; its sigma is the first estimate */
    double noise_sigma;            /* noise by the residuals inside regions, at least 0.03 s */
    double sigma;                  /* what residuals are weighed by: more than the noise where
                                      neighbouring points err alike */
    int32_t *labels;               /* number of the region, or CREASE_NO_REGION */
    uint8_t *rounded; /* points on edges that the scanner has rounded, see noise/blur.h;
                         NULL where it has not */
    size_t region_count;
    size_t unseen_count;      /* of these, the last ones: planes that no point shows */
    crease_model *models;     /* region_count */
    size_t *sizes;            /* points of each region */
    double *rms;              /* of the distances of a region's points from its model */
    int32_t *labels_by_index; /* what the public accessors return */
    double *normals_by_index;
    bool snapped;
    crease_snaps snaps;
    crease_regions_options options; /* they were found with */
};

/* Finds the neighbours, k of each, and the noise of points in Morton order. */
typedef crease_status crease_surroundings_find(crease_context *context, void *user,
    const double *points, size_t count, int k, crease_neighbours **neighbours,
    crease_noise **noise);

/* crease_regions_find() with another way to find these. */
crease_status crease_regions_find_by(crease_context *context, const crease_cloud *cloud,
    const crease_regions_options *options, crease_surroundings_find *surroundings, void *user,
    crease_regions **out);

/* The regions with those united that join without an angle, as crease_regions_options says. */
crease_status crease_regions_unite(
    crease_context *context, const crease_regions *from, crease_regions **out);

#endif
