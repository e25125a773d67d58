/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "noise/windows.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "base/vector.h"

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

static const double bending_test = 4.0; /* F of the quadric over the plane that is significant */

typedef crease_window window;

static int at_most(int neighbours, int wanted)
{
    return neighbours < wanted ? neighbours : wanted;
}

crease_window_sizes crease_window_sizes_of(int k)
{
    return (crease_window_sizes){
        at_most(k - 1, WIDE), at_most(k - 1, NARROW), at_most(k - 1, TIGHT)};
}

crease_status crease_windows_create(crease_context *context, crease_windows *windows)
{
    const size_t count = crease_neighbours_count(windows->neighbours);
    windows->sizes = crease_window_sizes_of(crease_neighbours_k(windows->neighbours));
    windows->of = crease_allocate(context, count, sizeof *windows->of);
    return windows->of ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
}

void crease_windows_free(crease_windows *windows)
{
    free(windows->of);
    windows->of = NULL;
}

/* --------------------------------------------------------------------------------- fitting -- */

/* The window's points relative to its own point, in units. Returns their number. */
static int gather(const crease_windows *run, size_t point, int neighbours, double (*out)[3])
{
    const uint32_t *const near = crease_neighbours_of(run->neighbours, point);
    const double *const own = run->points + 3 * point;
    for (int j = 0; j <= neighbours; j++)
        for (int c = 0; c < 3; c++)
            out[j][c] = (run->points[3 * (size_t)near[j] + (size_t)c] - own[c]) / run->unit;
    return neighbours + 1;
}

static void fit_window(const crease_windows *run, size_t point, int neighbours, window *out)
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

static void fit_windows(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const crease_windows *run = user;
    for (size_t i = run->begin + begin; i < run->begin + end; i++) {
        fit_window(run, i, run->sizes.wide, &run->of[i][0]);
        fit_window(run, i, run->sizes.narrow, &run->of[i][1]);
    }
}

crease_status crease_windows_fit(crease_context *context, const crease_windows *windows)
{
    crease_windows run = *windows;
    return crease_parallel_for(context, run.end - run.begin, GRAIN, fit_windows, &run);
}

/* --------------------------------------------------------------------------------- numbers -- */

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

static double squared_reach(const crease_windows *run, size_t point, int neighbour)
{
    const uint32_t other = crease_neighbours_of(run->neighbours, point)[neighbour];
    const double distance =
        crease_vector_distance(run->points + 3 * point, run->points + 3 * (size_t)other) /
        run->unit;
    return distance * distance;
}

static double tight_variance(const crease_windows *run, size_t point)
{
    double points[TIGHT + 1][3], centre[3], values[3], axes[9];
    const int count = gather(run, point, run->sizes.tight, points);
    return crease_quadric_plane(points, count, centre, values, axes) / (count - 3);
}

typedef struct valuation {
    const crease_windows *windows;
    crease_noise_value which;
    double *values;
} valuation;

static double value_of(const crease_windows *run, size_t point, crease_noise_value which)
{
    switch (which) {
    case CREASE_WIDE_VARIANCE:
        return residual_variance(&run->of[point][0], run->sizes.wide + 1, 0.0);
    case CREASE_WIDE_REACH:
        return squared_reach(run, point, run->sizes.wide);
    case CREASE_TIGHT_VARIANCE:
        return tight_variance(run, point);
    case CREASE_TIGHT_REACH:
        return squared_reach(run, point, run->sizes.tight);
    case CREASE_NO_VALUE:
        break;
    }
    return 0.0;
}

static void find_values(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const valuation *const run = user;
    for (size_t i = run->windows->begin + begin; i < run->windows->begin + end; i++)
        run->values[i] = value_of(run->windows, i, run->which);
}

crease_status crease_windows_values(crease_context *context, const crease_windows *windows,
    crease_noise_value which, double *values)
{
    valuation run = {windows, which, values};
    return crease_parallel_for(context, windows->end - windows->begin, GRAIN, find_values, &run);
}

/* --------------------------------------------------------------------------------- normals -- */

typedef struct description {
    const crease_windows *windows;
    const crease_noise_scale *scale;
    const crease_noise *noise;
} description;

static double local_spacing(const description *run, size_t point)
{
    const crease_windows *const windows = run->windows;
    const crease_noise_scale *const scale = run->scale;
    const double reach2 = squared_reach(windows, point, windows->sizes.wide);
    const double local = acos(-1.0) * (reach2 - 2.0 * scale->raw_sigma2) / windows->sizes.wide;
    return windows->unit * sqrt(scale->thin ? scale->spacing2 : fmax(local, 0.1 * scale->spacing2));
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
static double reluctance(const description *run, const window *w, int count, const double at[3],
    double reach2, double normal[3])
{
    const bool bent = is_bent(w, count, run->scale->sigma2);
    const double freedom = count - (bent ? TERMS : 3);
    const double excess = residual_variance(w, count, run->scale->sigma2) / run->scale->sigma2;
    const double height = above(w, bent, at, normal);
    const double off = height * height / run->scale->sigma2;
    return fmax(excess, 1.0 + 2.0 * sqrt(2.0 / freedom)) +
        0.5 * crease_vector_dot(at, at) / reach2 + (off > 6.25 ? 0.2 * off : 0.0) +
        (count <= NARROW + 1 && run->windows->sizes.wide > NARROW ? 1.5 : 0.0);
}

static void choose_normal(const description *run, size_t point, double reach2)
{
    const crease_windows *const windows = run->windows;
    const uint32_t *const near = crease_neighbours_of(windows->neighbours, point);
    const double *const own = windows->points + 3 * point;
    double least = INFINITY, normal[3], *const out = run->noise->normals + 3 * point;
    for (int j = 0; j <= windows->sizes.wide; j++) {
        const size_t other = near[j];
        double at[3];
        for (int c = 0; c < 3; c++)
            at[c] = (own[c] - windows->points[3 * other + (size_t)c]) / windows->unit;
        for (int narrow = 0; narrow <= (j <= windows->sizes.narrow); narrow++) {
            const int count = 1 + (narrow ? windows->sizes.narrow : windows->sizes.wide);
            const double value =
                reluctance(run, &windows->of[other][narrow], count, at, reach2, normal);
            if (value < least) {
                least = value;
                memcpy(out, normal, sizeof normal);
            }
        }
    }
}

static void describe(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const description *run = user;
    const crease_windows *const windows = run->windows;
    const int wide = windows->sizes.wide;
    const double sigma2 = run->scale->sigma2;
    for (size_t i = windows->begin + begin; i < windows->begin + end; i++) {
        run->noise->local_spacing[i] = (float)local_spacing(run, i);
        const double local = (double)run->noise->local_spacing[i] / windows->unit;
        const double reach2 = local * local * wide / acos(-1.0) + 2.0 * sigma2;
        choose_normal(run, i, reach2);
        run->noise->scores[i] =
            (float)(residual_variance(&windows->of[i][0], wide + 1, sigma2) / sigma2);
    }
}

crease_status crease_windows_describe(crease_context *context, const crease_windows *windows,
    const crease_noise_scale *scale, const crease_noise *noise)
{
    description run = {windows, scale, noise};
    return crease_parallel_for(context, windows->end - windows->begin, GRAIN, describe, &run);
}
