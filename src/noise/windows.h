/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Height fields fitted to the windows around some points of a cloud: what the noise and the normals
 * are found from. The points may be those of a piece of the cloud; what a window says does not
 * depend on how the cloud is cut. */
#ifndef CREASE_NOISE_WINDOWS_H
#define CREASE_NOISE_WINDOWS_H

#include "noise/noise.h"
#include "noise/quadric.h"

/* Neighbours of a point in its windows, without the point itself: fewer in tiny clouds. */
typedef struct crease_window_sizes {
    int wide, narrow, tight;
} crease_window_sizes;

/* A height field z = h0 + h1 x + h2 y + h3 x^2 + h4 x y + h5 y^2 in a frame. Lengths are in the
 * unit of the windows, so that floats do for any size of cloud. */
typedef struct crease_window {
    float centre[3]; /* relative to the window's point */
    float x[3], z[3];
    float height[CREASE_QUADRIC_TERMS];
    float flat, bent; /* sums of squared residuals of the plane and of the quadric */
} crease_window;

typedef struct crease_windows {
    const double *points;
    const crease_neighbours *neighbours;
    size_t begin, end; /* the points worked on */
    crease_window_sizes sizes;
    double unit;
    /* By point: a wide and a narrow window. Those of the points worked on are fitted; normals ask
     * for those of their neighbours as well. */
    crease_window (*of)[2];
} crease_windows;

/* k: how many neighbours of a point are known, itself included. */
crease_window_sizes crease_window_sizes_of(int k);
/* Makes room; points, neighbours, begin, end and unit are set. */
crease_status crease_windows_create(crease_context *context, crease_windows *windows);
void crease_windows_free(crease_windows *windows);
/* Fits the windows of the points worked on. Threaded. */
crease_status crease_windows_fit(crease_context *context, const crease_windows *windows);
/* One number of each point worked on, by point. Threaded. */
crease_status crease_windows_values(crease_context *context, const crease_windows *windows,
    crease_noise_value which, double *values);
/* Local spacing, normal and score of each point worked on, by point: what noise.h tells of them.
 * Threaded. */
crease_status crease_windows_describe(crease_context *context, const crease_windows *windows,
    const crease_noise_scale *scale, const crease_noise *noise);

#endif
