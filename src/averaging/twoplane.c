/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "averaging/twoplane.h"

#include "base/select.h"
#include "base/vector.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { DIRECTIONS = 4, OFFSETS = 3, ROUNDS = 80 };

static const double LEAST_SINE = 0.0871557427476582; /* of 5 degrees */
static const double LEAST_GAIN = 0.5; /* of the mean distance, two planes against one */

/* Points with the share (weight) that each plane has in them, and room to find medians. */
typedef struct work {
    const double *points;
    size_t count;
    double *share[2], *nearest, *sorted;
    double narrowest; /* spread across the narrower of the two sets of points, squared */
    double least;     /* below this a distance is rounding */
    double spacing;   /* a fraction of that of the points */
} work;

static double distance(const double normal[3], const double centre[3], const double *p)
{
    const double d[3] = {p[0] - centre[0], p[1] - centre[1], p[2] - centre[2]};
    return fabs(crease_vector_dot(d, normal));
}

/* Two thirds of the points are nearer: one face may hold more than half of them. */
static double quantile_of_nearest(work *w)
{
    memcpy(w->sorted, w->nearest, w->count * sizeof *w->sorted);
    return crease_select(w->sorted, w->count, (size_t)(0.65 * (double)w->count));
}

/* Shares that pass from one plane to the other at an offset from the mean, in a direction. Lengths
 * in standard deviations of the points in that direction. */
static void guess(
    work *w, const double mean[3], const double direction[3], double deviation, double offset)
{
    for (size_t i = 0; i < w->count; i++) {
        const double *const p = w->points + 3 * i;
        const double d[3] = {p[0] - mean[0], p[1] - mean[1], p[2] - mean[2]};
        const double t = 0.5 + (crease_vector_dot(d, direction) / deviation - offset) / 1.2;
        w->share[1][i] = fmin(1.0, fmax(0.0, t));
        w->share[0][i] = 1.0 - w->share[1][i];
    }
}

static void measure_nearest(work *w, const crease_twoplane *planes)
{
    for (size_t i = 0; i < w->count; i++) {
        const double *const p = w->points + 3 * i;
        w->nearest[i] = fmin(distance(planes->normal[0], planes->centre[0], p),
            distance(planes->normal[1], planes->centre[1], p));
    }
}

static void fit_planes(work *w, crease_twoplane *planes)
{
    w->narrowest = INFINITY;
    for (int k = 0; k < 2; k++) {
        double values[3], axes[9];
        crease_vector_main_axes(w->points, w->share[k], w->count, planes->centre[k], values, axes);
        memcpy(planes->normal[k], axes, sizeof planes->normal[k]);
        w->narrowest = fmin(w->narrowest, values[1]);
    }
    measure_nearest(w, planes);
}

static double odds_against(double own, double other)
{
    return exp(fmin(700.0, 0.5 * (own * own - other * other)));
}

/* The share of a plane in a point: the likelihood among the two, less for far points (Cauchy).
 * Points about as near to both planes as points are to each other count for both, so that those of
 * the edge itself hold both planes in place. */
static void share_out(work *w, const crease_twoplane *planes, double scale)
{
    const double undecided = fmax(1.0, w->spacing / scale);
    for (size_t i = 0; i < w->count; i++) {
        double r[2];
        for (int k = 0; k < 2; k++)
            r[k] = distance(planes->normal[k], planes->centre[k], w->points + 3 * i) / scale;
        for (int k = 0; k < 2; k++) {
            const double odds = odds_against(r[k] / undecided, r[1 - k] / undecided);
            w->share[k][i] = 1.0 / ((1.0 + odds) * (1.0 + r[k] * r[k] / 9.0));
        }
    }
}

static double mean_of_nearest(const work *w)
{
    double sum = 0.0;
    for (size_t i = 0; i < w->count; i++)
        sum += w->nearest[i];
    return sum / (double)w->count;
}

/* Expectation and maximisation from the shares at hand; the mean distance reached. The scale of the
 * distances shrinks slowly, so that no plane is given up early. */
static double settle(work *w, crease_twoplane *planes)
{
    double before = INFINITY, scale = 0.0;
    for (int round = 0; round < ROUNDS; round++) {
        fit_planes(w, planes);
        const double now = mean_of_nearest(w);
        if (round > 20 && fabs(before - now) <= 1e-12 * now)
            break;
        before = now;
        scale = fmax(fmax(w->least, 0.7 * scale), 1.4826 * quantile_of_nearest(w));
        share_out(w, planes, scale);
    }
    return mean_of_nearest(w);
}

/* The edge: the point nearest to `mean` on both planes, and the ways from it into the faces. */
static bool meet(crease_twoplane *planes, const double mean[3], double extent)
{
    double(*const n)[3] = planes->normal;
    crease_vector_cross(n[0], n[1], planes->direction);
    const double sine = crease_vector_length(planes->direction);
    if (sine < LEAST_SINE)
        return false;
    crease_vector_normalise(planes->direction);
    double step[2][3], height[2];
    for (int k = 0; k < 2; k++) {
        const double d[3] = {planes->centre[k][0] - mean[0], planes->centre[k][1] - mean[1],
            planes->centre[k][2] - mean[2]};
        height[k] = crease_vector_dot(d, n[k]);
        crease_vector_cross(planes->direction, n[k], step[k]);
    }
    for (int c = 0; c < 3; c++)
        planes->edge[c] = mean[c] + (height[1] * step[0][c] - height[0] * step[1][c]) / sine;
    for (int k = 0; k < 2; k++) {
        for (int c = 0; c < 3; c++)
            planes->inward[k][c] = planes->centre[k][c] - planes->edge[c];
        const double along = crease_vector_dot(planes->inward[k], planes->direction);
        for (int c = 0; c < 3; c++)
            planes->inward[k][c] -= along * planes->direction[c];
        crease_vector_normalise(planes->inward[k]);
    }
    return crease_vector_distance(planes->edge, mean) < extent;
}

/* Number g of the guesses: four directions within the main plane, first across the middle, where
 * the edge of an even sample is, then off it. */
static void first_guess(
    work *w, int g, const double mean[3], const double values[3], const double axes[9])
{
    static const double offsets[OFFSETS] = {0.0, -0.7, 0.7};
    const double angle = 3.14159265358979324 / DIRECTIONS * (g % DIRECTIONS);
    const double c = cos(angle), s = sin(angle);
    double direction[3];
    for (int i = 0; i < 3; i++)
        direction[i] = c * axes[6 + i] + s * axes[3 + i];
    const double variance = c * c * values[2] + s * s * values[1];
    guess(w, mean, direction, fmax(w->least, sqrt(fmax(0.0, variance))), offsets[g / DIRECTIONS]);
}

/* 0 when the points of both planes lie on the same side of the edge, 2 when the planes are one; 1
 * where they do not meet near the points. */
static double openness(crease_twoplane *planes, const double mean[3], double extent)
{
    return meet(planes, mean, extent)
        ? 1.0 - crease_vector_dot(planes->inward[0], planes->inward[1])
        : 1.0;
}

/* From every guess. Of the pairs of planes about as near to the points as the nearest pair, the one
 * whose narrower set of points is widest, for a plane through a single row of points fits anything,
 * and that folds the least: of three rows of points any two lie on a plane.
 * Returns its mean distance; infinite when every pair has a plane that is not determined. */
static double settle_all(work *w, const double mean[3], const double values[3],
    const double axes[9], double extent, crease_twoplane *out)
{
    crease_twoplane planes[DIRECTIONS * OFFSETS];
    const double undetermined = 4.0 * w->spacing * w->spacing;
    double reached[DIRECTIONS * OFFSETS], merit[DIRECTIONS * OFFSETS], least = INFINITY;
    for (int g = 0; g < DIRECTIONS * OFFSETS; g++) {
        first_guess(w, g, mean, values, axes);
        reached[g] = settle(w, &planes[g]);
        merit[g] = 0.0;
        if (w->narrowest > undetermined) {
            merit[g] = w->narrowest * openness(&planes[g], mean, extent);
            least = fmin(least, reached[g]);
        }
    }
    double most = 0.0, taken = INFINITY;
    for (int g = 0; g < DIRECTIONS * OFFSETS; g++)
        if (reached[g] <= 2.0 * least + 1e-9 * extent && merit[g] > 1.01 * most) {
            most = merit[g];
            taken = reached[g];
            *out = planes[g];
        }
    return taken;
}

/* Whether two planes are much nearer than one, to the points in the mean or to most of them. */
static bool gains(work *w, const crease_twoplane *two, double reached, const double mean[3],
    const double normal[3])
{
    double sum = 0.0;
    measure_nearest(w, two);
    const double most = quantile_of_nearest(w);
    for (size_t i = 0; i < w->count; i++)
        sum += w->nearest[i] = distance(normal, mean, w->points + 3 * i);
    const double one = sum / (double)w->count;
    return one > w->least &&
        (reached < LEAST_GAIN * one || most < LEAST_GAIN * quantile_of_nearest(w));
}

bool crease_twoplane_fit(const double *points, size_t count, double *scratch, crease_twoplane *out)
{
    double mean[3], values[3], axes[9];
    crease_vector_main_axes(points, NULL, count, mean, values, axes);
    const double extent = 3.0 * sqrt(fmax(0.0, values[0] + values[1] + values[2]));
    work w = {.points = points,
        .count = count,
        .share = {scratch, scratch + count},
        .nearest = scratch + 2 * count,
        .sorted = scratch + 3 * count,
        .least = fmax(DBL_MIN, 1e-12 * extent),
        .spacing = 0.08 * extent / sqrt((double)count)};
    const double best = settle_all(&w, mean, values, axes, extent, out);
    return best < INFINITY && gains(&w, out, best, mean, axes) && meet(out, mean, extent);
}
