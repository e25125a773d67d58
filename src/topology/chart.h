/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Parameters u, v on the surface of a face, the same as CAD kernels use: u the angle about the axis
 * of sphere, cylinder, cone and torus; v the height of a cylinder, the length along a cone's side,
 * the latitude on a sphere, the angle about the tube of a torus; x and y of planes and height
 * fields, angle and height of free forms about an axis, a projection of those about a centre. Plain
 * C without atomics, so that C++ can include it. */
#ifndef CREASE_TOPOLOGY_CHART_H
#define CREASE_TOPOLOGY_CHART_H

#include "crease/crease.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct crease_chart {
    crease_region_type type;
    double centre[3];
    double axes[9];         /* x, y, z row by row, right-handed; u = 0 along x */
    double radius, shape;   /* as in crease_model, but the shape of a cone is not negative */
    double middle;          /* torus: v is within half a turn of it */
    bool round;             /* free form: its heights are distances from its z axis, ... */
    bool ball;              /* ... or from its centre */
    double low[2], high[2]; /* free form: the rectangle that its heights cover, ... */
    size_t side;            /* ... side x side of them, those of one u together */
    double *heights;
} crease_chart;

/* Whether u (0) or v (1) runs round and comes back. */
CREASE_API bool crease_chart_turns(const crease_chart *chart, int direction);
/* u (0..2 pi where it turns) and v of a place on the surface. */
CREASE_API void crease_chart_at(const crease_chart *chart, const double place[3], double uv[2]);
/* The direction from the centre of a ball at u and v. */
CREASE_API void crease_chart_ball_direction(const double uv[2], double out[3]);
/* And back, of any vector in the chart's frame. */
CREASE_API void crease_chart_ball_at(const double vector[3], double uv[2]);
/* The value that stands for the same angle and is within half a turn of another. */
CREASE_API double crease_chart_near(double angle, double other);
/* u and v of consecutive places of a line: turning parameters go on from place to place. */
CREASE_API void crease_chart_along(
    const crease_chart *chart, const double *places, size_t count, double *uv);
/* Turns the frame about its z so that a place has u = 0 (not if it is on the axis). */
CREASE_API void crease_chart_begin_at(crease_chart *chart, const double place[3]);

#ifdef __cplusplus
}
#endif

#endif
