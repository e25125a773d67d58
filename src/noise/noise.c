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
#include "noise/noise.h"

#include "base/memory.h"
#include "base/select.h"
#include "base/vector.h"
#include "noise/correlation.h"
#include "noise/windows.h"

#include <math.h>
#include <stdlib.h>

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

/* Numbers of all points, and what has been found from them. */
typedef struct survey {
    const crease_noise_source *source;
    size_t count;
    double *values; /* one for each point, in any order once looked at */
} survey;

static crease_status get(const survey *run, crease_noise_value which)
{
    return run->source->get(run->source->user, which, run->values);
}

/* Square spacing from the distances to the K-th neighbours: on a surface K points take the area
 * pi r_K^2 = K s^2. The noise of both points along the normal is taken out. */
static double squared_spacing(const survey *run, double points, double sigma2)
{
    const size_t kept = (size_t)fmax(trimmed * (double)run->count, 1.0);
    crease_select(run->values, run->count, kept - 1);
    double sum = 0.0;
    for (size_t i = 0; i < kept; i++)
        sum += run->values[i];
    return acos(-1.0) * fmax(sum / (double)kept - 2.0 * sigma2, 0.0) / points;
}

static double low_quantile(const survey *run)
{
    return crease_select(run->values, run->count, (size_t)(quantile * (double)run->count));
}

/* Whether most wide windows see both sides of a thin wall: they leave a good part of the spacing,
 * and nearly all planes through 8 neighbours far less. Where only some do, the points lie on
 * terraces or rows. *tight: variance of the noise by these planes. */
static bool is_thin(const survey *run, const crease_noise_scale *scale, double *tight)
{
    const double most = crease_select(run->values, run->count, run->count / 2) / tight_median;
    *tight = low_quantile(run) / tight_share;
    return most < 0.25 * scale->sigma2 &&
        scale->sigma2 > thin_residual * thin_residual * scale->spacing2;
}

/* Whether the points lie on terraces or rows, as rounded depths make them: many tight windows are
 * flat where wide ones are rough. */
static bool is_terraced(const survey *run, const crease_noise_scale *scale)
{
    const size_t rank = (size_t)(flat_share * (double)run->count);
    return crease_select(run->values, run->count, rank) < flat_variance * scale->sigma2 &&
        scale->sigma2 > 4.0 * least_sigma * least_sigma * scale->spacing2;
}

/* Sigma and spacing by the wide windows, or by the tight ones where walls are thin. */
static crease_status find_scale(
    const survey *run, crease_window_sizes sizes, crease_noise_scale *scale)
{
    crease_status status = get(run, CREASE_WIDE_VARIANCE);
    if (status != CREASE_OK)
        return status;
    scale->sigma2 = low_quantile(run) / wide_share;
    status = get(run, CREASE_WIDE_REACH);
    if (status != CREASE_OK)
        return status;
    scale->spacing2 = squared_spacing(run, sizes.wide, scale->sigma2);
    status = get(run, CREASE_TIGHT_VARIANCE);
    if (status != CREASE_OK)
        return status;
    double tight;
    scale->thin = is_thin(run, scale, &tight);
    scale->terraced = !scale->thin && is_terraced(run, scale);
    if (scale->thin) {
        status = get(run, CREASE_TIGHT_REACH);
        scale->sigma2 = tight;
        scale->spacing2 = squared_spacing(run, sizes.tight + 0.3, tight);
    }
    scale->raw_sigma2 = scale->sigma2;
    return status;
}

crease_status crease_noise_scale_find(crease_context *context, const crease_noise_source *source,
    size_t count, int k, crease_noise_scale *scale)
{
    survey run = {.source = source, .count = count};
    run.values = crease_allocate(context, count, sizeof *run.values);
    const crease_window_sizes sizes = crease_window_sizes_of(k);
    crease_status status = run.values ? find_scale(&run, sizes, scale) : CREASE_ERROR_NO_MEMORY;
    free(run.values);
    if (status != CREASE_OK)
        return status;
    if (!(scale->spacing2 > 0.0))
        return crease_fail(context, CREASE_ERROR_DEGENERATE,
            "noise: nearly every point has %d others in the same place; remove doubled points",
            sizes.wide);
    scale->sigma2 = fmax(scale->sigma2, least_sigma * least_sigma * scale->spacing2);
    return CREASE_OK;
}

crease_status crease_noise_create(crease_context *context, size_t count, crease_noise **out)
{
    crease_noise *const noise = crease_allocate(context, 1, sizeof *noise);
    *out = NULL;
    if (!noise)
        return CREASE_ERROR_NO_MEMORY;
    noise->count = count;
    noise->normals = crease_allocate(context, count, 3 * sizeof *noise->normals);
    noise->scores = crease_allocate(context, count, sizeof *noise->scores);
    noise->local_spacing = crease_allocate(context, count, sizeof *noise->local_spacing);
    if (!noise->normals || !noise->scores || !noise->local_spacing) {
        crease_noise_free(noise);
        return CREASE_ERROR_NO_MEMORY;
    }
    *out = noise;
    return CREASE_OK;
}

/* Refuses points that span no surface. */
crease_status crease_noise_measure(
    crease_context *context, const double *points, size_t count, crease_noise_scale *scale)
{
    double mean[3], values[3], axes[9];
    *scale = (crease_noise_scale){0};
    crease_vector_main_axes(points, NULL, count, mean, values, axes);
    scale->unit = sqrt(values[2] / (double)count);
    if (scale->unit > 0.0 && isfinite(scale->unit) && values[1] > thinnest * values[2])
        return CREASE_OK;
    return crease_fail(context, CREASE_ERROR_DEGENERATE,
        "noise: all %zu points lie %s; give points of a surface", count,
        scale->unit > 0.0 ? "on one line" : "in one place");
}

/* The noise with the errors that neighbours share. Normals come from small windows, which do not
 * see these, and keep the variance of small windows. */
crease_status crease_noise_judge(crease_context *context, const double *points,
    const crease_noise_scale *scale, crease_noise *noise)
{
    crease_correlation shared = {.points = 1.0};
    noise->spacing = scale->unit * sqrt(scale->spacing2);
    noise->sigma = scale->unit * sqrt(scale->sigma2);
    const crease_status status = scale->thin || noise->sigma > roughest * noise->spacing
        ? CREASE_OK
        : crease_correlation_estimate(
              context, points, noise->count, noise->sigma * noise->sigma, noise->spacing, &shared);
    noise->sigma = fmax(noise->sigma, sqrt(shared.sigma2));
    noise->alike = scale->terraced ? fmax(shared.points, terrace_points) : shared.points;
    return status;
}

/* ------------------------------------------------------------------------- the whole cloud -- */

typedef struct estimate {
    crease_context *context;
    crease_windows windows;
} estimate;

static crease_status get_here(void *user, crease_noise_value which, double *values)
{
    const estimate *const run = user;
    return crease_windows_values(run->context, &run->windows, which, values);
}

static crease_status compute(estimate *run, crease_noise_scale *scale, crease_noise *noise)
{
    const crease_noise_source source = {get_here, run};
    const crease_windows *const windows = &run->windows;
    crease_status status = crease_windows_fit(run->context, windows);
    if (status == CREASE_OK)
        status = crease_noise_scale_find(
            run->context, &source, noise->count, crease_neighbours_k(windows->neighbours), scale);
    if (status == CREASE_OK)
        status = crease_noise_judge(run->context, windows->points, scale, noise);
    return status == CREASE_OK ? crease_windows_describe(run->context, windows, scale, noise)
                               : status;
}

crease_status crease_noise_estimate_from(crease_context *context, const double *points,
    const crease_neighbours *neighbours, crease_noise **out)
{
    *out = NULL;
    const size_t count = crease_neighbours_count(neighbours);
    crease_noise *noise = NULL;
    crease_noise_scale scale;
    crease_status status = crease_noise_measure(context, points, count, &scale);
    if (status != CREASE_OK)
        return status;
    crease_stage(context, "noise");
    estimate run = {.context = context,
        .windows = {.points = points, .neighbours = neighbours, .end = count, .unit = scale.unit}};
    status = crease_noise_create(context, count, &noise);
    if (status == CREASE_OK)
        status = crease_windows_create(context, &run.windows);
    if (status == CREASE_OK)
        status = compute(&run, &scale, noise);
    crease_windows_free(&run.windows);
    if (status == CREASE_OK)
        *out = noise;
    else
        crease_noise_free(noise);
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
