/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "segment/segmentation.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "base/vector.h"

#include <math.h>
#include <string.h>

static const double normal_price = 0.5;

double crease_segmentation_price(
    const crease_segmentation *seg, const crease_model *model, size_t point)
{
    double gradient[3];
    const double distance = crease_model_distance(model, seg->points + 3 * point, gradient);
    const double r = distance / seg->sigma;
    const double cosine = fabs(crease_vector_dot(gradient, seg->noise->normals + 3 * point));
    return 0.5 * fmin(r * r, CREASE_RESIDUAL_CUT) +
        (cosine < seg->least_cosine ? normal_price : 0.0);
}

void crease_segmentation_sample(
    const crease_segmentation *seg, size_t point, const double side[3], crease_sample *sample)
{
    const double *const from = seg->points + 3 * point;
    const double *const normal = seg->noise->normals + 3 * point;
    const double sign = crease_vector_dot(normal, side) < 0.0 ? -1.0 : 1.0;
    if (sample->count == 0)
        memcpy(sample->origin, from, sizeof sample->origin);
    const size_t at = 3 * sample->count++;
    for (size_t c = 0; c < 3; c++) {
        sample->points[at + c] = from[c] - sample->origin[c];
        sample->normals[at + c] = sign * normal[c];
    }
}

void crease_segmentation_sample_points(const crease_segmentation *seg, const uint32_t *points,
    size_t count, size_t most, const crease_model *model, crease_sample *sample)
{
    const size_t taken = count < most ? count : most;
    double side[3];
    memcpy(side, seg->noise->normals + 3 * (size_t)points[0], sizeof side);
    sample->count = 0;
    for (size_t i = 0; i < taken; i++) {
        const size_t point = points[i * count / taken];
        if (model)
            crease_model_distance(model, seg->points + 3 * point, side);
        crease_segmentation_sample(seg, point, side, sample);
    }
}

/* Room for one more region. */
static crease_status reserve(crease_segmentation *seg)
{
    if (seg->region_count < seg->room)
        return CREASE_OK;
    const size_t room = 2 * seg->room + 64;
    crease_model *const models =
        crease_reallocate(seg->context, seg->models, room, sizeof *seg->models);
    if (!models)
        return CREASE_ERROR_NO_MEMORY;
    seg->models = models;
    size_t *const tried = crease_reallocate(seg->context, seg->tried, room, sizeof *seg->tried);
    if (!tried)
        return CREASE_ERROR_NO_MEMORY;
    seg->tried = tried;
    size_t *const first = crease_reallocate(seg->context, seg->first, room + 1, sizeof *seg->first);
    if (!first)
        return CREASE_ERROR_NO_MEMORY;
    seg->first = first;
    seg->room = room;
    return CREASE_OK;
}

crease_status crease_segmentation_add(crease_segmentation *seg, const crease_model *model)
{
    const crease_status status = reserve(seg);
    if (status != CREASE_OK)
        return status;
    seg->models[seg->region_count] = *model;
    seg->tried[seg->region_count++] = 0;
    return CREASE_OK;
}

void crease_segmentation_replace(crease_segmentation *seg, size_t region, const crease_model *model)
{
    crease_model_clear(&seg->models[region]);
    seg->models[region] = *model;
}

crease_status crease_segmentation_list(crease_segmentation *seg)
{
    const crease_status status = reserve(seg);
    if (status != CREASE_OK)
        return status;
    size_t *const first = seg->first;
    memset(first, 0, (seg->region_count + 1) * sizeof *first);
    for (size_t i = 0; i < seg->count; i++)
        if (seg->labels[i] >= 0)
            first[seg->labels[i]]++;
    for (size_t r = 0, sum = 0; r <= seg->region_count; r++) {
        const size_t size = first[r];
        first[r] = sum;
        sum += size;
    }
    for (size_t i = 0; i < seg->count; i++)
        if (seg->labels[i] >= 0)
            seg->members[first[seg->labels[i]]++] = (uint32_t)i;
    memmove(first + 1, first, seg->region_count * sizeof *first);
    first[0] = 0;
    return CREASE_OK;
}

/* The number of a region when those without members are gone. */
static int32_t number_after(const crease_segmentation *seg, int32_t region)
{
    int32_t number = 0;
    for (int32_t r = 0; r < region; r++)
        number += crease_segmentation_size(seg, (size_t)r) > 0;
    return number;
}

/* Lets tangent models know the numbers to come. */
static void renumber_tangents(crease_segmentation *seg)
{
    for (size_t r = 0; r < seg->region_count; r++) {
        crease_model *const model = &seg->models[r];
        for (int i = 0; i < model->tangent_count; i++) {
            if (crease_segmentation_size(seg, (size_t)model->tangent[i]) == 0)
                model->tangent_count = 0;
            else
                model->tangent[i] = number_after(seg, model->tangent[i]);
        }
    }
}

void crease_segmentation_compact(crease_segmentation *seg)
{
    renumber_tangents(seg);
    size_t kept = 0;
    for (size_t r = 0; r < seg->region_count; r++) {
        if (crease_segmentation_size(seg, r) == 0) {
            crease_model_clear(&seg->models[r]);
            continue;
        }
        for (size_t i = seg->first[r]; i < seg->first[r + 1]; i++)
            seg->labels[seg->members[i]] = (int32_t)kept;
        seg->models[kept] = seg->models[r];
        seg->tried[kept] = seg->tried[r];
        seg->first[kept++] = seg->first[r];
    }
    seg->first[kept] = seg->first[seg->region_count];
    seg->region_count = kept;
}

crease_status crease_segmentation_parallel(crease_segmentation *seg, size_t count, size_t grain,
    void (*body)(void *user, size_t begin, size_t end, int worker), void *user)
{
    const crease_status status = crease_parallel_for(seg->context, count, grain, body, user);
    if (status == CREASE_OK && atomic_load(&seg->no_memory))
        return CREASE_ERROR_NO_MEMORY;
    return status;
}
