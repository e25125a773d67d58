/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The least-squares solver alone: POINTS (doubles x y z) NET VALUES [THREADS]. Fits a bicubic net
 * without creases, all but unsmoothed, and writes its heights over the points. Tells the CPU
 * seconds of the sum over the points, of the solution, and the peak memory in MB. */
#include "bench.h"

#include "net/system.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct points {
    size_t count;
    double *uv, *weight, *target;
} points;

static bool read_points(const char *path, points *p)
{
    FILE *file = fopen(path, "rb");
    if (!file || fseek(file, 0, SEEK_END))
        return false;
    p->count = (size_t)ftell(file) / (3 * sizeof(double));
    rewind(file);
    p->uv = malloc(p->count * 2 * sizeof(double));
    p->weight = malloc(p->count * sizeof(double));
    p->target = malloc(p->count * sizeof(double));
    bool good = p->uv && p->weight && p->target;
    for (size_t i = 0; i < p->count && good; i++) {
        good = fread(p->uv + 2 * i, sizeof(double), 2, file) == 2 &&
            fread(p->target + i, sizeof(double), 1, file) == 1;
        p->weight[i] = 1.0;
    }
    fclose(file);
    return good;
}

static crease_layout lay_out(const points *p, size_t net)
{
    crease_layout layout = {.order = 4};
    for (int d = 0; d < 2; d++) {
        crease_layout_axis *const axis = &layout.axis[d];
        axis->smooth = net - 4;
        axis->low = INFINITY, axis->high = -INFINITY;
        for (size_t i = 0; i < p->count; i++) {
            axis->low = fmin(axis->low, p->uv[2 * i + (size_t)d]);
            axis->high = fmax(axis->high, p->uv[2 * i + (size_t)d]);
        }
    }
    return layout;
}

static bool write_heights(const char *path, const crease_height *height, const points *p)
{
    FILE *file = fopen(path, "wb");
    const crease_side sides[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
    bool good = file != NULL;
    for (size_t i = 0; i < p->count && good; i++) {
        double f[3];
        crease_height_at(height, p->uv + 2 * i, sides, 0, f);
        good = fwrite(f, sizeof *f, 1, file) == 1;
    }
    return file && fclose(file) == 0 && good;
}

int main(int count, char **arguments)
{
    points p = {0};
    if (count < 4 || !read_points(arguments[1], &p))
        return 2;
    crease_context *context = bench_context(count > 4 ? atoi(arguments[4]) : 1);
    const crease_layout layout = lay_out(&p, (size_t)atoi(arguments[2]));
    crease_gaps gaps = {.count = {1, 1}, .step = {1, 1}, .spacing = 1 / sqrt((double)p.count)};
    crease_height height;
    crease_system system;
    bool solvable = false;
    const crease_observations seen = {
        .count = p.count, .sides = 1, .uv = p.uv, .weight = p.weight, .target = p.target};
    const bench_clock begin = bench_now();
    if (crease_height_create(context, &layout, &height) != CREASE_OK ||
        crease_system_create(context, &height, 1, &gaps, &system) != CREASE_OK ||
        crease_system_add(context, &system, &height, &seen) != CREASE_OK)
        return 1;
    const bench_clock assembled = bench_now();
    if (crease_system_factor(context, &system, 1e-12, &solvable) != CREASE_OK || !solvable ||
        crease_system_solve(context, &system, height.coefficients) != CREASE_OK)
        return 1;
    const bench_clock solved = bench_now();
    printf("%.3f %.3f %.0f\n", assembled.cpu - begin.cpu, solved.cpu - assembled.cpu,
        bench_memory() / (1024.0 * 1024.0));
    return write_heights(arguments[3], &height, &p) ? 0 : 1;
}
