/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Example clouds with a known truth. Internal view: the truth itself. */
#ifndef CREASE_CLOUD_SHAPE_H
#define CREASE_CLOUD_SHAPE_H

#include "crease/crease.h"

/* Two half-planes that meet in a straight edge. */
typedef struct crease_roof {
    double edge[3];      /* a point of the edge */
    double direction[3]; /* unit vector along the edge */
    double inward[2][3]; /* unit vectors across the edge, one into each face */
    double along[2];     /* extent of the points along the direction, from `edge` */
    double across[2];    /* extent of the points on each face, measured from the edge */
} crease_roof;

/* The planes on which crease_shape_sample() puts its points before the noise. */
crease_roof crease_shape_sample_truth(const crease_sample_options *options);

/* The point of the panel of crease_shape_panel() at a distance across and along its crease, without
 * noise: across -0.4..0.4, the crease being at 0; along -0.3..0.3. */
void crease_shape_panel_point(double across, double along, double point[3]);

/* Whether a place lies inside the bracket of crease_shape_bracket(). */
bool crease_shape_bracket_holds(const double place[3]);

#endif
