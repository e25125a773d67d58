/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "bench.h"

#include "base/random.h"
#include "space/morton.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>

static void sheet(size_t i, size_t count, double point[3])
{
    const double u = crease_random_uniform(1, 0, i), v = crease_random_uniform(1, 1, i);
    const double spacing = 1 / sqrt((double)count);
    point[0] = u;
    point[1] = v;
    point[2] =
        0.1 * sin(5 * u) + 0.4 * fabs(v - 0.5) + 0.1 * spacing * crease_random_normal(1, 2, i);
}

static void sort_points(crease_context *context, double *points, size_t count)
{
    uint64_t *keys = malloc(count * sizeof *keys);
    uint32_t *order = malloc(count * sizeof *order);
    double *copy = malloc(count * 3 * sizeof *copy);
    if (keys && order && copy &&
        crease_morton_sort(context, points, count, keys, order) == CREASE_OK) {
        memcpy(copy, points, count * 3 * sizeof *copy);
        for (size_t i = 0; i < count; i++)
            memcpy(points + 3 * i, copy + 3 * (size_t)order[i], 3 * sizeof *copy);
    }
    free(keys);
    free(order);
    free(copy);
}

double *bench_points(crease_context *context, size_t count, bool sorted)
{
    double *points = malloc(count * 3 * sizeof *points);
    for (size_t i = 0; i < count && points; i++)
        sheet(i, count, points + 3 * i);
    if (points && sorted)
        sort_points(context, points, count);
    return points;
}

crease_cloud *bench_cloud(crease_context *context, const double *points, size_t count)
{
    const crease_cloud_parts parts = {.count = count, .points = points};
    crease_cloud *cloud = NULL;
    crease_cloud_create(context, &parts, &cloud);
    return cloud;
}

crease_context *bench_context(int threads)
{
    crease_context_options options = crease_context_options_default();
    options.threads = threads;
    crease_context *context = NULL;
    crease_context_create(&options, &context);
    return context;
}

static double seconds(struct timeval time)
{
    return (double)time.tv_sec + 1e-6 * (double)time.tv_usec;
}

bench_clock bench_now(void)
{
    struct timespec wall;
    struct rusage usage;
    clock_gettime(CLOCK_MONOTONIC, &wall);
    getrusage(RUSAGE_SELF, &usage);
    return (bench_clock){(double)wall.tv_sec + 1e-9 * (double)wall.tv_nsec,
        seconds(usage.ru_utime) + seconds(usage.ru_stime)};
}

double bench_memory(void)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return 1024.0 * (double)usage.ru_maxrss;
}
