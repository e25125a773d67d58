/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "crease/feature.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "base/vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { GRAIN = 4096, LEAST_MEASURED = 100 };

static const double PI = 3.14159265358979323846;
static const double CHORD = 0.25;         /* of a curve, in spacings: bends away by far less */
static const double LARGEST_GAP = 100.0;  /* degrees between neighbours: more is a border */
static const double FARTHEST = 3.0;       /* sigmas from the model */
static const double MOST_SPACINGS = 16.0; /* squared: sparser places are holes */

/* -------------------------------------------------------------------------------- marking -- */

static double distance_to_chord(const double p[3], const double a[3], const double b[3])
{
    double chord[3], from[3];
    for (int c = 0; c < 3; c++) {
        chord[c] = b[c] - a[c];
        from[c] = p[c] - a[c];
    }
    const double squared = crease_vector_dot(chord, chord);
    const double along = squared > 0.0 ? crease_vector_dot(from, chord) / squared : 0.0;
    const double t = fmin(1.0, fmax(0.0, along));
    for (int c = 0; c < 3; c++)
        from[c] -= t * chord[c];
    return crease_vector_length(from);
}

static void mark_chord(const crease_bystanders *by, const double a[3], const double b[3],
    double distance, uint32_t *found, uint8_t *near)
{
    const double middle[3] = {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])};
    const double radius = distance + crease_vector_distance(a, middle);
    size_t count = 0;
    crease_tree_within(by->tree, middle, radius, by->tree->count, found, &count);
    for (size_t i = 0; i < count; i++)
        if (distance_to_chord(by->points + 3 * (size_t)found[i], a, b) <= distance)
            near[found[i]] = 1;
}

static void mark_curve(const crease_bystanders *by, const crease_curve *curve, double distance,
    uint32_t *found, uint8_t *near)
{
    double domain[2], before[3], place[3];
    crease_curve_domain(curve, domain);
    const double length = domain[1] - domain[0];
    const double chords = fmax(1.0, ceil(length / (CHORD * by->spacing)));
    crease_curve_evaluate(curve, domain[0], CREASE_SIDE_RIGHT, 0, before);
    for (double i = 1.0; i <= chords; i += 1.0) {
        const double t = domain[0] + length * (i / chords);
        crease_curve_evaluate(curve, t, CREASE_SIDE_LEFT, 0, place);
        mark_chord(by, before, place, distance, found, near);
        memcpy(before, place, sizeof before);
    }
}

crease_status crease_features_mark(crease_context *context, const crease_bystanders *bystanders,
    const crease_curve *const *curves, size_t count, double distance, uint8_t *near)
{
    uint32_t *const found = crease_allocate(context, bystanders->tree->count, sizeof *found);
    if (!found)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < count; i++)
        mark_curve(bystanders, curves[i], distance, found, near);
    free(found);
    return CREASE_OK;
}

/* -------------------------------------------------------------------------------- spacing -- */

typedef struct measuring {
    const crease_survey *survey;
    const uint8_t *near;
    double *sums;   /* by chunk: of the squared spacings */
    size_t *counts; /* by chunk: of the points measured */
} measuring;

/* Ascending. */
static void sort_few(double *values, size_t count)
{
    for (size_t i = 1; i < count; i++) {
        const double value = values[i];
        size_t at = i;
        for (; at > 0 && values[at - 1] > value; at--)
            values[at] = values[at - 1];
        values[at] = value;
    }
}

/* Whether directions (radians, sorted here) go round without a gap. */
static bool surrounded(double *angles, size_t count)
{
    sort_few(angles, count);
    double gap = angles[0] + 2.0 * PI - angles[count - 1];
    for (size_t i = 1; i < count; i++)
        gap = fmax(gap, angles[i] - angles[i - 1]);
    return gap <= LARGEST_GAP * PI / 180.0;
}

/* Two unit vectors that are normal to a third and to each other. */
static void span_plane(const double normal[3], double u[3], double v[3])
{
    const int flat = fabs(normal[0]) < fabs(normal[1])
        ? (fabs(normal[0]) < fabs(normal[2]) ? 0 : 2)
        : (fabs(normal[1]) < fabs(normal[2]) ? 1 : 2);
    double axis[3] = {0.0, 0.0, 0.0};
    axis[flat] = 1.0;
    crease_vector_cross(normal, axis, u);
    crease_vector_normalise(u);
    crease_vector_cross(normal, u, v);
}

/* The squared spacing around a point, or 0 when it tells nothing. Noise lengthens the distance to
 * a neighbour, by 2 sigma^2 of its square. */
static double measure(const crease_survey *survey, size_t point)
{
    const crease_regions *const regions = survey->regions;
    const uint32_t *const neighbours = crease_neighbours_of(regions->neighbours, point);
    const size_t k = (size_t)crease_neighbours_k(regions->neighbours);
    const double *const p = regions->points + 3 * point;
    double angles[CREASE_NOISE_NEIGHBOURS], u[3], v[3], radius = 0.0;
    size_t count = 0;
    span_plane(regions->noise->normals + 3 * point, u, v);
    for (size_t j = 1; j < k && j < CREASE_NOISE_NEIGHBOURS; j++) {
        const double *const q = regions->points + 3 * (size_t)neighbours[j];
        const double d[3] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
        radius = crease_vector_length(d);
        if (regions->labels[neighbours[j]] == regions->labels[point])
            angles[count++] = atan2(crease_vector_dot(d, v), crease_vector_dot(d, u));
    }
    if (3 * count < k - 1 || count < 3 || !surrounded(angles, count))
        return 0.0;
    const double squared =
        PI * (radius * radius - 2.0 * survey->sigma * survey->sigma) / (double)count;
    return squared <= MOST_SPACINGS * survey->spacing * survey->spacing ? squared : 0.0;
}

static void measure_some(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const measuring *const run = user;
    const crease_regions *const regions = run->survey->regions;
    const size_t chunk = begin / GRAIN;
    for (size_t i = begin; i < end; i++) {
        const int32_t label = regions->labels[i];
        double gradient[3];
        if (run->near[i] || label < 0 ||
            fabs(crease_model_distance(&regions->models[label], regions->points + 3 * i,
                gradient)) > FARTHEST * run->survey->sigma)
            continue;
        const double squared = measure(run->survey, i);
        run->sums[chunk] += fmax(squared, 0.0);
        run->counts[chunk] += squared > 0.0;
    }
}

crease_status crease_features_spacing(
    crease_context *context, const crease_survey *survey, const uint8_t *near, double *spacing)
{
    const size_t chunks = survey->regions->count / GRAIN + 1;
    measuring run = {.survey = survey, .near = near};
    run.sums = crease_allocate(context, chunks, sizeof *run.sums);
    run.counts = crease_allocate(context, chunks, sizeof *run.counts);
    crease_status status = CREASE_ERROR_NO_MEMORY;
    if (run.sums && run.counts)
        status = crease_parallel_for(context, survey->regions->count, GRAIN, measure_some, &run);
    double sum = 0.0;
    size_t count = 0;
    for (size_t i = 0; i < chunks && status == CREASE_OK; i++) {
        sum += run.sums[i];
        count += run.counts[i];
    }
    *spacing = count > LEAST_MEASURED ? sqrt(sum / (double)count) : survey->spacing;
    free(run.sums);
    free(run.counts);
    return status;
}
