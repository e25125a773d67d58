/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The scores and features of a piece of a cloud (see space/piece.h), in the steps between which
 * pieces have to know of each other:
 *
 *   compute  what the neighbourhoods of its own points say; needs their K nearest points
 *   decide   the least score of a feature, from the counts of all pieces added up
 *   mark     which of its own points are features; needs their 2 K nearest, and their scores
 *
 * What a point gets is the same bytes however the cloud is cut. */
#ifndef CREASE_DETECT_SCORING_H
#define CREASE_DETECT_SCORING_H

#include "detect/threshold.h"
#include "space/piece.h"

typedef struct crease_scoring {
    const crease_tree *tree; /* of the piece's points */
    crease_piece piece;
    crease_detect_options options;
    double *variance; /* by point of the piece: scores; compute sets those of own points */
    double *normals;  /* by point of the piece, x 3, or NULL */
} crease_scoring;

/* What a decision needs to know of all points. */
typedef struct crease_scoring_counts {
    uint64_t points, degenerate; /* those whose neighbours have no normal */
    crease_histogram scores;
} crease_scoring_counts;

/* Whether the options suit a cloud of so many points. */
crease_status crease_scoring_check(
    crease_context *context, size_t count, const crease_detect_options *options);
/* How many nearest points of each of its own ones a piece must hold. count: of the whole cloud. */
int crease_scoring_reach(size_t count, const crease_detect_options *options);
/* Adds to the counts. Threaded. */
crease_status crease_scoring_compute(
    crease_context *context, const crease_scoring *scoring, crease_scoring_counts *counts);
/* Errors: DEGENERATE, when no point has a normal. */
crease_status crease_scoring_decide(crease_context *context, const crease_scoring_counts *counts,
    const crease_detect_options *options, double *threshold);
/* features: by point of the piece; those of own points are set. count: of the whole cloud.
 * Threaded. */
crease_status crease_scoring_mark(crease_context *context, const crease_scoring *scoring,
    size_t count, double threshold, uint8_t *features);

#endif
