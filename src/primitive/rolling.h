/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A ball that rolls along the edge of two planes and touches both: its radius alone says where it
 * is, so that the section plane | arc | plane has one unknown, and the cylinder that it leaves is
 * exactly tangent. */
#ifndef CREASE_PRIMITIVE_ROLLING_H
#define CREASE_PRIMITIVE_ROLLING_H

#include "primitive/model.h"

/* Two planes, seen from the side on which the ball rolls. */
typedef struct crease_wedge {
    double origin[3];     /* a place in both planes */
    double normals[2][3]; /* towards the ball, of length 1 */
    double along[3];      /* the edge, of length 1 */
    double cosine;        /* of the angle between the normals */
} crease_wedge;

/* A place in the section: how high above each plane. */
typedef struct crease_section {
    double height[2];
} crease_section;

typedef enum crease_rolling_part {
    CREASE_ROLLING_FIRST,
    CREASE_ROLLING_SECOND,
    CREASE_ROLLING_ARC
} crease_rolling_part;

/* The wedge of two planes with the given place between them; false when they are almost parallel.
 */
bool crease_wedge_make(
    const crease_model *const planes[2], const double between[3], crease_wedge *out);
crease_section crease_wedge_section(const crease_wedge *wedge, const double place[3]);
/* How far the place is from the edge. */
double crease_wedge_away(const crease_wedge *wedge, crease_section at);
/* How far from the edge a ball of radius 1 touches the planes. */
double crease_wedge_touch(const crease_wedge *wedge);

/* Distance of a place from the profile with a ball of this radius (0: the sharp edge), and the part
 * of it that is nearest. */
double crease_rolling_distance(
    const crease_wedge *wedge, double radius, crease_section at, crease_rolling_part *part);
/* Sum of the squared distances of places from the profile over sigma^2, each cut; first and second:
 * their heights above the planes. */
double crease_rolling_cost(const crease_wedge *wedge, double radius, const double *first,
    const double *second, size_t count, double sigma, double cut);
/* The cylinder that the ball leaves, its centre beside the given place. */
void crease_rolling_cylinder(
    const crease_wedge *wedge, double radius, const double beside[3], crease_model *out);

#endif
