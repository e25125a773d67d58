/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The data of a fit: points in the frame of the sheet, where they fall on it, and their weights. */
#ifndef CREASE_NET_SAMPLES_H
#define CREASE_NET_SAMPLES_H

#include "net/height.h"

typedef struct crease_samples {
    size_t count, step;
    const double *source; /* the cloud's points, of which every step-th is a sample */
    uint32_t *order;      /* numbers of the points where there are many, neighbours together */
    double *points;       /* count x 3, in the frame */
    double *uv;           /* count x 2: parameters of each point's foot on the sheet */
    double *target;       /* height that the sheet should have over uv */
    double *tilt;         /* z of the sheet's unit normal there: vertical to true distance */
    double *prior;        /* 0 for points left out, else 1 */
    double *weight;       /* of the point in the next fit: prior times robust weight */
    double *residual;     /* distance from the sheet, along its normal */
    double *scratch;      /* count */
    double used;          /* sum of prior */
    double spacing;       /* mean distance of neighbours */
    bool placed;
    crease_frame frame;     /* in which they are placed */
    double low[2], high[2]; /* the box of the points kept there */
    double bottom, range;   /* of the heights of the points kept */
    double rounding;        /* below this a distance means nothing */
} crease_samples;

/* Every step-th point of count; the points must outlive the samples. keep: 0 for points to leave
 * out. spacing: that of all the points. epsilon: relative rounding of the coordinates. */
crease_status crease_samples_create(crease_context *context, const double *points,
    const double *keep, size_t count, size_t step, double spacing, double epsilon,
    crease_samples *out);
/* Number of the point that is sample i. */
size_t crease_samples_number(const crease_samples *samples, size_t i);
void crease_samples_free(crease_samples *samples);
/* Puts the points into the frame, their feet straight below them. low, high: the box of the points
 * kept, x and y. */
void crease_samples_place(
    crease_samples *samples, const crease_frame *frame, double low[2], double high[2]);

/* Moves each foot to the nearest place of the sheet, within the smooth part of it that lies below
 * the point, and aims at the plane that touches the sheet there, so that the next fit minimises
 * true distances. Measures the distances, too.
 * Based on: Wang, Pottmann, Liu. Fitting B-spline curves to point clouds by curvature-based squared
 * distance minimization. 2006 (section 2, tangent distance). */
crease_status crease_samples_project(crease_context *context, crease_samples *samples,
    const crease_height *height, const crease_layout *layout);
/* Distances of all points from the sheet at their feet. */
crease_status crease_samples_measure(
    crease_context *context, crease_samples *samples, const crease_height *height);
/* Mean distance of the points kept, each counted as at most ten robust deviations or two spacings,
 * whichever is more: outliers must not decide. */
double crease_samples_mean_distance(crease_samples *samples);
/* Robust standard deviation of the distances; at least 1e-8 spacings, so that points that fit as
 * well as rounding lets them keep equal weights. */
double crease_samples_scale(crease_samples *samples);
/* Weights by distance: redescending ones (Cauchy's) all but forget outliers; the others are those
 * of a smoothed absolute value. */
void crease_samples_reweigh(crease_samples *samples, double scale, bool redescending);

#endif
