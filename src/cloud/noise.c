/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Spacing, noise and normals of a cloud, from height fields fitted to small windows: to a point and
 * its 24 nearest neighbours (wide) and to its 10 nearest (narrow, for thin walls and small faces).
 * Errors that neighbours share are found in larger windows: see correlation.h.
 *
 * Noise. On smooth ground the residual variance of a window is sigma^2 times chi-square over its
 * degrees of freedom; edges only raise it. A low quantile, divided by that quantile of chi-square,
 * therefore is sigma^2 as long as a third of the windows see smooth ground.
 *
 * Normals. A window across an edge has no meaningful normal. Each point takes the normal from
 * whichever of the windows that contain it has the least residual, nearer ones preferred where the
 * difference is noise: the window then lies on the point's own side of the edge. */
#include "cloud/noise.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "base/select.h"
#include "base/vector.h"
#include "cloud/correlation.h"
#include "cloud/quadric.h"
#include "space/neighbours.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    WIDE = CREASE_NOISE_NEIGHBOURS - 1,
    NARROW = 10,
    TIGHT = 8,
    TERMS = CREASE_QUADRIC_TERMS,
    GRAIN = 1024
};

static const double quantile = 0.3;      /* of the residual variances */
static const double wide_share = 0.80;   /* that quantile of chi-square / dof, about 18 dof */
static const double tight_share = 0.64;  /* the same for 6 dof */
static const double tight_median = 0.89; /* the median of chi-square / dof for 6 dof */
static const double thin_residual = 0.4; /* of wide windows across a thin wall, in spacings */
static const double flat_share = 0.1;    /* of the tight windows, and a residual variance, over the
                                            noise's, that independent noise leaves in one of 300 */
static const double flat_variance = 0.05;
static const double terrace_points = 3.0; /* that err alike on a terrace, at least */
static const double roughest = 0.7;  /* in spacings: greater residuals are not of noise alone */
static const double trimmed = 0.985; /* share of the K-th neighbours' distances averaged: the rest
                                        belongs to outliers and to the rims of holes */
static const double least_sigma = 0.03; /* in spacings */
static const double thinnest = 1e-14; /* ratio of the middle to the greatest variance of all points
                                        that is not a line: above the rounding of eigenvalues */
static const double bending_test = 4.0; /* F of the quadric over the plane that is significant */

/* A height field z = h0 + h1 x + h2 y + h3 x^2 + h4 x y + h5 y^2 in a frame. Lengths are in units
 * of struct estimate's unit, so that floats do for any size of cloud. */
typedef struct window {
    float centre[3]; /* relative to the window's point */
    float x[3], z[3];
    float height[TERMS];
    float flat, bent; /* sums of squared residuals of the plane and of the quadric */
} window;

typedef struct estimate {
    const double *points;
    const crease_neighbours *neighbours;
    size_t count;
    int wide, narrow, tight; /* neighbours in use, without the point itself */
    double unit;
    double sigma2; /* in square units */
    bool thin;     /* walls are so thin that wide windows see both sides */
    bool terraced; /* points beside each other have been rounded alike */
    window *wides, *narrows;
    double *values; /* one number for each point, for quantiles */
    crease_noise *noise;
} estimate;

/* The window's points relative to its own point, in units. Returns their number. */
static int gather(const estimate *run, size_t point, int neighbours, double (*out)[3])
{
    const uint32_t *const near = crease_neighbours_of(run->neighbours, point);
    const double *const own = run->points + 3 * point;
    for (int j = 0; j <= neighbours; j++)
        for (int c = 0; c < 3; c++)
            out[j][c] = (run->points[3 * (size_t)near[j] + (size_t)c] - own[c]) / run->unit;
    return neighbours + 1;
}

static void fit_window(const estimate *run, size_t point, int neighbours, window *out)
{
    double points[WIDE + 1][3], centre[3], values[3], axes[9], height[TERMS];
    const int count = gather(run, point, neighbours, points);
    const double flat = crease_quadric_plane(points, count, centre, values, axes);
    double bent = -1.0, scale = sqrt(values[2] / count);
    if (count > NARROW && scale > 0.0)
        bent = crease_quadric_fit(points, count, axes, scale, height);
    *out = (window){.flat = (float)flat, .bent = (float)(bent < 0.0 ? flat : bent)};
    for (int c = 0; c < 3; c++) {
        out->centre[c] = (float)centre[c];
        out->x[c] = (float)axes[6 + c];
        out->z[c] = (float)axes[c];
    }
    const double degree[TERMS] = {1, scale, scale, scale * scale, scale * scale, scale * scale};
    for (int r = 0; r < TERMS && bent >= 0.0; r++)
        out->height[r] = (float)(height[r] / degree[r]);
}

/* Whether the quadric explains significantly more than the plane, given the noise. */
static bool is_bent(const window *w, int count, double sigma2)
{
    const double variance = fmax((double)w->bent / (count - TERMS), sigma2);
    return count > NARROW && ((double)w->flat - (double)w->bent) / 3.0 > bending_test * variance;
}

static double residual_variance(const window *w, int count, double sigma2)
{
    return is_bent(w, count, sigma2) ? (double)w->bent / (count - TERMS)
                                     : (double)w->flat / (count - 3);
}

static void fit_windows(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const estimate *run = user;
    for (size_t i = begin; i < end; i++) {
        fit_window(run, i, run->wide, &run->wides[i]);
        fit_window(run, i, run->narrow, &run->narrows[i]);
    }
}

static void tight_variances(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const estimate *run = user;
    double points[TIGHT + 1][3], centre[3], values[3], axes[9];
    for (size_t i = begin; i < end; i++) {
        const int count = gather(run, i, run->tight, points);
        run->values[i] = crease_quadric_plane(points, count, centre, values, axes) / (count - 3);
    }
}

static double squared_reach(const estimate *run, size_t point, int neighbour)
{
    const uint32_t other = crease_neighbours_of(run->neighbours, point)[neighbour];
    const double distance =
        crease_vector_distance(run->points + 3 * point, run->points + 3 * (size_t)other) /
        run->unit;
    return distance * distance;
}

/* Square spacing from the distances to the K-th neighbours: on a surface K points take the area
 * pi r_K^2 = K s^2. The noise of both points along the normal is taken out. */
static double squared_spacing(const estimate *run, int neighbour, double points, double sigma2)
{
    for (size_t i = 0; i < run->count; i++)
        run->values[i] = squared_reach(run, i, neighbour);
    const size_t kept = (size_t)fmax(trimmed * (double)run->count, 1.0);
    crease_select(run->values, run->count, kept - 1);
    double sum = 0.0;
    for (size_t i = 0; i < kept; i++)
        sum += run->values[i];
    return acos(-1.0) * fmax(sum / (double)kept - 2.0 * sigma2, 0.0) / points;
}

static double low_quantile(const estimate *run)
{
    return crease_select(run->values, run->count, (size_t)(quantile * (double)run->count));
}

/* Whether most wide windows see both sides of a thin wall: they leave a good part of the spacing,
 * and nearly all planes through 8 neighbours far less. Where only some do, the points lie on
 * terraces or rows. *tight: variance of the noise by these planes. */
static bool is_thin(const estimate *run, double spacing2, double *tight)
{
    const double most = crease_select(run->values, run->count, run->count / 2) / tight_median;
    *tight = low_quantile(run) / tight_share;
    return most < 0.25 * run->sigma2 && run->sigma2 > thin_residual * thin_residual * spacing2;
}

/* Whether the points lie on terraces or rows, as rounded depths make them: many tight windows are
 * flat where wide ones are rough. */
static bool is_terraced(const estimate *run, double spacing2)
{
    const size_t rank = (size_t)(flat_share * (double)run->count);
    return crease_select(run->values, run->count, rank) < flat_variance * run->sigma2 &&
        run->sigma2 > 4.0 * least_sigma * least_sigma * spacing2;
}

/* Sigma and spacing by the wide windows, or by the tight ones where walls are thin. */
static crease_status find_scale(crease_context *context, estimate *run, double *spacing2)
{
    for (size_t i = 0; i < run->count; i++)
        run->values[i] = residual_variance(&run->wides[i], run->wide + 1, 0.0);
    run->sigma2 = low_quantile(run) / wide_share;
    *spacing2 = squared_spacing(run, run->wide, run->wide, run->sigma2);
    const crease_status status =
        crease_parallel_for(context, run->count, GRAIN, tight_variances, run);
    if (status != CREASE_OK)
        return status;
    double tight;
    run->thin = is_thin(run, *spacing2, &tight);
    run->terraced = !run->thin && is_terraced(run, *spacing2);
    if (run->thin) {
        run->sigma2 = tight;
        *spacing2 = squared_spacing(run, run->tight, run->tight + 0.3, tight);
    }
    for (size_t i = 0; i < run->count; i++) {
        const double reach2 = squared_reach(run, i, run->wide);
        const double local = acos(-1.0) * (reach2 - 2.0 * run->sigma2) / run->wide;
        run->noise->local_spacing[i] =
            (float)(run->unit * sqrt(run->thin ? *spacing2 : fmax(local, 0.1 * *spacing2)));
    }
    return CREASE_OK;
}

/* Height of a place over the window and the unit normal there; at is relative to the window's own
 * point. */
static double above(const window *w, bool bent, const double at[3], double normal[3])
{
    double d[3], y[3];
    const double x[3] = {w->x[0], w->x[1], w->x[2]}, z[3] = {w->z[0], w->z[1], w->z[2]};
    for (int c = 0; c < 3; c++)
        d[c] = at[c] - (double)w->centre[c];
    crease_vector_cross(z, x, y);
    const double u = crease_vector_dot(d, x), v = crease_vector_dot(d, y);
    double h[TERMS] = {0};
    for (int r = 0; r < TERMS && bent; r++)
        h[r] = (double)w->height[r];
    const double du = h[1] + 2.0 * h[3] * u + h[4] * v, dv = h[2] + h[4] * u + 2.0 * h[5] * v;
    for (int c = 0; c < 3; c++)
        normal[c] = z[c] - du * x[c] - dv * y[c];
    crease_vector_normalise(normal);
    const double height = h[0] + h[1] * u + h[2] * v + h[3] * u * u + h[4] * u * v + h[5] * v * v;
    return crease_vector_dot(d, z) - height;
}

/* What speaks against taking a point's normal from this window: residual beyond what noise
 * explains, distance of its centre, distance of the point from it, and being narrow. */
static double reluctance(const estimate *run, const window *w, int count, const double at[3],
    double reach2, double normal[3])
{
    const bool bent = is_bent(w, count, run->sigma2);
    const double freedom = count - (bent ? TERMS : 3);
    const double excess = residual_variance(w, count, run->sigma2) / run->sigma2;
    const double height = above(w, bent, at, normal);
    const double off = height * height / run->sigma2;
    return fmax(excess, 1.0 + 2.0 * sqrt(2.0 / freedom)) +
        0.5 * crease_vector_dot(at, at) / reach2 + (off > 6.25 ? 0.2 * off : 0.0) +
        (count <= NARROW + 1 && run->wide > NARROW ? 1.5 : 0.0);
}

static void choose_normal(const estimate *run, size_t point, double reach2)
{
    const uint32_t *const near = crease_neighbours_of(run->neighbours, point);
    const double *const own = run->points + 3 * point;
    double least = INFINITY, normal[3], *const out = run->noise->normals + 3 * point;
    for (int j = 0; j <= run->wide; j++) {
        const size_t other = near[j];
        double at[3];
        for (int c = 0; c < 3; c++)
            at[c] = (own[c] - run->points[3 * other + (size_t)c]) / run->unit;
        for (int narrow = 0; narrow <= (j <= run->narrow); narrow++) {
            const window *const w = narrow ? &run->narrows[other] : &run->wides[other];
            const int count = 1 + (narrow ? run->narrow : run->wide);
            const double value = reluctance(run, w, count, at, reach2, normal);
            if (value < least) {
                least = value;
                memcpy(out, normal, sizeof normal);
            }
        }
    }
}

static void choose_normals(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const estimate *run = user;
    for (size_t i = begin; i < end; i++) {
        const double local = (double)run->noise->local_spacing[i] / run->unit;
        const double reach2 = local * local * run->wide / acos(-1.0) + 2.0 * run->sigma2;
        choose_normal(run, i, reach2);
        run->noise->scores[i] =
            (float)(residual_variance(&run->wides[i], run->wide + 1, run->sigma2) / run->sigma2);
    }
}

static crease_status allocate(crease_context *context, estimate *run)
{
    crease_noise *const noise = crease_allocate(context, 1, sizeof *noise);
    run->noise = noise;
    if (!noise)
        return CREASE_ERROR_NO_MEMORY;
    noise->count = run->count;
    noise->normals = crease_allocate(context, run->count, 3 * sizeof *noise->normals);
    noise->scores = crease_allocate(context, run->count, sizeof *noise->scores);
    noise->local_spacing = crease_allocate(context, run->count, sizeof *noise->local_spacing);
    run->wides = crease_allocate(context, run->count, sizeof *run->wides);
    run->narrows = crease_allocate(context, run->count, sizeof *run->narrows);
    run->values = crease_allocate(context, run->count, sizeof *run->values);
    return noise->normals && noise->scores && noise->local_spacing && run->wides && run->narrows &&
            run->values
        ? CREASE_OK
        : CREASE_ERROR_NO_MEMORY;
}

/* Refuses points that span no surface. The unit of length is about the spacing, whatever that is.
 */
static crease_status check_extent(crease_context *context, estimate *run)
{
    double mean[3], values[3], axes[9];
    crease_vector_main_axes(run->points, NULL, run->count, mean, values, axes);
    run->unit = sqrt(values[2] / (double)run->count);
    if (run->unit > 0.0 && isfinite(run->unit) && values[1] > thinnest * values[2])
        return CREASE_OK;
    return crease_fail(context, CREASE_ERROR_DEGENERATE,
        "noise: all %zu points lie %s; give points of a surface", run->count,
        run->unit > 0.0 ? "on one line" : "in one place");
}

/* The noise with the errors that neighbours share. Normals come from small windows, which do not
 * see these, and keep the variance of small windows. */
static crease_status find_sigma(crease_context *context, estimate *run)
{
    crease_noise *const noise = run->noise;
    crease_correlation shared = {.points = 1.0};
    noise->sigma = run->unit * sqrt(run->sigma2);
    const crease_status status = run->thin || noise->sigma > roughest * noise->spacing
        ? CREASE_OK
        : crease_correlation_estimate(context, run->points, run->count, noise->sigma * noise->sigma,
              noise->spacing, &shared);
    noise->sigma = fmax(noise->sigma, sqrt(shared.sigma2));
    noise->alike = run->terraced ? fmax(shared.points, terrace_points) : shared.points;
    return status;
}

static crease_status compute(crease_context *context, estimate *run)
{
    double spacing2 = 0.0;
    crease_status status = crease_parallel_for(context, run->count, GRAIN, fit_windows, run);
    if (status == CREASE_OK)
        status = find_scale(context, run, &spacing2);
    if (status != CREASE_OK)
        return status;
    if (!(spacing2 > 0.0))
        return crease_fail(context, CREASE_ERROR_DEGENERATE,
            "noise: nearly every point has %d others in the same place; remove doubled points",
            run->wide);
    run->sigma2 = fmax(run->sigma2, least_sigma * least_sigma * spacing2);
    run->noise->spacing = run->unit * sqrt(spacing2);
    status = find_sigma(context, run);
    return status != CREASE_OK
        ? status
        : crease_parallel_for(context, run->count, GRAIN, choose_normals, run);
}

static int at_most(int neighbours, int wanted)
{
    return neighbours < wanted ? neighbours : wanted;
}

crease_status crease_noise_estimate_from(crease_context *context, const double *points,
    const crease_neighbours *neighbours, crease_noise **out)
{
    *out = NULL;
    const int others = crease_neighbours_k(neighbours) - 1;
    estimate run = {.points = points,
        .neighbours = neighbours,
        .count = crease_neighbours_count(neighbours),
        .wide = at_most(others, WIDE),
        .narrow = at_most(others, NARROW),
        .tight = at_most(others, TIGHT)};
    crease_status status = check_extent(context, &run);
    if (status != CREASE_OK)
        return status;
    crease_stage(context, "noise");
    status = allocate(context, &run);
    if (status == CREASE_OK)
        status = compute(context, &run);
    free(run.wides);
    free(run.narrows);
    free(run.values);
    if (status == CREASE_OK)
        *out = run.noise;
    else
        crease_noise_free(run.noise);
    return status;
}

crease_status crease_noise_estimate(
    crease_context *context, const crease_cloud *cloud, crease_noise **out)
{
    *out = NULL;
    const size_t count = crease_cloud_count(cloud);
    if (count < 4)
        return crease_fail(context, CREASE_ERROR_TOO_FEW_POINTS,
            "noise: the cloud has %zu points; at least 4 are needed", count);
    crease_neighbours *neighbours = NULL;
    const int k = count < CREASE_NOISE_NEIGHBOURS ? (int)count : CREASE_NOISE_NEIGHBOURS;
    crease_status status = crease_neighbours_find(context, cloud, k, &neighbours);
    if (status == CREASE_OK)
        status = crease_noise_estimate_from(context, crease_cloud_points(cloud), neighbours, out);
    crease_neighbours_free(neighbours);
    return status;
}

void crease_noise_free(crease_noise *noise)
{
    if (!noise)
        return;
    free(noise->normals);
    free(noise->scores);
    free(noise->local_spacing);
    free(noise);
}

size_t crease_noise_count(const crease_noise *noise)
{
    return noise->count;
}

double crease_noise_spacing(const crease_noise *noise)
{
    return noise->spacing;
}

double crease_noise_sigma(const crease_noise *noise)
{
    return noise->sigma;
}

const double *crease_noise_normals(const crease_noise *noise)
{
    return noise->normals;
}
