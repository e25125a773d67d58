/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The pre-process of a noisy cloud: outliers are set aside, then every other point is moved onto
 * the surface that the points on its own side of any edge suggest (footing.h).
 *
 * A point is an outlier when it is further from that surface than noise explains, or far from
 * everything: its mean distance to its nearest neighbours is several times that of theirs.
 *
 * Based on: Breunig, Kriegel, Ng, Sander. LOF: identifying density-based local outliers. 2000 (the
 * comparison with the neighbours' own distances). */
#include "base/memory.h"
#include "base/parallel.h"
#include "base/select.h"
#include "base/vector.h"
#include "cloud/cloud.h"
#include "noise/bilateral.h"
#include "noise/footing.h"
#include "noise/noise.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    NEIGHBOURS = 64,
    PASSES = 1,
    MOST_PASSES = 10,
    SMOOTHINGS = 2, /* of the normals */
    NEAREST = 8,    /* whose distances tell an isolated point, and whose normals are tried */
    GRAIN = 256
};

static const double outlier_sigmas = 5.0;
static const double doubtful_sigmas = 2.5; /* further away than this other sides are tried */
static const double isolated = 3.0;        /* mean distance over what is usual around the point */
static const double crowded = 1.25;       /* the same up to which a point is no outlier: whatever is
                                             off the surface has its neighbours further away */
static const double apart = 1.5;          /* the same for a point that no surface passes by */
static const double least_distance = 0.5; /* of an outlier from the surface, in spacings */
static const double turn = 14.0;          /* degrees between normals of one side, on top of twice
                                             their error */

static const double wide_turn = 35.0; /* the same where the surface is strongly curved */
static const double degree = 0.017453292519943295;

struct crease_filtered {
    size_t count; /* points of the input */
    crease_cloud *cloud;
    uint8_t *outliers; /* by point of the input */
    size_t outlier_count;
    double spacing, sigma, sigma_after, movement;
};

typedef struct filtering {
    const crease_cloud *cloud;
    crease_filter_options options;
    crease_filtered *result;
    size_t count;
    crease_neighbours *neighbours;
    crease_surroundings around;
    double wide_cosine;              /* the least cosine of around where that finds too few */
    double *points, *moved;          /* before and after a pass */
    double *normals, *other_normals; /* smoothed in turn */
    float *distances;                /* mean distance to the nearest */
    uint8_t *flags;                  /* outliers as they are found */
} filtering;

crease_filter_options crease_filter_options_default(void)
{
    return (crease_filter_options){
        .neighbours = NEIGHBOURS, .passes = PASSES, .outlier_sigmas = outlier_sigmas};
}

/* --------------------------------------------------------------------------------- outliers -- */

static void measure_distances(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const filtering *run = user;
    const int k = crease_neighbours_k(run->neighbours), last = k <= NEAREST ? k - 1 : NEAREST;
    for (size_t i = begin; i < end; i++) {
        const uint32_t *const near = crease_neighbours_of(run->neighbours, i);
        double sum = 0;
        for (int j = 1; j <= last; j++)
            sum += crease_vector_distance(run->points + 3 * i, run->points + 3 * (size_t)near[j]);
        run->distances[i] = (float)(sum / last);
    }
}

/* The mean distance to the nearest neighbours over what is usual around the point: a low quantile,
 * for outliers have other outliers among their neighbours. */
static double isolation_of(const filtering *run, size_t point)
{
    const int k = crease_neighbours_k(run->neighbours);
    const uint32_t *const near = crease_neighbours_of(run->neighbours, point);
    double theirs[CREASE_MOST_FOOTING];
    for (int j = 0; j < k; j++)
        theirs[j] = (double)run->distances[near[j]];
    const double usual = crease_select(theirs, (size_t)k, (size_t)k / 4);
    return (double)run->distances[point] / (usual + run->around.sigma);
}

static double deviation(const crease_footing *footing)
{
    return fabs(footing->distance) / hypot(footing->sigma, footing->error);
}

/* Takes another surface where it is the first one, or closer to the point. */
static bool try_footing(const crease_surroundings *around, size_t point, const double normal[3],
    bool found, crease_footing *best)
{
    crease_footing other;
    if (!crease_footing_fit(around, point, normal, &other))
        return found;
    if (!found || deviation(&other) < deviation(best))
        *best = other;
    return true;
}

/* The surface on the side of the point's own normal. Where there is none, or the point is far from
 * it: the one it is closest to among those of the nearest neighbours' normals and, where the
 * surface may be too curved for the usual angles of normals, of its own with wider ones. */
static bool best_footing(const filtering *run, size_t point, crease_footing *out)
{
    const uint32_t *const near = crease_neighbours_of(run->neighbours, point);
    const int k = crease_neighbours_k(run->neighbours);
    const double *const normals = run->around.normals;
    bool found = try_footing(&run->around, point, normals + 3 * point, false, out);
    for (int j = 1; j < k && j <= NEAREST && !(found && deviation(out) < doubtful_sigmas); j++)
        found = try_footing(&run->around, point, normals + 3 * (size_t)near[j], found, out);
    if (found && deviation(out) < doubtful_sigmas)
        return true;
    crease_surroundings wide = run->around;
    wide.least_cosine = run->wide_cosine;
    return try_footing(&wide, point, normals + 3 * point, found, out);
}

static bool is_outlier(const filtering *run, size_t point)
{
    crease_footing footing;
    const double isolation = isolation_of(run, point);
    if (isolation > isolated || isolation < crowded)
        return isolation > isolated;
    if (!best_footing(run, point, &footing))
        return isolation > apart;
    return fabs(footing.distance) > least_distance * run->around.spacing &&
        deviation(&footing) > run->options.outlier_sigmas;
}

static void find_outliers(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const filtering *run = user;
    for (size_t i = begin; i < end; i++)
        run->flags[i] = is_outlier(run, i);
}

/* ---------------------------------------------------------------------------------- moving -- */

static void move_points(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const filtering *run = user;
    for (size_t i = begin; i < end; i++) {
        crease_footing footing;
        const bool moves = !run->flags[i] && best_footing(run, i, &footing) &&
            deviation(&footing) <= run->options.outlier_sigmas;
        memcpy(run->moved + 3 * i, moves ? footing.foot : run->points + 3 * i, sizeof footing.foot);
    }
}

/* Makes the normals of the windows those of bilateral means. */
static crease_status smooth_normals(crease_context *context, filtering *run)
{
    crease_status status = CREASE_OK;
    const crease_bilateral bilateral = {run->points, run->neighbours, run->around.least_cosine};
    for (int i = 0; i < SMOOTHINGS && status == CREASE_OK; i++) {
        double *const from = run->normals;
        status = crease_bilateral_smooth(context, &bilateral, from, run->other_normals);
        run->normals = run->other_normals;
        run->other_normals = from;
    }
    run->around.normals = run->normals;
    return status;
}

static crease_status move(crease_context *context, filtering *run)
{
    crease_status status = CREASE_OK;
    for (int pass = 0; pass < run->options.passes && status == CREASE_OK; pass++) {
        status = crease_parallel_for(context, run->count, GRAIN, move_points, run);
        double *const from = run->points;
        run->points = run->moved;
        run->moved = from;
        run->around.points = run->points;
    }
    return status;
}

/* --------------------------------------------------------------------------------- the line -- */

static crease_status prepare(crease_context *context, filtering *run)
{
    const crease_cloud *const cloud = run->cloud;
    const size_t count = run->count;
    crease_noise *noise = NULL;
    const int wanted = run->options.neighbours, k = count < (size_t)wanted ? (int)count : wanted;
    crease_status status = crease_neighbours_find(context, cloud, k, &run->neighbours);
    if (status == CREASE_OK)
        status = crease_noise_estimate_from(context, cloud->points, run->neighbours, &noise);
    if (status != CREASE_OK)
        return status;
    run->result->spacing = noise->spacing;
    run->result->sigma = run->options.sigma > 0 ? run->options.sigma : noise->sigma;
    const double error = run->result->sigma / (6.8 * noise->spacing);
    run->points = crease_duplicate(context, cloud->points, 3 * count, sizeof *run->points);
    run->normals = crease_duplicate(context, noise->normals, 3 * count, sizeof *run->normals);
    crease_noise_free(noise);
    run->moved = crease_allocate(context, count, 3 * sizeof *run->moved);
    run->other_normals = crease_allocate(context, count, 3 * sizeof *run->other_normals);
    run->distances = crease_allocate(context, count, sizeof *run->distances);
    run->flags = crease_allocate(context, count, sizeof *run->flags);
    run->around = (crease_surroundings){.points = run->points,
        .normals = run->normals,
        .neighbours = run->neighbours,
        .spacing = run->result->spacing,
        .sigma = run->result->sigma,
        .least_cosine = cos(fmin(turn * degree + 2 * error, 1.0))};
    run->wide_cosine = cos(fmin(wide_turn * degree + 2 * error, 1.2));
    return run->points && run->normals && run->moved && run->other_normals && run->distances &&
            run->flags
        ? CREASE_OK
        : CREASE_ERROR_NO_MEMORY;
}

static crease_status work(crease_context *context, filtering *run)
{
    crease_stage(context, "filter");
    crease_status status = smooth_normals(context, run);
    if (status == CREASE_OK)
        status = crease_parallel_for(context, run->count, GRAIN, measure_distances, run);
    if (status == CREASE_OK)
        status = crease_parallel_for(context, run->count, GRAIN, find_outliers, run);
    run->around.outliers = run->flags;
    return status == CREASE_OK ? move(context, run) : status;
}

/* ---------------------------------------------------------------------------------- result -- */

static crease_status keep_all(crease_context *context, const filtering *run, crease_cloud **out)
{
    const crease_cloud *const cloud = run->cloud;
    const crease_field outlier = {"outlier", CREASE_TYPE_UINT8, run->flags};
    const crease_cloud_parts parts = {.count = run->count,
        .points = run->points,
        .normals = cloud->normals,
        .fields = cloud->fields,
        .field_count = cloud->field_count,
        .coordinate_type = cloud->coordinate_type};
    crease_cloud *moved = NULL;
    crease_status status = crease_cloud_create(context, &parts, &moved);
    if (status == CREASE_OK)
        status = crease_cloud_with_fields(context, moved, &outlier, 1, out);
    crease_cloud_free(moved);
    return status;
}

/* The rows of those points that are no outliers. */
static void *kept_rows(crease_context *context, const filtering *run, const void *rows, size_t size)
{
    char *const kept = crease_allocate(context, run->count, size);
    size_t next = 0;
    for (size_t i = 0; i < run->count && kept; i++)
        if (!run->flags[i])
            memcpy(kept + size * next++, (const char *)rows + size * i, size);
    return kept;
}

static crease_status keep_rows(
    crease_context *context, const filtering *run, crease_cloud_parts *parts, crease_field *fields)
{
    const crease_cloud *const cloud = run->cloud;
    parts->points = kept_rows(context, run, run->points, 3 * sizeof *run->points);
    if (!parts->points)
        return CREASE_ERROR_NO_MEMORY;
    if (cloud->normals)
        parts->normals = kept_rows(context, run, cloud->normals, 3 * sizeof *cloud->normals);
    if (cloud->normals && !parts->normals)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t f = 0; f < cloud->field_count; f++) {
        const crease_field from = cloud->fields[f];
        fields[f] = from;
        fields[f].values = kept_rows(context, run, from.values, crease_type_size(from.type));
        parts->field_count++;
        if (!fields[f].values)
            return CREASE_ERROR_NO_MEMORY;
    }
    return CREASE_OK;
}

static crease_status leave_out(crease_context *context, const filtering *run, crease_cloud **out)
{
    crease_field *const fields = crease_allocate(context, run->cloud->field_count, sizeof *fields);
    if (!fields)
        return CREASE_ERROR_NO_MEMORY;
    crease_cloud_parts parts = {.count = run->count - run->result->outlier_count,
        .fields = fields,
        .coordinate_type = run->cloud->coordinate_type};
    crease_status status = keep_rows(context, run, &parts, fields);
    if (status == CREASE_OK)
        status = crease_cloud_create(context, &parts, out);
    for (size_t f = 0; f < parts.field_count; f++)
        free((void *)(uintptr_t)fields[f].values);
    free((void *)(uintptr_t)parts.points);
    free((void *)(uintptr_t)parts.normals);
    free(fields);
    return status;
}

/* What is left of the noise, and how far points were moved. */
static crease_status tell(crease_context *context, const filtering *run)
{
    crease_filtered *const result = run->result;
    crease_noise *noise = NULL;
    double sum = 0;
    const crease_status status =
        crease_noise_estimate_from(context, run->points, run->neighbours, &noise);
    if (status != CREASE_OK)
        return status;
    result->sigma_after = noise->sigma;
    crease_noise_free(noise);
    for (size_t i = 0; i < run->count; i++) {
        const double d = crease_vector_distance(run->points + 3 * i, run->cloud->points + 3 * i);
        sum += d * d;
        result->outlier_count += run->flags[i];
    }
    result->movement = sqrt(sum / (double)run->count);
    return CREASE_OK;
}

static crease_status finish(crease_context *context, filtering *run)
{
    crease_status status = tell(context, run);
    if (status == CREASE_OK)
        status = run->options.remove_outliers ? leave_out(context, run, &run->result->cloud)
                                              : keep_all(context, run, &run->result->cloud);
    run->result->outliers = run->flags;
    run->flags = NULL;
    return status;
}

static crease_status check(
    crease_context *context, size_t count, const crease_filter_options *options)
{
    if (options->neighbours < CREASE_NOISE_NEIGHBOURS || options->neighbours > CREASE_MOST_FOOTING)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "filter: %d neighbours asked for; take %d to %d", options->neighbours,
            CREASE_NOISE_NEIGHBOURS, CREASE_MOST_FOOTING);
    if (options->passes < 0 || options->passes > MOST_PASSES)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "filter: %d passes asked for; take 0 to %d", options->passes, MOST_PASSES);
    if (!(options->outlier_sigmas > 0))
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "filter: outliers cannot begin at %g times the noise; take a number above 0",
            options->outlier_sigmas);
    if (!(options->sigma >= 0 && isfinite(options->sigma)))
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "filter: a noise of %g is no length; take 0 to have it estimated", options->sigma);
    if (count < 4)
        return crease_fail(context, CREASE_ERROR_TOO_FEW_POINTS,
            "filter: the cloud has %zu points; at least 4 are needed", count);
    return CREASE_OK;
}

crease_status crease_cloud_filter(crease_context *context, const crease_cloud *cloud,
    const crease_filter_options *options, crease_filtered **out)
{
    *out = NULL;
    filtering run = {.cloud = cloud,
        .options = options ? *options : crease_filter_options_default(),
        .count = crease_cloud_count(cloud)};
    crease_status status = check(context, run.count, &run.options);
    if (status != CREASE_OK)
        return status;
    run.result = crease_allocate(context, 1, sizeof *run.result);
    if (!run.result)
        return CREASE_ERROR_NO_MEMORY;
    run.result->count = run.count;
    status = prepare(context, &run);
    if (status == CREASE_OK)
        status = work(context, &run);
    if (status == CREASE_OK)
        status = finish(context, &run);
    crease_neighbours_free(run.neighbours);
    free(run.points);
    free(run.moved);
    free(run.normals);
    free(run.other_normals);
    free(run.distances);
    free(run.flags);
    if (status == CREASE_OK)
        *out = run.result;
    else
        crease_filtered_free(run.result);
    return status;
}

void crease_filtered_free(crease_filtered *filtered)
{
    if (!filtered)
        return;
    crease_cloud_free(filtered->cloud);
    free(filtered->outliers);
    free(filtered);
}

const crease_cloud *crease_filtered_cloud(const crease_filtered *filtered)
{
    return filtered->cloud;
}

const uint8_t *crease_filtered_outliers(const crease_filtered *filtered)
{
    return filtered->outliers;
}

size_t crease_filtered_outlier_count(const crease_filtered *filtered)
{
    return filtered->outlier_count;
}

double crease_filtered_spacing(const crease_filtered *filtered)
{
    return filtered->spacing;
}

double crease_filtered_sigma(const crease_filtered *filtered)
{
    return filtered->sigma;
}

double crease_filtered_sigma_after(const crease_filtered *filtered)
{
    return filtered->sigma_after;
}

double crease_filtered_movement(const crease_filtered *filtered)
{
    return filtered->movement;
}
