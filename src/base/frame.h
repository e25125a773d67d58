/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A rigid frame: local = rotation (point - origin), and the way back. */
#ifndef CREASE_BASE_FRAME_H
#define CREASE_BASE_FRAME_H

#include <stddef.h>

typedef struct crease_frame {
    double rotation[9]; /* M, row by row: its rows are the local axes */
    double origin[3];
} crease_frame;

/* count x 3 points into the frame, or back from it; from and to may be the same. */
void crease_frame_enter(const crease_frame *frame, const double *from, size_t count, double *to);
void crease_frame_leave(const crease_frame *frame, const double *from, size_t count, double *to);
/* Turns the frame by an angle (radians) about its own z axis. */
void crease_frame_turn(crease_frame *frame, double angle);
/* How far the rotation is from a right-handed orthonormal one: the largest entry of |M M^T - 1|, or
 * infinity when the determinant is not positive. */
double crease_frame_defect(const double rotation[9]);

#endif
