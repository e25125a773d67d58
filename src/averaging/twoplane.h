/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Two planes through a set of points, and the edge in which they meet. */
#ifndef CREASE_AVERAGING_TWOPLANE_H
#define CREASE_AVERAGING_TWOPLANE_H

#include <stdbool.h>
#include <stddef.h>

typedef struct crease_twoplane {
    double normal[2][3];
    double centre[2][3]; /* mean of each plane's points */
    double direction[3]; /* unit vector along the edge */
    double edge[3];      /* point of the edge nearest to the mean of all points */
    double inward[2][3]; /* unit vectors across the edge, one into each face */
} crease_twoplane;

/* Fits two planes, robustly. False when one plane does as well, when the planes are nearly parallel
 * (below 5 degrees), or when the points of both lie on the same side of the edge. scratch: 4 x
 * count. Best for up to some thousand points: O(count) for each of about a hundred rounds. */
bool crease_twoplane_fit(const double *points, size_t count, double *scratch, crease_twoplane *out);

#endif
