/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "net/samples.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "base/select.h"
#include "space/morton.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { GRAIN = 16384, FOOT_STEPS = 3, MANY = 65536 };

/* Of an outlier: next to nothing, but where there are only outliers they must do. */
static const double LEAST_WEIGHT = 1e-7;
/* In spacings: a foot that would move by less is there; the plane that touches the sheet is as true
 * as the square of that. */
static const double SMALL_STEP = 1e-5;

static crease_status allocate_all(crease_context *context, crease_samples *s)
{
    s->points = crease_allocate(context, s->count, 3 * sizeof(double));
    s->uv = crease_allocate(context, s->count, 2 * sizeof(double));
    double **const arrays[] = {
        &s->target, &s->tilt, &s->prior, &s->weight, &s->residual, &s->scratch};
    bool complete = s->points && s->uv;
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0] && complete; i++) {
        *arrays[i] = crease_allocate(context, s->count, sizeof(double));
        complete = *arrays[i] != NULL;
    }
    return complete ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
}

/* What is near in space comes near in memory. */
static crease_status sort(crease_context *context, crease_samples *s)
{
    uint64_t *keys = crease_allocate(context, s->count, sizeof *keys);
    s->order = crease_allocate(context, s->count, sizeof *s->order);
    const crease_status status = keys && s->order
        ? crease_morton_sort(context, s->source, s->count, keys, s->order)
        : CREASE_ERROR_NO_MEMORY;
    free(keys);
    return status;
}

size_t crease_samples_number(const crease_samples *s, size_t i)
{
    return s->order ? s->order[i] : i * s->step;
}

crease_status crease_samples_create(crease_context *context, const double *points,
    const double *keep, size_t count, size_t step, double spacing, double epsilon,
    crease_samples *out)
{
    *out = (crease_samples){.count = (count + step - 1) / step,
        .step = step,
        .source = points,
        .spacing = spacing * sqrt((double)step)};
    crease_status status = allocate_all(context, out);
    if (status == CREASE_OK && step == 1 && count > MANY)
        status = sort(context, out);
    if (status != CREASE_OK) {
        crease_samples_free(out);
        return status;
    }
    double farthest = 0.0;
    for (size_t i = 0; i < out->count; i++) {
        const size_t number = crease_samples_number(out, i);
        out->prior[i] = out->weight[i] = keep[number];
        out->used += out->prior[i];
        for (size_t c = 0; c < 3; c++)
            farthest = fmax(farthest, fabs(points[3 * number + c]));
    }
    out->rounding = fmax(DBL_MIN, 4.0 * epsilon * farthest);
    return CREASE_OK;
}

void crease_samples_free(crease_samples *samples)
{
    free(samples->order);
    free(samples->points);
    free(samples->uv);
    free(samples->target);
    free(samples->tilt);
    free(samples->prior);
    free(samples->weight);
    free(samples->residual);
    free(samples->scratch);
    *samples = (crease_samples){0};
}

static bool is_same(const crease_frame *a, const crease_frame *b)
{
    return memcmp(a->origin, b->origin, sizeof a->origin) == 0 &&
        memcmp(a->rotation, b->rotation, sizeof a->rotation) == 0;
}

static void enter(crease_samples *samples, const crease_frame *frame)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < samples->count; i++) {
        double *const p = samples->points + 3 * i;
        crease_frame_enter(frame, samples->source + 3 * crease_samples_number(samples, i), 1, p);
        for (size_t c = 0; c < 3 && samples->prior[i] > 0.0; c++) {
            low[c] = p[c] < low[c] ? p[c] : low[c];
            high[c] = p[c] > high[c] ? p[c] : high[c];
        }
    }
    samples->frame = *frame;
    samples->placed = true;
    memcpy(samples->low, low, sizeof samples->low);
    memcpy(samples->high, high, sizeof samples->high);
    samples->bottom = low[2];
    samples->range = fmax(0.0, high[2] - low[2]);
}

void crease_samples_place(
    crease_samples *samples, const crease_frame *frame, double low[2], double high[2])
{
    if (!samples->placed || !is_same(frame, &samples->frame))
        enter(samples, frame);
    memcpy(low, samples->low, sizeof samples->low);
    memcpy(high, samples->high, sizeof samples->high);
    for (size_t i = 0; i < samples->count; i++) {
        const double *const p = samples->points + 3 * i;
        samples->uv[2 * i] = p[0];
        samples->uv[2 * i + 1] = p[1];
        samples->target[i] = p[2];
        samples->tilt[i] = 1.0;
    }
}

/* ---------------------------------------------------------------------------------- distances --
 */

typedef struct work {
    crease_samples *samples;
    const crease_height *height;
    const crease_layout *layout;
} work;

static void hold(double *uv, double interval[2][2])
{
    for (int d = 0; d < 2; d++)
        uv[d] = fmin(fmax(uv[d], interval[d][0]), interval[d][1]);
}

/* One Gauss-Newton step towards the foot. f: height and slopes at uv. */
static void step_to_foot(const double *point, const double f[3], double *uv)
{
    const double dx = point[0] - uv[0], dy = point[1] - uv[1], dz = point[2] - f[0];
    const double a = 1.0 + f[1] * f[1], b = f[1] * f[2], c = 1.0 + f[2] * f[2];
    const double p = dx + f[1] * dz, q = dy + f[2] * dz, determinant = a * c - b * b;
    uv[0] += (c * p - b * q) / determinant;
    uv[1] += (a * q - b * p) / determinant;
}

/* Whether a step leads nowhere else. */
static bool arrived(const work *w, const double from[2], const double to[2])
{
    const double least = SMALL_STEP * w->samples->spacing;
    return fabs(to[0] - from[0]) <= least && fabs(to[1] - from[1]) <= least;
}

static void find_foot(const work *w, size_t i)
{
    crease_samples *const s = w->samples;
    const double *const point = s->points + 3 * i;
    double *const uv = s->uv + 2 * i, interval[2][2], f[3];
    for (int d = 0; d < 2; d++)
        crease_layout_between(w->layout, d, point[d], interval[d]);
    hold(uv, interval);
    for (int step = 0; step <= FOOT_STEPS; step++) {
        crease_side sides[2];
        for (int d = 0; d < 2; d++)
            sides[d] = uv[d] < interval[d][1] ? CREASE_SIDE_RIGHT : CREASE_SIDE_LEFT;
        crease_height_at(w->height, uv, sides, 1, f);
        if (step == FOOT_STEPS)
            break;
        double next[2] = {uv[0], uv[1]};
        step_to_foot(point, f, next);
        hold(next, interval);
        if (arrived(w, uv, next))
            break;
        memcpy(uv, next, sizeof next);
    }
    s->target[i] = point[2] - f[1] * (point[0] - uv[0]) - f[2] * (point[1] - uv[1]);
    s->tilt[i] = 1.0 / sqrt(1.0 + f[1] * f[1] + f[2] * f[2]);
    s->residual[i] = s->tilt[i] * (s->target[i] - f[0]);
}

static void project_some(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const work *const w = user;
    for (size_t i = begin; i < end; i++)
        find_foot(w, i);
}

crease_status crease_samples_project(crease_context *context, crease_samples *samples,
    const crease_height *height, const crease_layout *layout)
{
    work w = {.samples = samples, .height = height, .layout = layout};
    return crease_parallel_for(context, samples->count, GRAIN, project_some, &w);
}

static void measure_some(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const work *const w = user;
    crease_samples *const s = w->samples;
    const crease_side sides[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
    for (size_t i = begin; i < end; i++) {
        double f[3];
        crease_height_at(w->height, s->uv + 2 * i, sides, 0, f);
        s->residual[i] = s->tilt[i] * (s->target[i] - f[0]);
    }
}

crease_status crease_samples_measure(
    crease_context *context, crease_samples *samples, const crease_height *height)
{
    work w = {.samples = samples, .height = height};
    return crease_parallel_for(context, samples->count, GRAIN, measure_some, &w);
}

double crease_samples_mean_distance(crease_samples *samples)
{
    const double most = fmax(10.0 * crease_samples_scale(samples), 2.0 * samples->spacing);
    double sum = 0.0;
    for (size_t i = 0; i < samples->count; i++)
        sum += samples->prior[i] * fmin(fabs(samples->residual[i]), most);
    return sum / samples->used;
}

/* ------------------------------------------------------------------------------------ weights --
 */

double crease_samples_scale(crease_samples *samples)
{
    size_t kept = 0;
    for (size_t i = 0; i < samples->count; i++)
        if (samples->prior[i] > 0.0)
            samples->scratch[kept++] = fabs(samples->residual[i]);
    const double median = crease_select(samples->scratch, kept, kept / 2);
    return fmax(fmax(samples->rounding, 1e-8 * samples->spacing), 1.4826 * median);
}

void crease_samples_reweigh(crease_samples *samples, double scale, bool redescending)
{
    for (size_t i = 0; i < samples->count; i++) {
        const double r = samples->residual[i] / scale;
        const double robust = redescending ? LEAST_WEIGHT + 1.0 / (1.0 + r * r / 5.6)
                                           : 1.0 / sqrt(1.0 + r * r / 2.25);
        samples->weight[i] = samples->prior[i] * robust;
    }
}
