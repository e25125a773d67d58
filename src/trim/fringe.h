/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The border of places scattered in a rectangle, where they do not fill it: smooth arcs along the
 * outermost places and around holes, and the rectangle's own sides where the places reach them. */
#ifndef CREASE_TRIM_FRINGE_H
#define CREASE_TRIM_FRINGE_H

#include "trim/overlay.h"

typedef struct crease_scatter {
    size_t count;
    const double *places; /* count x 2 */
    double low[2], high[2];
    crease_cuts cuts;
    double spacing;
} crease_scatter;

typedef enum crease_fringe_state {
    CREASE_FRINGE_FOUND,
    CREASE_FRINGE_FULL, /* the places fill the rectangle: its sides are the border */
    CREASE_FRINGE_LOST  /* what was found is no border of these places: try a larger radius */
} crease_fringe_state;

/* radius: of the disc that is rolled along the border; holes and bays that it does not fit into are
 * none. out: empty unless found. Errors: NO_MEMORY, CANCELLED. */
crease_status crease_fringe_find(crease_context *context, const crease_scatter *scatter,
    double radius, crease_frontier *out, crease_fringe_state *state);
/* The four sides of the rectangle. */
crease_status crease_fringe_of_rectangle(
    crease_context *context, const crease_scatter *scatter, crease_frontier *out);

#endif
