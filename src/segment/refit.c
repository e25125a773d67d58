/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Models fitted again to the regions they have by now, and the noise measured again from them.
 * Points next to other regions are left out where there are enough others: their labels were chosen
 * by their distances, so they bend a surface towards where it is already. In the last fit of free
 * forms those too far from the other regions' surfaces to be of them stay: without them a free form
 * swings at its border. Tubes and balls are fitted to all: a spline of many spans would be free
 * there. */
#include "segment/segmentation.h"

#include "base/memory.h"
#include "base/select.h"

#include <math.h>
#include <stdlib.h>

enum { GRAIN = 4096, LEAST_MEMBERS = 6, LEAST_INTERIOR = 30, LARGE_FREEFORM = 1000 };
enum { DEEP_REGION = 60, LEAST_RESIDUALS = 200 };

static const double least_sigma = 0.03; /* in spacings, as in noise/noise.c */
static const double least_share = 0.8;  /* of the first estimate: residuals that are smaller still
                                           come of too many regions */
static const double certain = 4.0;      /* sigmas from another surface that no point of it has */

typedef struct refitting {
    crease_segmentation *seg;
    size_t sample;
    int depth;       /* neighbours that must have the same label */
    bool keep_kinds; /* a surface that still fits to the noise keeps its kind */
    bool last;       /* only large free forms, as close as they can be; points that are certain
                        count as interior */
    uint8_t *interior;
} refitting;

/* Whether a point that has neighbours of other regions cannot be of theirs, wherever it would lie
 * without its error across its own surface: so no side of the surface is preferred. */
static bool is_certain(const crease_segmentation *seg, size_t point, int depth)
{
    const uint32_t *const near = crease_segmentation_near(seg, point);
    const int32_t own = seg->labels[point];
    double gradient[3], foot[3];
    if (own < 0)
        return false;
    const double away = crease_model_distance(&seg->models[own], seg->points + 3 * point, gradient);
    for (size_t c = 0; c < 3; c++)
        foot[c] = seg->points[3 * point + c] - away * gradient[c];
    for (int j = 1; j <= depth; j++) {
        const int32_t label = seg->labels[near[j]];
        if (label == own)
            continue;
        if (label < 0 ||
            fabs(crease_model_distance(&seg->models[label], foot, gradient)) < certain * seg->sigma)
            return false;
    }
    return true;
}

static void find_interior(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const refitting *run = user;
    const crease_segmentation *const seg = run->seg;
    for (size_t i = begin; i < end; i++) {
        const uint32_t *const near = crease_segmentation_near(seg, i);
        int j = 1;
        while (j <= run->depth && seg->labels[near[j]] == seg->labels[i])
            j++;
        run->interior[i] = seg->labels[i] >= 0 &&
            (j > run->depth || (run->last && is_certain(seg, i, run->depth)));
    }
}

/* At most run->sample points of the region, evenly, from its interior when that is half of it. */
static void sample_region(const refitting *run, size_t region, crease_sample *sample)
{
    const crease_segmentation *const seg = run->seg;
    const size_t begin = seg->first[region], end = seg->first[region + 1], size = end - begin;
    size_t inside = 0, passed = 0;
    double side[3];
    for (size_t m = begin; m < end; m++)
        inside += run->interior[seg->members[m]];
    const crease_patch *const patch = &seg->models[region].patch;
    const bool all = 2 * inside < size || inside < LEAST_INTERIOR || patch->round || patch->ball;
    const size_t count = all ? size : inside, taken = count < run->sample ? count : run->sample;
    sample->count = 0;
    for (size_t m = begin; m < end && sample->count < taken; m++) {
        const size_t point = seg->members[m];
        if (!all && !run->interior[point])
            continue;
        if (passed++ < sample->count * count / taken)
            continue;
        crease_model_distance(&seg->models[region], seg->points + 3 * point, side);
        crease_segmentation_sample(seg, point, side, sample);
    }
}

static bool is_simple(const crease_model *model)
{
    return model->type != CREASE_REGION_FREEFORM ||
        (!model->patch.spline && model->patch.degree == 2);
}

/* The same kind of surface, where it still fits to the noise. */
static bool fit_again(const refitting *run, size_t region, crease_fitter *fitter)
{
    const crease_model *const old = &run->seg->models[region];
    const double most = 1.0 + 3.0 * sqrt(2.0 / (double)fitter->sample.count);
    return crease_fit_kind(fitter, &fitter->sample, old->type, old) && fitter->best.chi < most;
}

static bool fit(const refitting *run, size_t region, crease_fitter *fitter)
{
    const crease_model *const old = &run->seg->models[region];
    const crease_sample *const sample = &fitter->sample;
    if (run->keep_kinds && is_simple(old) && fit_again(run, region, fitter))
        return true;
    return crease_fit_choose(fitter, sample, run->last ? CREASE_RULE_AKAIKE : CREASE_RULE_BAYES,
        crease_fit_level_for(sample->count), old, INFINITY);
}

static void refit_region(const refitting *run, size_t region, crease_fitter *fitter)
{
    crease_segmentation *const seg = run->seg;
    const size_t size = crease_segmentation_size(seg, region);
    const crease_model *const old = &seg->models[region];
    if (size < LEAST_MEMBERS ||
        (run->last && (old->type != CREASE_REGION_FREEFORM || size < LARGE_FREEFORM)))
        return;
    sample_region(run, region, &fitter->sample);
    if (!fit(run, region, fitter))
        return;
    crease_model model;
    crease_fit_covariance(fitter, &fitter->sample, &fitter->best);
    if (crease_model_copy(seg->context, &fitter->best, &model) != CREASE_OK) {
        atomic_store(&seg->no_memory, true);
        return;
    }
    if (model.type != old->type)
        seg->tried[region] = 0;
    crease_segmentation_replace(seg, region, &model);
}

static void refit_regions(void *user, size_t begin, size_t end, int worker)
{
    const refitting *run = user;
    for (size_t region = begin; region < end; region++)
        refit_region(run, region, &run->seg->fitters[worker]);
}

static crease_status refit(refitting *run)
{
    crease_segmentation *const seg = run->seg;
    run->depth = seg->border_links;
    run->interior = crease_allocate(seg->context, seg->count, sizeof *run->interior);
    if (!run->interior)
        return CREASE_ERROR_NO_MEMORY;
    crease_status status = crease_segmentation_parallel(seg, seg->count, GRAIN, find_interior, run);
    if (status == CREASE_OK)
        status = crease_segmentation_parallel(seg, seg->region_count, 1, refit_regions, run);
    free(run->interior);
    return status;
}

crease_status crease_refit(crease_segmentation *seg, size_t sample, bool keep_kinds)
{
    refitting run = {.seg = seg, .sample = sample, .keep_kinds = keep_kinds};
    return refit(&run);
}

crease_status crease_refit_closely(crease_segmentation *seg)
{
    refitting run = {.seg = seg, .sample = CREASE_SAMPLE_POINTS, .last = true};
    return refit(&run);
}

static bool is_deep(const crease_segmentation *seg, size_t point)
{
    const uint32_t *const near = crease_segmentation_near(seg, point);
    for (size_t j = 1; j < seg->stride; j++)
        if (seg->labels[near[j]] != seg->labels[point])
            return false;
    return true;
}

crease_status crease_measure_noise(crease_segmentation *seg)
{
    if (seg->known_sigma)
        return CREASE_OK;
    double *const residuals = crease_allocate(seg->context, seg->count, sizeof *residuals);
    if (!residuals)
        return CREASE_ERROR_NO_MEMORY;
    size_t count = 0;
    double gradient[3];
    for (size_t i = 0; i < seg->count; i++) {
        const int32_t label = seg->labels[i];
        if (label < 0 || crease_segmentation_size(seg, (size_t)label) < DEEP_REGION ||
            !is_deep(seg, i))
            continue;
        residuals[count++] =
            fabs(crease_model_distance(&seg->models[label], seg->points + 3 * i, gradient));
    }
    const double least = fmax(least_sigma * seg->spacing, least_share * seg->noise->sigma);
    if (count > LEAST_RESIDUALS)
        seg->sigma = fmax(1.4826 * crease_select(residuals, count, count / 2), least);
    free(residuals);
    return CREASE_OK;
}
