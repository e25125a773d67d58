/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Looks across a height field for lines, along its axes, where it bends or jumps. */
#ifndef CREASE_FIT_SCAN_H
#define CREASE_FIT_SCAN_H

#include "net/samples.h"

enum { CREASE_MOST_CANDIDATES = 16 };

/* A line along which two planes explain the points beside it better than one smooth surface. */
typedef struct crease_candidate {
    int direction; /* 0: at constant x, 1: at constant y */
    int count;     /* 1: a bend at at[0]; 2: a step from at[0] to at[1] */
    double at[2];
    double gain; /* sum of log likelihoods gained */
} crease_candidate;

/* The candidates of both directions, by falling gain. Errors: NO_MEMORY. */
crease_status crease_scan(crease_context *context, const crease_samples *samples,
    crease_candidate candidates[CREASE_MOST_CANDIDATES], size_t *count);
/* The turn about z, within 45 degrees, after which bends and steps follow the axes best. */
crease_status crease_scan_turn(
    crease_context *context, const crease_samples *samples, double *angle);

#endif
