/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Points beside creases, and the spacing of those that are not. */
#ifndef CREASE_CREASE_FEATURE_H
#define CREASE_CREASE_FEATURE_H

#include "crease/survey.h"

/* Points that may lie beside creases. */
typedef struct crease_bystanders {
    const double *points;    /* count x 3 */
    const crease_tree *tree; /* of them */
    double spacing;
} crease_bystanders;

/* Marks (sets to 1) the points within a distance of any of the curves. near: for each point. */
crease_status crease_features_mark(crease_context *context, const crease_bystanders *bystanders,
    const crease_curve *const *curves, size_t count, double distance, uint8_t *near);

/* The mean spacing of the points, from those that are neither near an edge nor near a border, each
 * with the neighbours of its own region: what the density along the normal adds near edges and on
 * thin walls is left out. The spacing of the survey when there are too few. Threaded.
 * Errors: NO_MEMORY, CANCELLED. */
crease_status crease_features_spacing(
    crease_context *context, const crease_survey *survey, const uint8_t *near, double *spacing);

#endif
