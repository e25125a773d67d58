/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "segment/result.h"

#include "base/memory.h"
#include "base/select.h"

#include <math.h>
#include <stdlib.h>

static const double outlier_sigmas = 5.0;

typedef struct ranked {
    size_t size, region;
} ranked;

static int compare_ranks(const void *a, const void *b)
{
    const ranked *x = a, *y = b;
    if (x->size != y->size)
        return x->size > y->size ? -1 : 1;
    return x->region < y->region ? -1 : x->region > y->region;
}

/* Points far from the surface of their region, by the noise or by the region's own residuals where
 * these are larger, are no part of it. Those on rounded edges are beside it by nature. */
static void set_outliers_aside(
    crease_regions *regions, const crease_segmentation *seg, size_t region, double *scratch)
{
    const size_t begin = seg->first[region], size = crease_segmentation_size(seg, region);
    double gradient[3];
    size_t known = 0, beside = 0;
    for (size_t m = 0; m < size; m++) {
        const size_t point = seg->members[begin + m];
        if (regions->rounded && regions->rounded[point])
            continue;
        scratch[known++] =
            fabs(crease_model_distance(&seg->models[region], seg->points + 3 * point, gradient));
    }
    const double sigma = regions->noise_sigma;
    const double median = known ? crease_select(scratch, known, known / 2) : 0.0;
    const double scale = fmax(1.4826 * median, sigma);
    double squares = 0.0, cut = 0.0;
    size_t kept = 0;
    for (size_t m = 0; m < size; m++) {
        const size_t point = seg->members[begin + m];
        if (regions->rounded && regions->rounded[point]) {
            beside++;
            continue;
        }
        const double d =
            crease_model_distance(&seg->models[region], seg->points + 3 * point, gradient);
        if (fabs(d) > outlier_sigmas * scale) {
            regions->labels[point] = CREASE_NO_REGION;
            continue;
        }
        squares += d * d;
        cut += fmin(d * d / (sigma * sigma), CREASE_COST_CUT);
        kept++;
    }
    regions->sizes[region] = kept + beside;
    regions->rms[region] = kept ? sqrt(squares / (double)kept) : 0.0;
    seg->models[region].chi = kept ? cut / (double)kept : 0.0;
}

/* Numbers the regions from large to small. */
static crease_status rank_regions(crease_context *context, crease_regions *regions)
{
    const size_t count = regions->region_count;
    crease_status status = CREASE_ERROR_NO_MEMORY;
    ranked *const ranks = crease_allocate(context, count, sizeof *ranks);
    int32_t *const number = crease_allocate(context, count, sizeof *number);
    crease_model *const models = crease_duplicate(context, regions->models, count, sizeof *models);
    double *const rms = crease_duplicate(context, regions->rms, count, sizeof *rms);
    if (ranks && number && models && rms) {
        for (size_t r = 0; r < count; r++)
            ranks[r] = (ranked){regions->sizes[r], r};
        qsort(ranks, count, sizeof *ranks, compare_ranks);
        for (size_t r = 0; r < count; r++) {
            const size_t from = ranks[r].region;
            number[from] = (int32_t)r;
            regions->models[r] = models[from];
            regions->rms[r] = rms[from];
            regions->sizes[r] = ranks[r].size;
        }
        for (size_t r = 0; r < count; r++)
            for (int i = 0; i < regions->models[r].tangent_count; i++)
                regions->models[r].tangent[i] = number[models[ranks[r].region].tangent[i]];
        for (size_t i = 0; i < regions->count; i++)
            if (regions->labels[i] >= 0)
                regions->labels[i] = number[regions->labels[i]];
        status = CREASE_OK;
    }
    free(ranks);
    free(number);
    free(models);
    free(rms);
    return status;
}

crease_status crease_regions_take(
    crease_context *context, crease_regions *regions, crease_segmentation *seg)
{
    const size_t count = seg->region_count;
    regions->sizes = crease_allocate(context, count, sizeof *regions->sizes);
    regions->rms = crease_allocate(context, count, sizeof *regions->rms);
    double *const scratch = crease_allocate(context, regions->count, sizeof *scratch);
    const bool enough = regions->sizes && regions->rms && scratch;
    regions->sigma = seg->sigma;
    regions->noise_sigma = seg->sigma / sqrt(seg->alike);
    for (size_t r = 0; r < count && enough; r++)
        set_outliers_aside(regions, seg, r, scratch);
    free(scratch);
    if (!enough)
        return CREASE_ERROR_NO_MEMORY;
    regions->models = seg->models;
    regions->region_count = count;
    seg->models = NULL;
    seg->region_count = 0;
    return rank_regions(context, regions);
}
