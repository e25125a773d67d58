/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Trimmed sheets. Internal view. */
#ifndef CREASE_MODEL_TRIM_H
#define CREASE_MODEL_TRIM_H

#include "base/context.h"
#include "crease/crease_trim.h"

typedef struct crease_trim_face {
    size_t piece;
    size_t first_loop, loop_count;
} crease_trim_face;

struct crease_trim {
    bool whole;
    size_t vertex_count;
    double *vertices; /* vertex_count x 2 */
    size_t edge_count;
    crease_trim_edge *edges;
    crease_curve **curves; /* of the edges */
    size_t face_count;
    crease_trim_face *faces;
    size_t *first_half; /* of all loops, and the end */
    crease_trim_half *halves;
    size_t piece_count;
    crease_surface **pieces;
    size_t crease_count;
    crease_curve **creases;
};

#endif
