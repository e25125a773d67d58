/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Moving least squares with a quadric, the window being cut at edges: by the angle of the normals,
 * and by the distance from the surface, which is found by reweighting.
 *
 * On a circle the mean of the normals of two points is across their chord. So the height of a
 * neighbour along the mean of both normals tells whether it lies on the same smooth surface,
 * however curved that is, before any surface is fitted.
 *
 * Based on: Levin. The approximation power of moving least-squares. 1998.
 * Based on: Oztireli, Guennebaud, Gross. Feature preserving point set surfaces based on non-linear
 * kernel regression. 2009 (weights by residual and by normal).
 * Based on: Beaton, Tukey. The fitting of power series. 1974 (the weights of the residuals). */
#include "noise/footing.h"

#include "base/select.h"
#include "base/symmetric.h"
#include "base/vector.h"

#include <math.h>
#include <string.h>

enum { TERMS = 6, FLAT = 3, ROUNDS = 3 };

static const double gate_sigmas = 4.2;  /* three times the noise of two points */
static const double gate_slope = 0.05;  /* what an error of the normals lifts, by distance */
static const double tukey = 4.0;        /* residuals in sigma beyond which weights are 0 */
static const double own_share = 0.25;   /* of the weight about the point's height: its own wall */
static const double bending_test = 4.0; /* F of the quadric over the plane that is significant */

/* Neighbours in the frame of the normal, the point being the origin; lengths in units of reach. */
typedef struct window {
    int count;
    double x[CREASE_MOST_FOOTING], y[CREASE_MOST_FOOTING], z[CREASE_MOST_FOOTING];
    double lift[CREASE_MOST_FOOTING]; /* height along the mean of both normals */
    double weight[CREASE_MOST_FOOTING];
    double axes[9]; /* rows: x, y, z */
    double reach, sigma;
} window;

typedef struct surface {
    double height[TERMS]; /* of 1 x y x^2 x y y^2 */
    double squares;       /* weighted sum of squared residuals */
    double weight;        /* sum of the weights */
    double leverage;      /* variance of height[0] over that of a point */
} surface;

static void set_frame(const double normal[3], double axes[9])
{
    const int axis = fabs(normal[0]) < fabs(normal[1])
        ? (fabs(normal[0]) < fabs(normal[2]) ? 0 : 2)
        : (fabs(normal[1]) < fabs(normal[2]) ? 1 : 2);
    const double least[3] = {axis == 0, axis == 1, axis == 2};
    memcpy(axes + 6, normal, 3 * sizeof *normal);
    crease_vector_cross(normal, least, axes);
    crease_vector_normalise(axes);
    crease_vector_cross(normal, axes, axes + 3);
}

static void add_neighbour(const crease_surroundings *around, const double own[3], size_t other,
    const double normal[3], window *w)
{
    const double *const n = around->normals + 3 * other;
    const double cosine = crease_vector_dot(n, normal);
    double away[3];
    if (fabs(cosine) < around->least_cosine || (around->outliers && around->outliers[other]))
        return;
    for (int c = 0; c < 3; c++)
        away[c] = (around->points[3 * other + (size_t)c] - own[c]) / w->reach;
    const double far = 1 - crease_vector_dot(away, away);
    const double agree = (fabs(cosine) - around->least_cosine) / (1 - around->least_cosine);
    if (far <= 0)
        return;
    const int i = w->count++;
    w->x[i] = crease_vector_dot(away, w->axes);
    w->y[i] = crease_vector_dot(away, w->axes + 3);
    w->z[i] = crease_vector_dot(away, w->axes + 6);
    w->lift[i] = 0.5 * (w->z[i] + copysign(1, cosine) * crease_vector_dot(away, n));
    w->weight[i] = far * far * agree;
}

static void open_window(
    const crease_surroundings *around, size_t point, const double normal[3], window *w)
{
    const int k = crease_neighbours_k(around->neighbours);
    const uint32_t *const near = crease_neighbours_of(around->neighbours, point);
    const double *const own = around->points + 3 * point;
    w->count = 0;
    w->reach = 1.05 * crease_vector_distance(own, around->points + 3 * (size_t)near[k - 1]);
    w->sigma = around->sigma / w->reach;
    set_frame(normal, w->axes);
    for (int j = 0; j < k && w->reach > 0; j++)
        if (near[j] != point)
            add_neighbour(around, own, near[j], normal, w);
}

static bool about(const window *w, int i, double height)
{
    const double gate = gate_sigmas * w->sigma + gate_slope * hypot(w->x[i], w->y[i]);
    return fabs(w->lift[i] - height) < gate;
}

/* Keeps the neighbours about the point's own height, or, where these are few, about the median. */
static void choose_surface(window *w)
{
    double own = 0, all = 0, lifts[CREASE_MOST_FOOTING];
    for (int i = 0; i < w->count; i++) {
        all += w->weight[i];
        own += about(w, i, 0) ? w->weight[i] : 0;
    }
    memcpy(lifts, w->lift, sizeof lifts);
    double height = 0;
    if (w->count > 0)
        height = crease_select(lifts, (size_t)w->count, (size_t)w->count / 2);
    if (own > own_share * all && !(fabs(height) < gate_sigmas * w->sigma))
        height = 0;
    int kept = 0;
    for (int i = 0; i < w->count; i++) {
        if (!about(w, i, height))
            continue;
        w->x[kept] = w->x[i], w->y[kept] = w->y[i], w->z[kept] = w->z[i];
        w->weight[kept++] = w->weight[i];
    }
    w->count = kept;
}

static double height_at(const surface *s, double x, double y)
{
    const double *const h = s->height;
    return h[0] + h[1] * x + h[2] * y + h[3] * x * x + h[4] * x * y + h[5] * y * y;
}

static double weight_of(const window *w, const surface *before, int i)
{
    if (!before)
        return w->weight[i];
    const double residual = (w->z[i] - height_at(before, w->x[i], w->y[i])) / (tukey * w->sigma);
    const double rest = 1 - residual * residual;
    return rest > 0 ? rest * rest * w->weight[i] : 0;
}

/* Weighted least squares of the first `terms` terms; weights by the residuals from `before`. */
static bool solve(const window *w, int terms, const surface *before, surface *out)
{
    double matrix[TERMS * TERMS] = {0}, right[TERMS] = {0}, unit[TERMS] = {1}, squares = 0;
    *out = (surface){0};
    for (int i = 0; i < w->count; i++) {
        const double x = w->x[i], y = w->y[i], weight = weight_of(w, before, i);
        const double term[TERMS] = {1, x, y, x * x, x * y, y * y};
        out->weight += weight;
        squares += weight * w->z[i] * w->z[i];
        for (int r = 0; r < terms; r++) {
            right[r] += weight * term[r] * w->z[i];
            for (int c = 0; c <= r; c++)
                matrix[TERMS * r + c] += weight * term[r] * term[c];
        }
    }
    for (int r = 0; r < terms; r++)
        matrix[(TERMS + 1) * r] += 1e-9 * out->weight;
    if (!(out->weight > terms + 1) || !crease_symmetric_factor(matrix, (size_t)terms, TERMS, TERMS))
        return false;
    memcpy(out->height, right, sizeof right);
    crease_symmetric_solve(matrix, (size_t)terms, TERMS, TERMS, out->height);
    crease_symmetric_solve(matrix, (size_t)terms, TERMS, TERMS, unit);
    for (int r = 0; r < terms; r++)
        squares -= out->height[r] * right[r];
    out->squares = fmax(squares, 0);
    out->leverage = fmax(unit[0], 0);
    return true;
}

/* The plane, or the quadric if it is significantly better. */
static bool fit_once(const window *w, const surface *before, surface *out)
{
    surface bent;
    if (!solve(w, FLAT, before, out))
        return false;
    if (!solve(w, TERMS, before, &bent))
        return true;
    const double variance = fmax(bent.squares / (bent.weight - TERMS), w->sigma * w->sigma);
    if (out->squares - bent.squares > 3 * bending_test * variance)
        *out = bent;
    return true;
}

bool crease_footing_fit(
    const crease_surroundings *around, size_t point, const double normal[3], crease_footing *out)
{
    window w;
    surface found, before;
    open_window(around, point, normal, &w);
    choose_surface(&w);
    if (!fit_once(&w, NULL, &found))
        return false;
    for (int round = 1; round < ROUNDS; round++) {
        before = found;
        if (!fit_once(&w, &before, &found))
            return false;
    }
    if (!(found.leverage < 1))
        return false;
    const double slope[3] = {-found.height[1], -found.height[2], 1};
    const double length = crease_vector_length(slope);
    const double variance = fmax(found.squares / found.weight, w.sigma * w.sigma);
    out->distance = -found.height[0] / length * w.reach;
    out->error = sqrt(found.leverage * variance) / length * w.reach;
    out->sigma = sqrt(variance) * w.reach;
    for (int c = 0; c < 3; c++) {
        out->normal[c] =
            (slope[0] * w.axes[c] + slope[1] * w.axes[3 + c] + slope[2] * w.axes[6 + c]) / length;
        out->foot[c] = around->points[3 * point + (size_t)c] - out->distance * out->normal[c];
    }
    return true;
}
