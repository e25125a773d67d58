/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The first parameters of the points of a patch: a rectangle whose sides follow the borders of the
 * points as far as these hardly come in, and whose lines u = constant follow the courses. */
#ifndef CREASE_FIT_CHART_H
#define CREASE_FIT_CHART_H

#include "fit/course.h"

/* uv: count x 2; layout: its domain and lines along the first direction are set. Parameters are
 * nearly lengths. */
void crease_chart_points(
    const crease_spread *spread, const crease_courses *courses, double *uv, crease_layout *layout);

#endif
