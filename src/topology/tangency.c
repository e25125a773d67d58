/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Gauss-Newton on the distances of the points, and, with great weight, on the gaps between the
 * surfaces along their lines of contact. As a gap is least (or greatest) across that line, its
 * derivative is that of one surface's distance alone. */
#include "topology/tangency.h"

#include "base/memory.h"
#include "base/symmetric.h"
#include "base/vector.h"
#include "primitive/primitive.h"
#include "topology/contact.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    LEAST_LINKS = 20,
    PLACES = 24,      /* of each line of contact */
    LEAST_PLACES = 4, /* that a fit is tangent at */
    MOST_POINTS = 20000,
    STEPS = 25,
    N = CREASE_PRIMITIVE_PARAMETERS
};

/* In spacings. */
static const double AROUND = 5.0;
static const double FROM_LINKS = 2.5;
static const double FROM_PLACE = 3.0;
static const double FOREIGN = 0.05; /* and 4 sigma: distance of points that are left out */

static const double LEAST_COSINE = 0.978; /* 12 degrees between surfaces that join smoothly */
static const double WEIGHT = 3e4;         /* of the places, all together, against the points */
static const double MOST_CHI = 0.15;      /* that the points may fit worse */
static const double CUT = 9.0;

/* A place of a line of contact. */
struct touch {
    uint32_t other;
    double place[3], along[3];
};

struct fit {
    const crease_graph *graph;
    crease_model *models;
    const size_t *sizes;
    uint32_t region;
    size_t touch_count, touch_room;
    struct touch *touches;
    size_t point_count;
    double *points;
    double pivot[3];
};

/* -------------------------------------------------------------------------------- places -- */

static void models_of(const struct fit *fit, uint32_t other, const crease_model *out[2])
{
    out[0] = &fit->models[fit->region];
    out[1] = &fit->models[other];
}

/* The signed gap beside a place; moves the place onto the line. False when there is none near. */
static bool gap_at(const struct fit *fit, const struct touch *touch, double place[3], double *gap)
{
    const double s = fit->graph->survey->spacing;
    const crease_model *models[2];
    double first[3], second[3];
    models_of(fit, touch->other, models);
    memcpy(place, touch->place, sizeof touch->place);
    if (!crease_contact_place(models, touch->along, s, place) ||
        crease_vector_distance(place, touch->place) > FROM_PLACE * s)
        return false;
    const double a = crease_model_distance(models[0], place, first);
    const double b = crease_model_distance(models[1], place, second);
    const double cosine = crease_vector_dot(first, second);
    *gap = cosine > 0.0 ? a - b : a + b;
    return fabs(cosine) >= LEAST_COSINE;
}

static void add_touch(struct fit *fit, const crease_loose *loose, size_t link)
{
    const double s = fit->graph->survey->spacing;
    struct touch touch = {.other = loose->regions[loose->regions[0] == fit->region ? 1 : 0]};
    double place[3], gap;
    if (crease_loose_direction(
            loose, loose->places + 3 * link, AROUND * s, touch.place, touch.along) < LEAST_PLACES ||
        !gap_at(fit, &touch, place, &gap) ||
        crease_vector_distance(place, touch.place) > FROM_LINKS * s)
        return;
    memcpy(touch.place, place, sizeof place);
    fit->touches[fit->touch_count++] = touch;
}

static crease_status add_touches(struct fit *fit, const crease_loose *loose)
{
    const size_t stride = loose->count / PLACES + 1;
    const size_t room = fit->touch_count + loose->count / stride + 1;
    if (room > fit->touch_room) {
        struct touch *const touches =
            crease_reallocate(fit->graph->context, fit->touches, room, sizeof *touches);
        if (!touches)
            return CREASE_ERROR_NO_MEMORY;
        fit->touches = touches;
        fit->touch_room = room;
    }
    for (size_t i = 0; i < loose->count; i += stride)
        add_touch(fit, loose, i);
    return CREASE_OK;
}

/* Of all larger regions that the region joins smoothly. */
static crease_status find_touches(struct fit *fit, const crease_links *links)
{
    crease_status status = CREASE_OK;
    fit->touch_count = 0;
    for (size_t begin = 0; begin < links->count && status == CREASE_OK;) {
        const size_t end = crease_links_run(links, begin);
        const uint32_t *const pair = links->items[begin].regions;
        const uint32_t other = pair[pair[0] == fit->region ? 1 : 0];
        crease_loose loose = {.count = 0};
        if ((pair[0] == fit->region || pair[1] == fit->region) && end - begin >= LEAST_LINKS &&
            fit->sizes[other] >= fit->sizes[fit->region])
            status = crease_loose_find(fit->graph, links, begin, end, &loose);
        if (status == CREASE_OK && loose.count >= LEAST_LINKS)
            status = add_touches(fit, &loose);
        crease_loose_clear(&loose);
        begin = end;
    }
    return status;
}

/* -------------------------------------------------------------------------------- points -- */

static crease_status take_points(struct fit *fit)
{
    const crease_regions *const r = fit->graph->survey->regions;
    const size_t stride = fit->sizes[fit->region] / MOST_POINTS + 1;
    size_t seen = 0;
    fit->points = crease_allocate(
        fit->graph->context, fit->sizes[fit->region] / stride + 1, 3 * sizeof *fit->points);
    if (!fit->points)
        return CREASE_ERROR_NO_MEMORY;
    fit->point_count = 0;
    memset(fit->pivot, 0, sizeof fit->pivot);
    for (size_t i = 0; i < r->count; i++)
        if (r->labels[i] == (int32_t)fit->region && seen++ % stride == 0)
            memcpy(
                fit->points + 3 * fit->point_count++, r->points + 3 * i, 3 * sizeof *fit->points);
    for (size_t i = 0; i < fit->point_count; i++)
        for (size_t c = 0; c < 3; c++)
            fit->pivot[c] += fit->points[3 * i + c] / (double)fit->point_count;
    return CREASE_OK;
}

/* Mean of the squared distances by the noise, each cut. */
static double chi_of(const struct fit *fit)
{
    double sum = 0.0, gradient[3];
    for (size_t i = 0; i < fit->point_count; i++) {
        const double distance =
            crease_model_distance(&fit->models[fit->region], fit->points + 3 * i, gradient) /
            fit->graph->survey->sigma;
        sum += fmin(distance * distance, CUT);
    }
    return sum / (double)fit->point_count;
}

/* ---------------------------------------------------------------------------------- fit -- */

struct equations {
    double matrix[N * N], right[N];
};

static void add_row(const struct fit *fit, const double place[3], double residual, double weight,
    struct equations *to)
{
    const crease_model *const model = &fit->models[fit->region];
    double gradient[3], change[N];
    const double distance = crease_model_distance(model, place, gradient);
    crease_primitive_derivatives(model, place, distance, gradient, fit->pivot, change);
    for (int i = 0; i < N; i++) {
        to->right[i] -= weight * change[i] * residual;
        for (int k = 0; k < N; k++)
            to->matrix[N * i + k] += weight * change[i] * change[k];
    }
}

static void add_rows(const struct fit *fit, struct equations *to)
{
    const crease_survey *const survey = fit->graph->survey;
    const double foreign = 4.0 * survey->sigma + FOREIGN * survey->spacing;
    const double weight = WEIGHT * (double)fit->point_count / (double)fit->touch_count;
    for (size_t i = 0; i < fit->point_count; i++) {
        double gradient[3];
        const double distance =
            crease_model_distance(&fit->models[fit->region], fit->points + 3 * i, gradient);
        if (fabs(distance) < foreign)
            add_row(fit, fit->points + 3 * i, distance, 1.0, to);
    }
    for (size_t i = 0; i < fit->touch_count; i++) {
        double place[3], gap;
        if (gap_at(fit, &fit->touches[i], place, &gap))
            add_row(fit, place, gap, weight, to);
    }
}

static bool improve(const struct fit *fit)
{
    struct equations equations = {.right = {0.0}};
    double largest = 0.0;
    add_rows(fit, &equations);
    for (int i = 0; i < N; i++)
        largest = fmax(largest, equations.matrix[N * i + i]);
    for (int i = 0; i < N; i++)
        equations.matrix[N * i + i] += 1e-12 * largest;
    if (!(largest > 0.0) || !crease_symmetric_factor(equations.matrix, N, N, N - 1))
        return false;
    crease_symmetric_solve(equations.matrix, N, N, N - 1, equations.right);
    crease_primitive_change(&fit->models[fit->region], fit->pivot, equations.right);
    return true;
}

static crease_status refit(struct fit *fit, bool *changed)
{
    crease_model *const model = &fit->models[fit->region];
    const crease_model before = *model;
    crease_status status = take_points(fit);
    if (status == CREASE_OK) {
        const double chi = chi_of(fit);
        bool fine = true;
        for (int i = 0; i < STEPS && fine; i++)
            fine = improve(fit);
        fine = fine && model->radius > 0.0 && chi_of(fit) < chi + MOST_CHI;
        if (!fine)
            *model = before;
        *changed = *changed || fine;
    }
    free(fit->points);
    fit->points = NULL;
    return status;
}

/* A fillet that is tangent to its planes by construction would not be so afterwards. */
static bool can_change(const crease_model *model)
{
    return model->tangent_count == 0 && model->type != CREASE_REGION_PLANE &&
        model->type != CREASE_REGION_FREEFORM;
}

/* The largest region below a size and number, or SIZE_MAX. */
static size_t next_smaller(const size_t *sizes, size_t count, size_t last)
{
    size_t next = SIZE_MAX;
    for (size_t i = 0; i < count; i++) {
        const bool later =
            last == SIZE_MAX || sizes[i] < sizes[last] || (sizes[i] == sizes[last] && i > last);
        if (later && (next == SIZE_MAX || sizes[i] > sizes[next]))
            next = i;
    }
    return next;
}

crease_status crease_tangency_impose(
    const crease_graph *graph, const crease_links *links, crease_model *models, bool *changed)
{
    const crease_regions *const r = graph->survey->regions;
    size_t *const sizes = crease_allocate(graph->context, r->region_count, sizeof *sizes);
    struct fit fit = {.graph = graph, .models = models, .sizes = sizes};
    crease_status status = sizes ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    *changed = false;
    for (size_t i = 0; i < r->count && status == CREASE_OK; i++)
        if (r->labels[i] >= 0)
            sizes[r->labels[i]]++;
    for (size_t i = SIZE_MAX; status == CREASE_OK;) {
        i = next_smaller(sizes, r->region_count, i);
        if (i == SIZE_MAX)
            break;
        fit.region = (uint32_t)i;
        if (!can_change(&models[i]) || sizes[i] == 0)
            continue;
        status = find_touches(&fit, links);
        if (status == CREASE_OK && fit.touch_count >= LEAST_PLACES)
            status = refit(&fit, changed);
    }
    free(fit.touches);
    free(sizes);
    return status;
}
