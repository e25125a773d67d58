/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The choice of crease lines and of the number of knots. */
#ifndef CREASE_FIT_EXPLORE_H
#define CREASE_FIT_EXPLORE_H

#include "fit/draft.h"
#include "fit/scan.h"

/* Control points of the largest net that is tried. */
enum { CREASE_EXPLORED_UNKNOWNS = 4096 };

/* What the caller allows. */
typedef struct crease_bounds {
    size_t net[2];    /* control points, or 0: as many as the data ask for */
    size_t creases;   /* most lines in each direction */
    size_t least[2];  /* simple knots, when the net is free */
    double tolerance; /* refine until the rms distance is below; 0: until it does not pay */
} crease_bounds;

/* Fits the draft, adds those candidates as crease lines and as many simple knots as lower the
 * score. The draft must be placed. turn: the frame may be turned about z. */
crease_status crease_explore(crease_context *context, crease_draft *draft,
    const crease_bounds *bounds, const crease_candidate *candidates, size_t count, bool turn);
/* Removes the lines without which the score is lower, or that simple knots replace as well.
 * Compares vertical distances: the draft must not be orthogonal. */
crease_status crease_explore_prune(
    crease_context *context, crease_draft *draft, const crease_bounds *bounds);
/* Sets the simple knots so that the net has the size asked for. False: it cannot hold the lines. */
bool crease_explore_keep_net(crease_layout *layout, const crease_bounds *bounds);

#endif
