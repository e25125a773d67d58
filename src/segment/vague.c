/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "segment/vague.h"

#include "base/memory.h"
#include "base/vector.h"

#include <math.h>
#include <stdlib.h>

enum {
    MEASURED = 300, /* points that tell how well a region fits, */
    LOOKED_AT = 32, /* and how much it turns */
    SMALL = 60,     /* points of a plane that may be a piece of something else */
    FEW = 150       /* and of other pieces */
};

static const double FLAT_COSINE = 0.966; /* 15 degrees from the mean normal */
static const double EXACT = 0.01; /* mean square residual, in square sigmas, of what fits exactly */
static const double ROUGH = 3.0;  /* times the deviation of exact primitives: none of its own */

bool crease_region_is_form(const crease_segmentation *seg, size_t region)
{
    return seg->models[region].type == CREASE_REGION_FREEFORM;
}

/* Mean of the cut squared residuals, in square sigmas, of some of a region's points. */
static double residual_of(const crease_segmentation *seg, size_t region)
{
    const uint32_t *const members = seg->members + seg->first[region];
    const size_t size = crease_segmentation_size(seg, region);
    const size_t taken = size < MEASURED ? size : MEASURED;
    double sum = 0.0, gradient[3];
    for (size_t i = 0; i < taken; i++) {
        const double *const place = seg->points + 3 * (size_t)members[i * size / taken];
        const double r = crease_model_distance(&seg->models[region], place, gradient) / seg->sigma;
        sum += fmin(r * r, CREASE_RESIDUAL_CUT);
    }
    return sum / (double)taken;
}

static bool is_rough(const crease_segmentation *seg, double rough, size_t region)
{
    return !crease_region_is_form(seg, region) && residual_of(seg, region) > rough;
}

struct weighted {
    double residual;
    size_t size;
};

static int compare_residuals(const void *first, const void *second)
{
    const struct weighted *const a = first, *const b = second;
    if (a->residual != b->residual)
        return a->residual < b->residual ? -1 : 1;
    return a->size < b->size ? -1 : a->size > b->size;
}

crease_status crease_vague_find_rough(const crease_segmentation *seg, double *out)
{
    struct weighted *const all = crease_allocate(seg->context, seg->region_count, sizeof *all);
    size_t count = 0, points = 0, below = 0, i = 0;
    if (!all)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t r = 0; r < seg->region_count; r++)
        if (!crease_region_is_form(seg, r) && crease_segmentation_size(seg, r) > 0) {
            all[count++] = (struct weighted){residual_of(seg, r), crease_segmentation_size(seg, r)};
            points += crease_segmentation_size(seg, r);
        }
    qsort(all, count, sizeof *all, compare_residuals);
    while (i < count && 2 * (below += all[i].size) < points)
        i++;
    *out = ROUGH * ROUGH * fmax(EXACT, i < count ? all[i].residual : INFINITY);
    free(all);
    return CREASE_OK;
}

/* Whether the normals of a region turn so little that its kind is a guess. */
static bool is_flat(const crease_segmentation *seg, size_t region)
{
    const uint32_t *const members = seg->members + seg->first[region];
    const size_t size = crease_segmentation_size(seg, region);
    const size_t taken = size < LOOKED_AT ? size : LOOKED_AT;
    double gradients[LOOKED_AT][3], mean[3] = {0.0};
    for (size_t i = 0; i < taken; i++) {
        const double *const place = seg->points + 3 * (size_t)members[i * size / taken];
        crease_model_distance(&seg->models[region], place, gradients[i]);
        for (int c = 0; c < 3; c++)
            mean[c] += gradients[i][c];
    }
    crease_vector_normalise(mean);
    for (size_t i = 0; i < taken; i++)
        if (crease_vector_dot(gradients[i], mean) < FLAT_COSINE)
            return false;
    return true;
}

bool crease_region_is_vague(const crease_segmentation *seg, double rough, size_t region)
{
    if (crease_region_is_form(seg, region) || is_rough(seg, rough, region))
        return true;
    if (seg->models[region].type == CREASE_REGION_PLANE)
        return crease_segmentation_size(seg, region) < SMALL;
    return crease_segmentation_size(seg, region) < FEW && is_flat(seg, region);
}

bool crease_region_is_rich(const crease_segmentation *seg, double rough, size_t region)
{
    const crease_patch *const patch = &seg->models[region].patch;
    return is_rough(seg, rough, region) ||
        (crease_region_is_form(seg, region) && (patch->spline || patch->degree > 2));
}
