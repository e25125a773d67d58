/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Step 3 of Algorithm 1: the rotation M that makes the points a height field z(x, y) with the edge
 * along y. */
#ifndef CREASE_AVERAGING_ORIENT_H
#define CREASE_AVERAGING_ORIENT_H

#include "base/context.h"
#include "base/frame.h"

typedef struct crease_oriented {
    crease_frame frame;
    bool edge;           /* two planes were found that meet in an edge */
    double point[3];     /* of that edge, in the cloud's coordinates */
    double direction[3]; /* unit vector along it */
} crease_oriented;

/* A frame for the points, found from the points alone. Its origin is the centre of their box.
 *
 * An edge is looked for as the line in which two planes meet that the points follow: the direction
 * of that line is y, and z halves the angle between the two faces, pointing away from them. Where
 * there is no such edge, or where it does not make the points a height field, the main axes are
 * taken (z: the direction of the smallest spread), and where these do not either, the axes as they
 * are. Of two opposite directions z is the one nearer to the cloud's own +z, and x the one nearer
 * to its +x (next choices: +y, then +x or +z); y is z cross x. Deterministic.
 * Errors: TOO_FEW_POINTS, DEGENERATE (all points on one line), NO_MEMORY, CANCELLED. */
crease_status crease_orient_find(
    crease_context *context, const double *points, size_t count, crease_oriented *out);

/* The same, or with the axes as they are, or with the given rotation; the edge is found in any
 * case. Errors: ARGUMENT also (the rotation is none). */
crease_status crease_orient(crease_context *context, const double *points, size_t count,
    crease_orientation orientation, const double rotation[9], crease_oriented *out);

/* The local axis that the edge follows, 0 or 1, seen along z; 1 where there is none. */
int crease_orient_edge_axis(const crease_oriented *oriented);

#endif
