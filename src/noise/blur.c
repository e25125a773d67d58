/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A quadric is fitted to each point and its 48 nearest neighbours, a window 8 spacings wide. It
 * cannot follow a sharp edge: along one it leaves far more than elsewhere. Where it bends fast and
 * yet leaves no more than on flat ground, the edge is rounded over about the width of the window.
 * When that is so at nearly all places that bend fast, the scanner did it, not the part. */
#include "noise/blur.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "base/select.h"
#include "noise/quadric.h"
#include "space/nearest.h"

#include <math.h>
#include <stdlib.h>

enum { WINDOW = 49, VOTERS = 9, GRAIN = 256 };

static const double least_turn = 0.10;  /* radians that the surface turns within a spacing */
static const double quantile = 0.9;     /* of the residuals of one kind of windows */
static const double rough = 2.0;        /* ratio of these quantiles that sharp edges leave */
static const double least_share = 0.05; /* of the windows that turn: noise makes some do so */
static const double most_share = 0.5;

typedef struct survey {
    const double *points;
    const crease_tree *tree;
    double spacing;
    float *turns, *residuals; /* at each point: curvature times spacing; root mean square */
    uint8_t *bent;
} survey;

static void nearest(const survey *run, size_t point, int count, uint32_t *out)
{
    double squares[WINDOW];
    crease_tree_nearest_place(
        run->tree, run->points + 3 * point, CREASE_NO_POSITION, count, out, squares);
    for (int j = 0; j < count; j++)
        out[j] = run->tree->index[out[j]];
}

/* The greater principal curvature of the quadric, slopes neglected. */
static double curvature(const double *height, double scale)
{
    const double mean = height[3] + height[5], apart = height[3] - height[5];
    return (fabs(mean) + sqrt(apart * apart + height[4] * height[4])) / (scale * scale);
}

static void fit_windows(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const survey *const run = user;
    uint32_t near[WINDOW];
    double points[WINDOW][3], centre[3], values[3], axes[9], height[CREASE_QUADRIC_TERMS];
    for (size_t i = begin; i < end; i++) {
        nearest(run, i, WINDOW, near);
        for (int j = 0; j < WINDOW; j++)
            for (size_t c = 0; c < 3; c++)
                points[j][c] = run->points[3 * (size_t)near[j] + c] - run->points[3 * i + c];
        crease_quadric_plane(points, WINDOW, centre, values, axes);
        const double scale = sqrt(values[2] / WINDOW);
        const double squares =
            scale > 0.0 ? crease_quadric_fit(points, WINDOW, axes, scale, height) : -1.0;
        run->turns[i] = squares < 0.0 ? 0.0F : (float)(curvature(height, scale) * run->spacing);
        run->residuals[i] = (float)sqrt(fmax(squares, 0.0) / (WINDOW - CREASE_QUADRIC_TERMS));
    }
}

/* A point is on a rounded edge where most of its neighbours turn. */
static void vote(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const survey *const run = user;
    uint32_t near[VOTERS];
    for (size_t i = begin; i < end; i++) {
        int votes = 0;
        nearest(run, i, VOTERS, near);
        for (int j = 0; j < VOTERS; j++)
            votes += (double)run->turns[near[j]] > least_turn;
        run->bent[i] = 2 * votes > VOTERS;
    }
}

/* The quantile of the residuals of the windows that turn, or of those that do not. */
static double residual_of(const survey *run, size_t count, bool turning, double *values, size_t *of)
{
    *of = 0;
    for (size_t i = 0; i < count; i++)
        if (((double)run->turns[i] > least_turn) == turning)
            values[(*of)++] = (double)run->residuals[i];
    return *of ? crease_select(values, *of, (size_t)(quantile * (double)*of)) : 0.0;
}

static bool is_blurred(const survey *run, size_t count, double *values)
{
    size_t turning, flat;
    const double there = residual_of(run, count, true, values, &turning);
    const double elsewhere = residual_of(run, count, false, values, &flat);
    const double share = (double)turning / (double)(turning + flat);
    return share > least_share && share < most_share && there < rough * elsewhere;
}

static crease_status find(crease_context *context, survey *run, size_t count, bool *blurred)
{
    double *const values = crease_allocate(context, count, sizeof *values);
    run->turns = crease_allocate(context, count, sizeof *run->turns);
    run->residuals = crease_allocate(context, count, sizeof *run->residuals);
    crease_status status = CREASE_ERROR_NO_MEMORY;
    if (values && run->turns && run->residuals)
        status = crease_parallel_for(context, count, GRAIN, fit_windows, run);
    if (status == CREASE_OK)
        *blurred = is_blurred(run, count, values);
    if (status == CREASE_OK && *blurred)
        status = crease_parallel_for(context, count, GRAIN, vote, run);
    free(values);
    free(run->turns);
    free(run->residuals);
    return status;
}

crease_status crease_blur_find(crease_context *context, const double *points, size_t count,
    const crease_noise *noise, bool *blurred, uint8_t *bent)
{
    crease_tree *tree = NULL;
    *blurred = false;
    if (!(noise->alike > 1.0) || count < 8 * (size_t)WINDOW)
        return CREASE_OK;
    crease_status status = crease_tree_create(context, points, count, &tree);
    survey run = {.points = points, .tree = tree, .spacing = noise->spacing, .bent = bent};
    if (status == CREASE_OK)
        status = find(context, &run, count, blurred);
    crease_tree_free(tree);
    return status;
}
