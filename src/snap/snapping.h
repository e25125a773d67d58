/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The work in progress of snapping: bodies that are turned, moved and resized by the stages in
 * turn. What an earlier stage settled is not touched by a later one. */
#ifndef CREASE_SNAP_SNAPPING_H
#define CREASE_SNAP_SNAPPING_H

#include "segment/region.h"
#include "snap/body.h"

typedef struct crease_snapping {
    crease_context *context;
    crease_regions *regions;
    size_t count;
    crease_body *bodies;
    bool *takes_part, *has_axis, *moved;
    crease_clusters directions, axes, radii;
    double (*axis_of)[3];   /* of each cluster of directions */
    double (*across)[2][3]; /* two directions at right angles to it */
    int32_t (*upright)[2];  /* the clusters that it was made perpendicular to, or -1 */
    int32_t *image_of;      /* the cluster that a mirror takes it to, or -1 */
    size_t mirror_count;
    bool *mirrored; /* for every mirror plane the bodies that it takes to each other */
} crease_snapping;

/* Directions equal, at right angles or mirror images, the most certain of them first. */
crease_status crease_snap_directions(crease_snapping *all);
/* Directions that are mirror images across a third; part of the former. */
crease_status crease_snap_oblique(crease_snapping *all);
/* Squared turn of a cluster's direction, in its errors. */
double crease_snap_turn_squared(const crease_snapping *all, size_t cluster, const double axis[3]);
/* Image of a vector in a mirror; out is not v. */
void crease_mirror_vector(const double normal[3], const double v[3], double out[3]);
/* Axes of one direction that are one; not before the directions. */
crease_status crease_snap_axes(crease_snapping *all);
/* Radii; not before the axes. */
crease_status crease_snap_radii(crease_snapping *all);
/* Places about mirror planes; not before the radii. */
crease_status crease_snap_symmetry(crease_snapping *all);

#endif
