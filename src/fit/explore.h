/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The choice of crease lines and of the number of knots. */
#ifndef CREASE_FIT_EXPLORE_H
#define CREASE_FIT_EXPLORE_H

#include "fit/draft.h"
#include "fit/scan.h"

/* Control points of the largest net that is tried. */
enum { CREASE_EXPLORED_UNKNOWNS = 4096 };
/* A more complicated layout must lower the score by this much: odds of 20 to 1. */
enum { CREASE_EXPLORE_MARGIN = 6 };

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
/* Sets the simple knots so that the net has the size asked for. False: it cannot hold the lines. */
bool crease_explore_keep_net(crease_layout *layout, const crease_bounds *bounds);
/* Fits another layout and takes it when its score is lower by the margin at least. */
crease_status crease_explore_try(crease_context *context, crease_draft *draft,
    const crease_layout *layout, double margin, bool *taken);
/* Twice as many spans along x, along y, along both, then four times: the first that pays. */
crease_status crease_explore_grow(
    crease_context *context, crease_draft *draft, const crease_bounds *bounds, bool *grown);
/* Tries every line: to leave it out, or with `tries` above 1 to put simple knots in its place. */
crease_status crease_explore_drop_lines(
    crease_context *context, crease_draft *draft, const crease_bounds *bounds, size_t tries);

#endif
