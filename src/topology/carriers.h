/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The surfaces that carry the faces of a part. Regions that lie on one and the same surface as far
 * as the noise can tell, such as two lands of one plane, or a bore that a slot interrupts, share a
 * carrier: nearly coincident surfaces have no intersection to speak of.
 *
 * Internal, but plain enough for C++: src/cad builds on it. */
#ifndef CREASE_TOPOLOGY_CARRIERS_H
#define CREASE_TOPOLOGY_CARRIERS_H

#include "crease/crease.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct crease_carriers crease_carriers;

typedef struct crease_carrier {
    crease_region_type type;
    /* Of its frame: on the axis for cylinder and cone, the middle of sphere and torus; a free form
     * is a height along z over x and y, or, when round, a distance from z over the angle about it
     * and the place along it. The axes are orthonormal, row by row. */
    double centre[3], axes[9];
    double radius;   /* sphere, cylinder, cone at the centre, circle of a torus */
    double shape;    /* cone: growth of the radius along z; torus: radius of the tube */
    bool round;      /* free form: about its z axis, ... */
    bool ball;       /* ... or its centre: x and y are a stereographic projection */
    int spans;       /* free form: pieces of the height along either direction */
    uint32_t region; /* the largest of its regions */
} crease_carrier;

/* Errors: NO_MEMORY. */
CREASE_API crease_status crease_carriers_find(
    crease_context *context, const crease_regions *regions, crease_carriers **out);
CREASE_API void crease_carriers_free(crease_carriers *carriers);
CREASE_API size_t crease_carriers_count(const crease_carriers *carriers);
CREASE_API crease_carrier crease_carriers_at(const crease_carriers *carriers, size_t index);
/* Number of the carrier of each region. */
CREASE_API const uint32_t *crease_carriers_of_regions(const crease_carriers *carriers);
/* For each point of the cloud the area that it stands for, from the distance of its neighbours. */
CREASE_API const double *crease_carriers_areas(const crease_carriers *carriers);
/* As crease_regions_distance(). */
CREASE_API double crease_carriers_distance(
    const crease_carriers *carriers, size_t index, const double place[3], double gradient[3]);
/* Of a free form: the height over a place of its frame's plane, inside and outside its points; of a
 * round one the distance from its axis at an angle and a height, of a ball that from its centre. */
CREASE_API double crease_carriers_height(
    const crease_carriers *carriers, size_t index, double x, double y);

#ifdef __cplusplus
}
#endif

#endif
