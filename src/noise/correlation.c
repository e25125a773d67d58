/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Noise that neighbouring points share, as scanners have it along their lines and depth cameras on
 * their terraces. A quadric through a small window follows it, and what it leaves says too little
 * of it. So quadrics are fitted to growing windows around some of the points:
 *
 * - Independent noise leaves the same variance at every size.
 * - Shared noise leaves more and more, but ever less is added, once the windows are larger than the
 *   stretches that err alike.
 * - A surface that is no quadric leaves more and more too, but ever more is added: the cubic terms
 *   alone eight times as much whenever the number of points doubles.
 * - Edges raise the windows that lie across them. Where most of the larger ones do, those that
 *   leave least still lie inside faces and leave what they left before, but not of shared noise.
 * - The other side of a thin wall comes at once, and leaves what no noise leaves. Where heights
 * over the smallest window's plane have a gap, the window sees it and says nothing.
 *
 * Where the variance grows from the first size to the second, and then at a falling rate, the last
 * such size tells the noise. How many points err alike follows from what a fit takes out of the
 * mean square of the residuals: each of its p parameters a share of (points alike) / (points). */
#include "noise/correlation.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "base/select.h"
#include "base/vector.h"
#include "noise/quadric.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WINDOWS = 500, SIZES = 4, LEAST = 24, MOST = LEAST << (SIZES - 1), GRAIN = 16 };

/* A quantile of the variances of windows of one size, and of a normal distribution. */
struct quantile {
    double share, deviate;
};
static const struct quantile typical = {0.3, -0.5244}, least = {0.05, -1.6449};
static const double growing = 1.3;   /* least ratio of the variances of the first two sizes */
static const double lasting = 3.0;   /* most added by twice the size, over what was added so far */
static const double at_once = 8.0;   /* more than the eightfold comes of no smooth surface ... */
static const double roughest = 0.4;  /* ... and a greater deviation, in spacings, of no noise */
static const double gap = 1.5;       /* spacings between heights that no one surface leaves empty */
static const double own_share = 0.6; /* of the points of a window, at least, on its middle's wall */
static const double widest = 0.25;   /* of all points in one window */

typedef struct survey {
    const double *points;
    size_t count, windows;
    double spacing;
    uint32_t *near;           /* windows x (MOST + 1) */
    double *variances[SIZES]; /* of the residuals of each window, by degrees of
                                 freedom */
} survey;

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

/* Keeps the points of the wall that the window's middle is on: in order of
 * their heights over the smallest window's plane, those up to the first gap.
 * Returns their number. */
static int keep_own_wall(double (*points)[3], int count, double spacing)
{
    double middle[LEAST + 1][3], centre[3], values[3], axes[9], heights[MOST + 1];
    memcpy(middle, points, sizeof middle);
    crease_quadric_plane(middle, LEAST + 1, centre, values, axes);
    for (int j = 0; j < count; j++)
        heights[j] = crease_vector_dot(points[j], axes);
    qsort(heights, (size_t)count, sizeof *heights, compare);
    double low = -INFINITY, high = INFINITY; /* the first point's height is 0 */
    for (int j = 1; j < count; j++)
        if (heights[j] - heights[j - 1] > gap * spacing) {
            if (heights[j] <= 0.0)
                low = heights[j];
            else if (heights[j - 1] < high && heights[j - 1] >= 0.0)
                high = heights[j - 1];
        }
    int kept = 0;
    for (int j = 0; j < count; j++) {
        const double height = crease_vector_dot(points[j], axes);
        if (height >= low && height <= high)
            memmove(points[kept++], points[j], sizeof points[j]);
    }
    return kept;
}

static double residual_variance(const survey *run, const uint32_t *near, int count)
{
    double points[MOST + 1][3], centre[3], values[3], axes[9], height[CREASE_QUADRIC_TERMS];
    const double *const own = run->points + 3 * (size_t)near[0];
    for (int j = 0; j < count; j++)
        for (size_t c = 0; c < 3; c++)
            points[j][c] = run->points[3 * (size_t)near[j] + c] - own[c];
    if (count > LEAST + 1) {
        const int kept = keep_own_wall(points, count, run->spacing);
        if (kept < own_share * count)
            return INFINITY;
        count = kept;
    }
    crease_quadric_plane(points, count, centre, values, axes);
    const double scale = sqrt(values[2] / count);
    const double squares =
        scale > 0.0 ? crease_quadric_fit(points, count, axes, scale, height) : -1.0;
    return squares < 0.0 ? INFINITY : squares / (count - CREASE_QUADRIC_TERMS);
}

static void fit_windows(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const survey *run = user;
    for (size_t w = begin; w < end; w++)
        for (int size = 0; size < SIZES; size++)
            run->variances[size][w] =
                residual_variance(run, run->near + w * (MOST + 1), (LEAST << size) + 1);
}

/* The quantile of chi-square over its degrees of freedom.
 * Based on: Wilson, Hilferty. The distribution of chi-square. 1931. */
static double chi_square_quantile(const struct quantile *quantile, double freedom)
{
    const double spread = 2.0 / (9.0 * freedom);
    const double root = 1.0 - spread + quantile->deviate * sqrt(spread);
    return root * root * root;
}

/* Variance of the noise by the windows of one size, were it independent. */
static double variance_at(const survey *run, const struct quantile *quantile, int size)
{
    const double freedom = (LEAST << size) + 1 - CREASE_QUADRIC_TERMS;
    const size_t rank = (size_t)(quantile->share * (double)run->windows);
    return crease_select(run->variances[size], run->windows, rank) /
        chi_square_quantile(quantile, freedom);
}

/* Whether the second size leaves more in every window, not only across edges. */
static bool grows_everywhere(const survey *run)
{
    return variance_at(run, &least, 1) >= growing * variance_at(run, &least, 0);
}

/* Mean square of the residuals, parameters not taken into account. */
static double mean_square(double variance, int size)
{
    const double count = (LEAST << size) + 1;
    return variance * (count - CREASE_QUADRIC_TERMS) / count;
}

static crease_correlation judge(const survey *run, double sigma2, double spacing)
{
    const double most2 = roughest * roughest * spacing * spacing;
    crease_correlation found = {.points = 1.0};
    double before = fmax(variance_at(run, &typical, 0), sigma2), alike = 0.0;
    const double first = before;
    int last = 0;
    if (!grows_everywhere(run))
        return found;
    for (int size = 1; size < SIZES; size++) {
        const double now = variance_at(run, &typical, size), added = before - first;
        if (!isfinite(now) || (size == 1 ? now < growing * first : now - first > lasting * added))
            break;
        if (now > at_once * before && now > most2)
            break;
        const double taken = mean_square(now, size) - mean_square(before, size - 1);
        alike = fmax(alike, taken * (LEAST << size) / CREASE_QUADRIC_TERMS);
        found.sigma2 = fmax(found.sigma2, now);
        before = now;
        last = size;
    }
    if (last == 1 && found.sigma2 > at_once * first)
        found.sigma2 = 0.0; /* narrow faces: most larger windows lie across an edge */
    if (found.sigma2 > 0.0)
        found.points = fmax(alike / found.sigma2, 1.0);
    return found;
}

static crease_status find_windows(crease_context *context, survey *run)
{
    crease_tree *tree = NULL;
    double *const places = crease_allocate(context, run->windows, 3 * sizeof *places);
    crease_status status = places ? crease_tree_create(context, run->points, run->count, &tree)
                                  : CREASE_ERROR_NO_MEMORY;
    for (size_t w = 0; w < run->windows && status == CREASE_OK; w++)
        for (size_t c = 0; c < 3; c++)
            places[3 * w + c] = run->points[3 * (w * run->count / run->windows) + c];
    if (status == CREASE_OK)
        status =
            crease_tree_nearest(context, tree, places, run->windows, MOST + 1, run->near, NULL);
    crease_tree_free(tree);
    free(places);
    return status;
}

static crease_status look(crease_context *context, survey *run, double *variances)
{
    if (!run->near || !variances)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t size = 0; size < SIZES; size++)
        run->variances[size] = variances + size * run->windows;
    const crease_status status = find_windows(context, run);
    return status == CREASE_OK ? crease_parallel_for(context, run->windows, GRAIN, fit_windows, run)
                               : status;
}

crease_status crease_correlation_estimate(crease_context *context, const double *points,
    size_t count, double sigma2, double spacing, crease_correlation *out)
{
    *out = (crease_correlation){.points = 1.0};
    if (MOST + 1 > widest * (double)count)
        return CREASE_OK;
    survey run = {.points = points,
        .count = count,
        .spacing = spacing,
        .windows = count < WINDOWS ? count : WINDOWS};
    run.near = crease_allocate(context, run.windows, (MOST + 1) * sizeof *run.near);
    double *const variances = crease_allocate(context, run.windows, SIZES * sizeof *variances);
    const crease_status status = look(context, &run, variances);
    if (status == CREASE_OK)
        *out = judge(&run, sigma2, spacing);
    free(run.near);
    free(variances);
    return status;
}
