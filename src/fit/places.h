/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What the points say about the places of the crease lines. */
#ifndef CREASE_FIT_PLACES_H
#define CREASE_FIT_PLACES_H

#include "fit/draft.h"

enum { CREASE_MOST_PLACES = 2 * CREASE_MOST_LINES + 1 };

/* The normal equations of steps of the lines across themselves, in the order of the layout,
 * direction 0 first, and of a turn of the frame about z (radians), control points eliminated. */
typedef struct crease_places {
    size_t count, lines;
    double reduced[CREASE_MOST_PLACES * CREASE_MOST_PLACES], right[CREASE_MOST_PLACES];
    bool free[CREASE_MOST_PLACES]; /* the points determine it */
    double *solved; /* count x control points: what the control points do for a step of one */
} crease_places;

/* Of a draft that is fitted. turn: with the turn of the frame. Free the places also on failure.
 * O(points). Errors: NO_MEMORY, CANCELLED. */
crease_status crease_places_sum(
    crease_context *context, crease_draft *draft, bool turn, crease_places *out);
void crease_places_free(crease_places *places);
/* How the distance of sample i along the normal changes with steps of one: count numbers. */
void crease_places_columns(const crease_draft *draft, size_t i, size_t count, double *out);
/* The matrix of those that are free, n x n; returns n, and their numbers in place. */
size_t crease_places_pack(const crease_places *places, double *matrix, size_t *place);

#endif
