/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What the links between points of neighbouring regions show: whether the regions go on into each
 * other without an angle. */
#ifndef CREASE_SEGMENT_BORDER_H
#define CREASE_SEGMENT_BORDER_H

#include "segment/segmentation.h"

enum { CREASE_BORDER_LEAST_LINKS = 3 }; /* that show anything */

typedef struct crease_border_contact {
    uint32_t links, sharp; /* all, and those that show an angle */
    double agreement;      /* sum of the cosines between the gradients of the models */
    double parallel;       /* and of their absolute values */
} crease_border_contact;

typedef struct crease_border {
    crease_border_contact beside; /* nearest neighbours */
    crease_border_contact across; /* farther ones, over a gap in the points, counted where there are
                                     hardly any of these */
    bool tried;                   /* for the user */
} crease_border;

typedef struct crease_borders {
    const crease_segmentation *seg;
    size_t count;         /* regions, some may be empty */
    crease_border *items; /* count x count, of which those with the lower region first are used */
} crease_borders;

crease_status crease_borders_make(const crease_segmentation *seg, crease_borders *out);
void crease_borders_clear(crease_borders *borders);
crease_border *crease_borders_between(const crease_borders *borders, size_t a, size_t b);
/* Counts the links of one region anew, or, when it is CREASE_NO_LABEL, of all. */
void crease_borders_count(const crease_borders *borders, int32_t region);
/* The links that tell: those beside each other, or, where these are too few, those across. */
const crease_border_contact *crease_border_told_by(const crease_border *border);

#endif
