/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The courses that creases take through a patch laid out in the plane: each is a function of the
 * coordinate along, and runs from end to end of the patch. */
#ifndef CREASE_FIT_COURSE_H
#define CREASE_FIT_COURSE_H

#include "base/context.h"
#include "net/layout.h"

typedef struct crease_course {
    size_t count;
    double *along, *across; /* count each, `along` ascending */
} crease_course;

typedef struct crease_courses {
    size_t count;
    crease_course items[CREASE_MOST_LINES]; /* by `across`, ascending */
} crease_courses;

/* A patch of points with what is known of them. */
typedef struct crease_spread {
    size_t count;
    const double *points;  /* count x 3 */
    const int32_t *labels; /* of the regions */
    const double *keep;    /* 0: to leave out */
    double *plane;         /* count x 2: across and along */
    uint8_t *strip;        /* between which courses a point lies: 0 before the first */
    double spacing, sigma;
} crease_spread;

/* Finds the courses of the creases, which must run side by side, turns the plane so that they go
 * along its second axis, and says in which strip each point lies: that of its region near a crease.
 * *count is 0 when there are none, or when they cross, meet or turn back. Errors: NO_MEMORY,
 * CANCELLED. */
crease_status crease_courses_find(crease_context *context, crease_spread *spread,
    const crease_network *network, crease_courses *out);
void crease_courses_clear(crease_courses *courses);
/* Where a course passes, also beyond its ends. */
double crease_course_across(const crease_course *course, double along);

#endif
