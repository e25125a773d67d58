/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "segment/surroundings.h"

#include "base/memory.h"
#include "base/store.h"
#include "cloud/cloud.h"
#include "noise/blur.h"
#include "space/morton.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Marks the points on rounded edges, if the scanner has rounded them all. */
static crease_status find_rounded(crease_context *context, crease_regions *regions)
{
    bool blurred = false;
    if (!(regions->noise->alike > 1.0))
        return CREASE_OK;
    regions->rounded = crease_allocate(context, regions->count, sizeof *regions->rounded);
    if (!regions->rounded)
        return CREASE_ERROR_NO_MEMORY;
    const crease_status status = crease_blur_find(
        context, regions->points, regions->count, regions->noise, &blurred, regions->rounded);
    if (!blurred) {
        free(regions->rounded);
        regions->rounded = NULL;
    }
    return status;
}

/* The points in Morton order. */
static crease_status sort_points(
    crease_context *context, crease_regions *regions, const crease_cloud *cloud)
{
    const size_t count = regions->count;
    regions->order = crease_allocate(context, count, sizeof *regions->order);
    regions->points = crease_allocate(context, count, 3 * sizeof *regions->points);
    regions->labels = crease_allocate(context, count, sizeof *regions->labels);
    uint64_t *const keys = crease_allocate(context, count, sizeof *keys);
    crease_status status = CREASE_ERROR_NO_MEMORY;
    if (regions->order && regions->points && regions->labels && keys)
        status =
            crease_morton_sort(context, crease_cloud_points(cloud), count, keys, regions->order);
    free(keys);
    for (size_t i = 0; i < count && status == CREASE_OK; i++)
        memcpy(regions->points + 3 * i, crease_cloud_points(cloud) + 3 * (size_t)regions->order[i],
            3 * sizeof(double));
    return status;
}

crease_status crease_surroundings_here(crease_context *context, void *user, const double *points,
    size_t count, int k, crease_neighbours **neighbours, crease_noise **noise)
{
    (void)user;
    const crease_cloud sorted = {.count = count, .points = (double *)(uintptr_t)points};
    const crease_status status = crease_neighbours_find(context, &sorted, k, neighbours);
    return status == CREASE_OK ? crease_noise_estimate_from(context, points, *neighbours, noise)
                               : status;
}

static void list_arrays(const crease_regions *regions, double numbers[3], crease_stored arrays[5])
{
    const crease_noise *const noise = regions->noise;
    const size_t count = regions->count, k = (size_t)regions->neighbours->k;
    arrays[0] = (crease_stored){regions->neighbours->indices, count * k * sizeof(uint32_t)};
    arrays[1] = (crease_stored){noise->normals, 3 * count * sizeof *noise->normals};
    arrays[2] = (crease_stored){noise->scores, count * sizeof *noise->scores};
    arrays[3] = (crease_stored){noise->local_spacing, count * sizeof *noise->local_spacing};
    arrays[4] = (crease_stored){numbers, 3 * sizeof *numbers};
}

static uint64_t key_of(const crease_regions *regions)
{
    const uint64_t key = crease_store_key(0, crease_version(), strlen(crease_version()));
    return crease_store_key(key, regions->points, 3 * regions->count * sizeof *regions->points);
}

/* What is known of the surroundings already. *known: false when it is nothing. */
static crease_status load(crease_context *context, crease_regions *regions, int k, bool *known)
{
    crease_stored arrays[5];
    double numbers[3];
    crease_status status =
        crease_neighbours_create(context, regions->count, k, &regions->neighbours);
    if (status == CREASE_OK)
        status = crease_noise_create(context, regions->count, &regions->noise);
    if (status != CREASE_OK)
        return status;
    list_arrays(regions, numbers, arrays);
    *known = crease_store_load(context, "surroundings", key_of(regions), arrays, 5);
    if (*known) {
        regions->noise->spacing = numbers[0];
        regions->noise->sigma = numbers[1];
        regions->noise->alike = numbers[2];
        return CREASE_OK;
    }
    crease_neighbours_free(regions->neighbours);
    crease_noise_free(regions->noise);
    regions->neighbours = NULL;
    regions->noise = NULL;
    return CREASE_OK;
}

static void save(crease_context *context, const crease_regions *regions)
{
    crease_stored arrays[5];
    double numbers[3] = {regions->noise->spacing, regions->noise->sigma, regions->noise->alike};
    list_arrays(regions, numbers, arrays);
    crease_store_save(context, "surroundings", key_of(regions), arrays, 5);
}

crease_status crease_regions_surround(crease_context *context, crease_regions *regions,
    const crease_cloud *cloud, crease_surroundings_find *find, void *user)
{
    const int k =
        regions->count < CREASE_NOISE_NEIGHBOURS ? (int)regions->count : CREASE_NOISE_NEIGHBOURS;
    bool known = false;
    crease_status status = sort_points(context, regions, cloud);
    if (status == CREASE_OK && context->kept)
        status = load(context, regions, k, &known);
    if (status == CREASE_OK && !known) {
        status = find(context, user, regions->points, regions->count, k, &regions->neighbours,
            &regions->noise);
        if (status == CREASE_OK && context->kept)
            save(context, regions);
    }
    return status == CREASE_OK ? find_rounded(context, regions) : status;
}

static crease_status copy_surroundings(
    crease_context *context, crease_regions *regions, const crease_regions *from)
{
    const size_t n = from->count, k = (size_t)from->neighbours->k;
    crease_status status =
        crease_neighbours_create(context, n, from->neighbours->k, &regions->neighbours);
    if (status == CREASE_OK)
        status = crease_noise_create(context, n, &regions->noise);
    if (status != CREASE_OK)
        return status;
    crease_noise *const noise = regions->noise;
    noise->spacing = from->noise->spacing;
    noise->sigma = from->noise->sigma;
    noise->alike = from->noise->alike;
    memcpy(regions->neighbours->indices, from->neighbours->indices, n * k * sizeof(uint32_t));
    memcpy(noise->normals, from->noise->normals, 3 * n * sizeof *noise->normals);
    memcpy(noise->scores, from->noise->scores, n * sizeof *noise->scores);
    memcpy(noise->local_spacing, from->noise->local_spacing, n * sizeof *noise->local_spacing);
    return CREASE_OK;
}

crease_status crease_regions_surround_like(
    crease_context *context, crease_regions *regions, const crease_regions *from)
{
    const size_t n = regions->count = from->count;
    regions->order = crease_duplicate(context, from->order, n, sizeof *from->order);
    regions->points = crease_duplicate(context, from->points, n, 3 * sizeof *from->points);
    regions->labels = crease_duplicate(context, from->labels, n, sizeof *from->labels);
    if (!regions->order || !regions->points || !regions->labels)
        return CREASE_ERROR_NO_MEMORY;
    if (from->rounded) {
        regions->rounded = crease_duplicate(context, from->rounded, n, sizeof *from->rounded);
        if (!regions->rounded)
            return CREASE_ERROR_NO_MEMORY;
    }
    return copy_surroundings(context, regions, from);
}
