/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What can be shifted as one while directions and radii stay: a plane along its normal, an axis
 * with all that is coaxial across itself, a sphere. */
#ifndef CREASE_SNAP_PLACE_H
#define CREASE_SNAP_PLACE_H

#include "snap/snapping.h"

enum { CREASE_PLACE_COORDINATES = 3 };

typedef struct crease_place {
    size_t body;       /* the first of those that it moves */
    int32_t direction; /* cluster of the normal or axis; CREASE_NO_CLUSTER: a sphere */
    bool is_plane;
    int count; /* of coordinates: 1, 2, 3 */
    double along[CREASE_PLACE_COORDINATES][3];
    double at[CREASE_PLACE_COORDINATES];
    double covariance[CREASE_PLACE_COORDINATES][CREASE_PLACE_COORDINATES];
} crease_place;

/* The places of all bodies that have one; room for as many as there are bodies. Not before the
 * radii. */
size_t crease_places_find(const crease_snapping *all, crease_place *out);
/* Shifts the bodies of a place to new coordinates; what else is free of them follows. */
void crease_place_move(crease_snapping *all, const crease_place *place, const double to[]);
/* The row that takes its coordinates to where it is along a direction, times a factor. */
void crease_place_project(const crease_place *place, const double onto[3], double by, double out[]);
bool crease_place_has(const crease_snapping *all, const crease_place *place, size_t body);

#endif
