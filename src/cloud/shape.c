/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Clouds that the project makes itself, for examples, figures, tests and benchmarks: the cube of
 * the paper, the samples around one of its edges with the paper's noise, and a panel as a scanner
 * would see it. Every random number is a function of the context's seed. */
#include "cloud/shape.h"

#include "base/memory.h"
#include "base/random.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STREAM_CHOICE = 0x5a01, STREAM_MOVE = 0x5a02, STREAM_PANEL = 0x5a03 };

static const double HALF_ROOT = 0.70710678118654752440;

static crease_status make_cloud(
    crease_context *context, const double *points, size_t count, crease_cloud **out)
{
    const crease_cloud_parts parts = {
        .count = count, .points = points, .coordinate_type = CREASE_TYPE_FLOAT64};
    return crease_cloud_create(context, &parts, out);
}

crease_status crease_shape_cube(crease_context *context, int intervals, crease_cloud **out)
{
    *out = NULL;
    if (intervals < 1 || intervals > 8192)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "cube: %d intervals along an edge; give 1 to 8192", intervals);
    const size_t n = (size_t)intervals;
    double *points = crease_allocate(context, 6 * n * n + 2, 3 * sizeof *points);
    if (!points)
        return CREASE_ERROR_NO_MEMORY;
    size_t count = 0;
    for (size_t i = 0; i <= n; i++)
        for (size_t j = 0; j <= n; j++) {
            const bool inside = i % n != 0 && j % n != 0;
            for (size_t k = 0; k <= n; k += inside ? n : 1) {
                points[3 * count] = (double)i / (double)n;
                points[3 * count + 1] = (double)j / (double)n;
                points[3 * count++ + 2] = (double)k / (double)n;
            }
        }
    const crease_status status = make_cloud(context, points, count, out);
    free(points);
    return status;
}

crease_sample_options crease_sample_options_default(void)
{
    return (crease_sample_options){
        .across = 17, .along = 3, .roof = true, .spacing = 0.03125, .moved = 13};
}

static crease_status check_sample(crease_context *context, const crease_sample_options *options)
{
    if (options->across < 2 || options->along < 1 || options->across > 10000 ||
        options->along > 10000)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "sample: %d x %d points; give 2 to 10000 across the edge and 1 to 10000 along it",
            options->across, options->along);
    if (options->moved < 0 || options->moved > options->across * options->along)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "sample: %d points to move; give 0 to %d", options->moved,
            options->across * options->along);
    if (!(options->spacing > 0.0) || !(options->noise >= 0.0) || !isfinite(options->spacing) ||
        !isfinite(options->noise) || !isfinite(options->shift))
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "sample: spacing %g, noise %g, shift %g; the spacing must be positive, the noise not "
            "negative, all of them finite",
            options->spacing, options->noise, options->shift);
    return CREASE_OK;
}

crease_roof crease_shape_sample_truth(const crease_sample_options *options)
{
    const double half = 0.5 * (options->across - 1), h = options->spacing;
    crease_roof roof = {.direction = {0, 1, 0},
        .across = {(half - options->shift) * h, (half + options->shift) * h},
        .along = {-0.5 * (options->along - 1) * h, 0.5 * (options->along - 1) * h}};
    const double flat[3][3] = {{1, 0.5, 1}, {-1, 0, 0}, {0, 0, -1}};
    const double turned[3][3] = {
        {0, 0.5, 0}, {-HALF_ROOT, 0, -HALF_ROOT}, {HALF_ROOT, 0, -HALF_ROOT}};
    const double(*const from)[3] = options->roof ? turned : flat;
    memcpy(roof.edge, from[0], sizeof roof.edge);
    memcpy(roof.inward, from[1], sizeof roof.inward);
    return roof;
}

/* Moves `moved` points, chosen without repetition, along z. */
static void add_noise(uint64_t seed, const crease_sample_options *options, double *points,
    uint32_t *order, uint32_t count)
{
    const uint64_t first = options->variant << 32;
    for (uint32_t i = 0; i < count; i++)
        order[i] = i;
    for (uint32_t i = 0; i < (uint32_t)options->moved; i++) {
        const uint32_t other = i + crease_random_below(seed, STREAM_CHOICE, first + i, count - i);
        const uint32_t chosen = order[other];
        order[other] = order[i];
        points[3 * chosen + 2] +=
            options->noise * options->spacing * crease_random_normal(seed, STREAM_MOVE, first + i);
    }
}

static void place_sample(const crease_sample_options *options, double *points)
{
    const crease_roof roof = crease_shape_sample_truth(options);
    for (int j = 0; j < options->along; j++)
        for (int i = 0; i < options->across; i++, points += 3) {
            const double a = (i - 0.5 * (options->across - 1) + options->shift) * options->spacing;
            const double y = roof.along[0] + j * options->spacing;
            for (int c = 0; c < 3; c++)
                points[c] = roof.edge[c] + y * roof.direction[c] + fabs(a) * roof.inward[a > 0][c];
        }
}

crease_status crease_shape_sample(
    crease_context *context, const crease_sample_options *options, crease_cloud **out)
{
    *out = NULL;
    const crease_sample_options chosen = options ? *options : crease_sample_options_default();
    crease_status status = check_sample(context, &chosen);
    if (status != CREASE_OK)
        return status;
    const size_t count = (size_t)chosen.across * (size_t)chosen.along;
    double *points = crease_allocate(context, count, 3 * sizeof *points);
    uint32_t *order = crease_allocate(context, count, sizeof *order);
    status = points && order ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK) {
        place_sample(&chosen, points);
        if (chosen.noise > 0.0)
            add_noise(crease_context_seed(context), &chosen, points, order, (uint32_t)count);
        status = make_cloud(context, points, count, out);
    }
    free(points);
    free(order);
    return status;
}

/* ------------------------------------------------------------------------------------- panel -- */

static const double PANEL_WIDTH = 0.4, PANEL_LENGTH = 0.6; /* of one face across, of the crease */
static const double PANEL_SLOPE = 0.6, PANEL_SAG = 0.25;

/* The panel in its own frame: the crease runs along y, both faces fall away from it and sag. */
static void panel_point(double x, double y, double point[3])
{
    point[0] = x;
    point[1] = y;
    point[2] = -PANEL_SLOPE * fabs(x) + PANEL_SAG * x * x + 0.1 * y * y;
}

/* Turns by 30 degrees about z, then by 20 degrees about x, and moves the panel where a scanner's
 * origin would leave it. */
static void place_panel(double point[3])
{
    const double c = 0.86602540378443864676, s = 0.5;
    const double d = 0.93969262078590838405, t = 0.34202014332566873304;
    const double x = c * point[0] - s * point[1], y = s * point[0] + c * point[1];
    const double z = point[2];
    point[0] = 1.5 + x;
    point[1] = -0.5 + d * y - t * z;
    point[2] = 0.8 + t * y + d * z;
}

crease_panel_options crease_panel_options_default(void)
{
    return (crease_panel_options){.count = 20000, .noise = 0.2, .outliers = 0.005};
}

static void fill_panel(uint64_t seed, const crease_panel_options *options, double *points)
{
    const double spacing = sqrt(2.0 * PANEL_WIDTH * PANEL_LENGTH / (double)options->count);
    for (size_t i = 0; i < options->count; i++) {
        const uint64_t draw = 8 * i;
        double *const p = points + 3 * i;
        const double u = crease_random_uniform(seed, STREAM_PANEL, draw);
        const double v = crease_random_uniform(seed, STREAM_PANEL, draw + 1);
        panel_point((2.0 * u - 1.0) * PANEL_WIDTH, (v - 0.5) * PANEL_LENGTH, p);
        if (crease_random_uniform(seed, STREAM_PANEL, draw + 2) < options->outliers)
            p[2] += (crease_random_uniform(seed, STREAM_PANEL, draw + 3) - 0.5) * PANEL_WIDTH;
        for (uint64_t c = 0; c < 3; c++)
            p[c] +=
                options->noise * spacing * crease_random_normal(seed, STREAM_PANEL + 1, draw + c);
        place_panel(p);
    }
}

crease_status crease_shape_panel(
    crease_context *context, const crease_panel_options *options, crease_cloud **out)
{
    *out = NULL;
    const crease_panel_options chosen = options ? *options : crease_panel_options_default();
    if (chosen.count < 4 || chosen.count > UINT32_MAX || !(chosen.noise >= 0.0) ||
        !isfinite(chosen.noise) || !(chosen.outliers >= 0.0 && chosen.outliers <= 1.0))
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "panel: %zu points, noise %g, outliers %g; give at least 4 points, a noise that is not "
            "negative, and a share of outliers from 0 to 1",
            chosen.count, chosen.noise, chosen.outliers);
    double *points = crease_allocate(context, chosen.count, 3 * sizeof *points);
    if (!points)
        return CREASE_ERROR_NO_MEMORY;
    fill_panel(crease_context_seed(context), &chosen, points);
    const crease_status status = make_cloud(context, points, chosen.count, out);
    free(points);
    return status;
}

void crease_shape_panel_point(double across, double along, double point[3])
{
    panel_point(across, along, point);
    place_panel(point);
}
