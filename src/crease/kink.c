/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Two profiles are fitted to the points,
 *
 *   kinked  z = a + b u + c u-^2 + d u+^2 + e u+        u- = min(u, 0), u+ = max(u, 0)
 *   smooth  the same without e, its pieces joining at the best of several places,
 *
 * with cubic terms when the window is wide, by reweighted least squares. */
#include "crease/kink.h"

#include "base/symmetric.h"

#include <math.h>
#include <string.h>

enum {
    MOST_TERMS = 7,
    ROUNDS = 2,      /* of reweighting */
    LEAST_JOINTS = 6 /* places tried for the joint of the smooth profile, in half the window */
};

static const double CUBIC_WIDTH = 8.0; /* in spacings: wider windows get cubic terms */
static const double JOINT_RANGE = 0.7; /* of the width, on both sides */
static const double OUTLIER = 12.0;    /* squared sigmas that one point may cost */
static const double SOFTNESS = 3.0;    /* sigmas at which a point has a quarter of its weight */
static const double NEVER = 1e300;

/* A kind of profile. */
struct shape {
    bool kinked, cubic;
    double joint, width;
};

static size_t term_count(const struct shape *shape)
{
    return 4 + 2 * (size_t)shape->cubic + (size_t)shape->kinked;
}

/* The kink is the last term. */
static void terms(const struct shape *shape, double at, double *out)
{
    const double u = at - shape->joint, before = fmin(u, 0.0), after = fmax(u, 0.0);
    size_t n = 0;
    out[n++] = 1.0;
    out[n++] = u;
    out[n++] = before * before;
    out[n++] = after * after;
    if (shape->cubic) {
        out[n++] = before * before * before / shape->width;
        out[n++] = after * after * after / shape->width;
    }
    if (shape->kinked)
        out[n] = after;
}

static double residual(
    const struct shape *shape, const crease_profile_sample *sample, const double *weights)
{
    double values[MOST_TERMS], z = sample->z;
    terms(shape, sample->u, values);
    for (size_t k = 0; k < term_count(shape); k++)
        z -= weights[k] * values[k];
    return z;
}

/* One round of least squares; weights holds the result of the last one, or nothing. *precision: one
 * over the variance of the last term, in square sigmas. */
static bool solve(const struct shape *shape, const crease_profile_sample *samples, size_t count,
    double sigma, bool reweight, double *weights, double *precision)
{
    const size_t n = term_count(shape);
    double matrix[MOST_TERMS * MOST_TERMS] = {0}, right[MOST_TERMS] = {0}, values[MOST_TERMS];
    for (size_t i = 0; i < count; i++) {
        double weight = 1.0;
        if (reweight) {
            const double r = residual(shape, &samples[i], weights) / (SOFTNESS * sigma);
            weight = 1.0 / ((1.0 + r * r) * (1.0 + r * r));
        }
        terms(shape, samples[i].u, values);
        for (size_t k = 0; k < n; k++) {
            right[k] += weight * values[k] * samples[i].z;
            for (size_t l = 0; l <= k; l++)
                matrix[k * n + l] += weight * values[k] * values[l];
        }
    }
    for (size_t k = 0; k < n; k++)
        matrix[k * n + k] *= 1.0 + 1e-6; /* a side without points leaves its terms open */
    if (!crease_symmetric_factor(matrix, n, n, n))
        return false;
    crease_symmetric_solve(matrix, n, n, n, right);
    memcpy(weights, right, n * sizeof *weights);
    *precision = matrix[n * n - 1] * matrix[n * n - 1];
    return true;
}

/* What the best profile of a shape leaves, in squared sigmas; NEVER when there is none. */
static double fit(const struct shape *shape, const crease_profile_sample *samples, size_t count,
    double sigma, double *weights, double *precision)
{
    double cost = 0.0;
    for (int round = 0; round < ROUNDS; round++)
        if (!solve(shape, samples, count, sigma, round > 0, weights, precision))
            return NEVER;
    for (size_t i = 0; i < count; i++) {
        const double r = residual(shape, &samples[i], weights) / sigma;
        cost += fmin(r * r, OUTLIER);
    }
    return cost;
}

/* What the best smooth profile leaves, whatever the place of its joint. */
static double fit_smooth(const crease_profile_sample *samples, size_t count, double width,
    double spacing, double sigma, bool cubic)
{
    const double step = fmin(width / LEAST_JOINTS, spacing); /* coarser ones fake kinks */
    const double steps = floor(2.0 * JOINT_RANGE * width / step);
    double weights[MOST_TERMS], precision, least = NEVER;
    for (double i = 0.0; i <= steps; i += 1.0) {
        const struct shape shape = {false, cubic, i * step - JOINT_RANGE * width, width};
        least = fmin(least, fit(&shape, samples, count, sigma, weights, &precision));
    }
    return least;
}

bool crease_kink_measure(const crease_profile_sample *samples, size_t count, double width,
    double spacing, double sigma, crease_kink *out)
{
    const bool cubic = width > CUBIC_WIDTH * spacing;
    const struct shape shape = {true, cubic, 0.0, width};
    double weights[MOST_TERMS], precision = 0.0;
    out->smooth = fit_smooth(samples, count, width, spacing, sigma, cubic);
    out->kinked = fit(&shape, samples, count, sigma, weights, &precision);
    if (out->kinked == NEVER || out->smooth == NEVER)
        return false;
    const double before = weights[1], after = weights[1] + weights[term_count(&shape) - 1];
    out->bend = fabs(atan(after) - atan(before));
    out->error = sigma / sqrt(precision);
    return true;
}
