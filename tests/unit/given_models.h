/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Exact models, and the regions of bodies that are bounded by them. */
#ifndef CREASE_TESTS_GIVEN_MODELS_H
#define CREASE_TESTS_GIVEN_MODELS_H

#include "given.h"

#include "base/random.h"
#include "base/vector.h"
#include "segment/region.h"

enum { MOST_FACES = 32 };

/* An orthonormal frame whose last axis is the direction. */
static inline void given_axes(const double direction[3], double axes[9])
{
    double least[3] = {0, 0, 0};
    int flat = 0;
    for (int c = 1; c < 3; c++)
        flat = fabs(direction[c]) < fabs(direction[flat]) ? c : flat;
    least[flat] = 1;
    memcpy(axes + 6, direction, 3 * sizeof *axes);
    crease_vector_normalise(axes + 6);
    crease_vector_cross(axes + 6, least, axes);
    crease_vector_normalise(axes);
    crease_vector_cross(axes + 6, axes, axes + 3);
}

static inline crease_model given_model(crease_region_type type, const double centre[3],
    const double direction[3], double radius, double shape)
{
    crease_model model = {.type = type, .radius = radius, .shape = shape};
    memcpy(model.centre, centre, sizeof model.centre);
    given_axes(direction, model.axes);
    return model;
}

/* A plane with its outward normal. */
static inline crease_model given_plane(const double place[3], const double normal[3])
{
    return given_model(CREASE_REGION_PLANE, place, normal, 0, 0);
}

/* A solid that is where all models are negative. */
typedef struct given_body {
    size_t count;
    crease_model models[MOST_FACES];
    double size; /* half the side of the cube around the origin that holds it */
} given_body;

static inline void given_add(given_body *body, crease_model model)
{
    assert_true(body->count < MOST_FACES);
    body->models[body->count++] = model;
}

static inline given_body given_box(double x, double y, double z)
{
    const double half[3] = {x, y, z};
    given_body body = {.size = fmax(x, fmax(y, z))};
    for (int c = 0; c < 3; c++)
        for (int sign = -1; sign <= 1; sign += 2) {
            double place[3] = {0, 0, 0}, normal[3] = {0, 0, 0};
            place[c] = sign * half[c];
            normal[c] = sign;
            given_add(&body, given_plane(place, normal));
        }
    return body;
}

static inline given_body given_rod(double radius, double half)
{
    const double z[3] = {0, 0, 1}, down[3] = {0, 0, -1}, origin[3] = {0, 0, 0};
    const double top[3] = {0, 0, half}, bottom[3] = {0, 0, -half};
    given_body body = {.size = fmax(radius, half)};
    given_add(&body, given_model(CREASE_REGION_CYLINDER, origin, z, radius, 0));
    given_add(&body, given_plane(top, z));
    given_add(&body, given_plane(bottom, down));
    return body;
}

/* A pyramid on the plane z = -0.5, its apex in (0, 0, 0.5). */
static inline given_body given_pyramid(int sides, double slope)
{
    const double apex[3] = {0, 0, 0.5}, base[3] = {0, 0, -0.5}, down[3] = {0, 0, -1};
    given_body body = {.size = 2};
    for (int i = 0; i < sides; i++) {
        const double angle = 2 * acos(-1) * (i + 0.3) / sides;
        const double normal[3] = {cos(angle) * slope, sin(angle) * slope, 1};
        given_add(&body, given_plane(apex, normal));
    }
    given_add(&body, given_plane(base, down));
    return body;
}

/* A place of a model's surface for parameters in -1..1, within the body's cube. */
static inline void given_place(
    const crease_model *model, double size, double u, double v, double place[3])
{
    const double *const x = model->axes, *const y = x + 3, *const z = x + 6;
    double reach = 2 * size, radius = model->radius;
    for (int c = 0; c < 3; c++) {
        if (model->type == CREASE_REGION_PLANE) {
            place[c] = model->centre[c] + reach * (u * x[c] + v * y[c]);
        } else if (model->type == CREASE_REGION_CYLINDER || model->type == CREASE_REGION_CONE) {
            const double here = radius + model->shape * reach * v, angle = acos(-1) * u;
            place[c] = model->centre[c] + here * (cos(angle) * x[c] + sin(angle) * y[c]) +
                reach * v * z[c];
        } else if (model->type == CREASE_REGION_TORUS) {
            const double here = radius + model->shape * cos(acos(-1) * v);
            place[c] = model->centre[c] +
                here * (cos(acos(-1) * u) * x[c] + sin(acos(-1) * u) * y[c]) +
                model->shape * sin(acos(-1) * v) * z[c];
        } else { /* sphere */
            const double around = sqrt(1 - v * v), angle = acos(-1) * u;
            place[c] = model->centre[c] +
                radius * (around * (cos(angle) * x[c] + sin(angle) * y[c]) + v * z[c]);
        }
    }
}

/* Number of grid cells along both parameters so that cells have about the side s. */
static inline void given_cells(const crease_model *model, double size, double s, size_t cells[2])
{
    double sides[2] = {4 * size, 4 * size};
    if (model->type != CREASE_REGION_PLANE)
        sides[0] = 2 * acos(-1) * fmax(model->radius, fabs(model->shape) * size);
    if (model->type == CREASE_REGION_SPHERE)
        sides[1] = 2 * model->radius;
    if (model->type == CREASE_REGION_TORUS)
        sides[1] = 2 * acos(-1) * model->shape;
    for (int d = 0; d < 2; d++)
        cells[d] = (size_t)ceil(sides[d] / s);
}

typedef struct given_points {
    size_t count, room;
    double *points;
    int32_t *labels;
} given_points;

static inline void given_point(given_points *to, const double place[3], int32_t label)
{
    if (to->count == to->room) {
        to->room = 2 * to->room + 1024;
        to->points = realloc(to->points, 3 * to->room * sizeof *to->points);
        to->labels = realloc(to->labels, to->room * sizeof *to->labels);
        assert_true(to->points && to->labels);
    }
    memcpy(to->points + 3 * to->count, place, 3 * sizeof *place);
    to->labels[to->count++] = label;
}

/* Points about s apart on the body's faces, jittered, with noise along the normal. */
static inline given_points given_sample(
    const given_body *body, double s, double sigma, uint64_t seed)
{
    given_points out = {0, 0, NULL, NULL};
    uint64_t draw = 0;
    for (size_t f = 0; f < body->count; f++) {
        size_t cells[2];
        given_cells(&body->models[f], body->size, s, cells);
        for (size_t i = 0; i < cells[0] * cells[1]; i++) {
            const double jitter[2] = {
                crease_random_uniform(seed, 1, draw), crease_random_uniform(seed, 2, draw)};
            const double noise = sigma * crease_random_normal(seed, 3, draw++);
            double place[3], gradient[3];
            given_place(&body->models[f], body->size,
                2 * ((double)(i / cells[1]) + jitter[0]) / (double)cells[0] - 1,
                2 * ((double)(i % cells[1]) + jitter[1]) / (double)cells[1] - 1, place);
            bool inside = true;
            for (size_t k = 0; k < body->count && inside; k++)
                inside = k == f || crease_model_distance(&body->models[k], place, gradient) <= 0;
            if (!inside)
                continue;
            crease_model_distance(&body->models[f], place, gradient);
            for (int c = 0; c < 3; c++)
                place[c] += noise * gradient[c];
            given_point(&out, place, (int32_t)f);
        }
    }
    return out;
}

/* The regions of such points, with the exact models. Takes the points over. */
static inline crease_regions *given_regions(
    crease_context *context, const given_body *body, given_points from, double s, double sigma)
{
    const size_t n = from.count;
    const int k = n < CREASE_NOISE_NEIGHBOURS ? (int)n : CREASE_NOISE_NEIGHBOURS;
    const crease_cloud_parts parts = {.count = n, .points = from.points};
    crease_cloud *cloud = NULL;
    crease_regions *r = calloc(1, sizeof *r);
    assert_non_null(r);
    *r = (crease_regions){.count = n, .points = from.points, .labels = from.labels};
    assert_int_equal(crease_cloud_create(context, &parts, &cloud), CREASE_OK);
    assert_int_equal(crease_neighbours_find(context, cloud, k, &r->neighbours), CREASE_OK);
    crease_cloud_free(cloud);
    r->noise = calloc(1, sizeof *r->noise);
    r->order = calloc(n, sizeof *r->order);
    r->models = calloc(body->count, sizeof *r->models);
    *r->noise = (crease_noise){.count = n, .spacing = s, .sigma = fmax(sigma, 0.03 * s)};
    r->noise->normals = calloc(3 * n, sizeof(double));
    r->noise->scores = calloc(n, sizeof(float));
    r->noise->local_spacing = calloc(n, sizeof(float));
    r->sigma = r->noise->sigma;
    r->region_count = body->count;
    memcpy(r->models, body->models, body->count * sizeof *r->models);
    for (size_t i = 0; i < n; i++) {
        r->order[i] = (uint32_t)i;
        r->noise->local_spacing[i] = (float)s;
        if (from.labels[i] >= 0)
            crease_model_distance(
                &r->models[from.labels[i]], from.points + 3 * i, r->noise->normals + 3 * i);
    }
    return r;
}

static inline void given_regions_free(crease_regions *regions)
{
    crease_neighbours_free(regions->neighbours);
    free(regions->noise->normals);
    free(regions->noise->scores);
    free(regions->noise->local_spacing);
    free(regions->noise);
    free(regions->points);
    free(regions->labels);
    free(regions->order);
    free(regions->models);
    free(regions);
}

#endif
