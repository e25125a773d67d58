/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Region growing from the smoothest points outwards. A model is fitted to a seed's neighbours;
 * points next to the region join while they fit its model, half as many again at a time, and the
 * model is chosen anew, so that it learns its curvature before it reaches far.
 *
 * Three passes: seeds on smooth ground, then with looser seeds, then with small ones for small
 * faces. Points that have a label but are not explained by their region may be taken over.
 *
 * Based on: Besl, Jain. Segmentation through variable-order surface fitting. 1988. */
#include "segment/segmentation.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "base/vector.h"

#include <math.h>
#include <stdlib.h>

enum { MOST_ROUNDS = 60, SAMPLE = 800, GRAIN = 4096, PATIENCE = 4096 };

static const double stay_within = 3.0, join_within = 2.5; /* in sigma */
static const double unexplained = 4.0; /* price of a labelled point that is free */
static const double worst_seed = 2.5;  /* chi of a seed's model */
static const double loose_cosine = 0.5;

/* How seeds are taken in one pass. */
typedef struct pass {
    int neighbours;
    double least_cosine; /* between the normals of a seed and its neighbours */
    size_t least_points; /* of a region */
} pass;

typedef struct growth {
    crease_segmentation *seg;
    uint32_t *order; /* points from smooth to rough */
    float *roughness;
    uint32_t *members; /* of the region that grows */
    size_t member_count;
    uint8_t *free;   /* has no region that explains it */
    uint8_t *inside; /* is a member; all zero between regions */
} growth;

static void find_free(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const growth *run = user;
    const crease_segmentation *const seg = run->seg;
    for (size_t i = begin; i < end; i++) {
        const int32_t label = seg->labels[i];
        run->free[i] =
            label < 0 || crease_segmentation_price(seg, &seg->models[label], i) > unexplained;
        double sum = 0.0;
        const uint32_t *const near = crease_segmentation_near(seg, i);
        for (size_t j = 0; j < seg->stride; j++)
            sum += (double)seg->noise->scores[near[j]];
        run->roughness[i] = (float)sum;
    }
}

/* Sorts by roughness, ties by position, via the bits of the floats, which are not negative: two
 * 16-bit radix passes. */
static crease_status sort_by_roughness(growth *run)
{
    const size_t count = run->seg->count, buckets = (size_t)1 << 16;
    size_t *const starts = crease_allocate(run->seg->context, buckets + 1, sizeof *starts);
    if (!starts)
        return CREASE_ERROR_NO_MEMORY;
    uint32_t *from = run->members, *to = run->order;
    for (size_t i = 0; i < count; i++)
        from[i] = (uint32_t)i;
    for (int shift = 0; shift <= 16; shift += 16) {
        for (size_t b = 0; b <= buckets; b++)
            starts[b] = 0;
        for (size_t i = 0; i < count; i++) {
            const union {
                float f;
                uint32_t u;
            } key = {run->roughness[i]};
            starts[(key.u >> shift & 0xffff) + 1]++;
        }
        for (size_t b = 0; b < buckets; b++)
            starts[b + 1] += starts[b];
        for (size_t i = 0; i < count; i++) {
            const union {
                float f;
                uint32_t u;
            } key = {run->roughness[from[i]]};
            to[starts[key.u >> shift & 0xffff]++] = from[i];
        }
        uint32_t *const swap = from;
        from = to;
        to = swap;
    }
    run->order = from;
    run->members = to;
    free(starts);
    return CREASE_OK;
}

static bool fits(
    const crease_segmentation *seg, const crease_model *model, size_t point, double within)
{
    double gradient[3];
    const double distance = crease_model_distance(model, seg->points + 3 * point, gradient);
    return fabs(distance) < within * seg->sigma &&
        fabs(crease_vector_dot(gradient, seg->noise->normals + 3 * point)) > seg->least_cosine;
}

/* The seed and those of its neighbours that face the same way. */
static bool begin(growth *run, size_t seed, const pass *how, crease_fitter *fitter)
{
    const crease_segmentation *const seg = run->seg;
    const uint32_t *const near = crease_segmentation_near(seg, seed);
    const double *const normals = seg->noise->normals;
    run->member_count = 0;
    run->members[run->member_count++] = (uint32_t)seed;
    for (int j = 1; j <= how->neighbours; j++) {
        const double cosine = crease_vector_dot(normals + 3 * (size_t)near[j], normals + 3 * seed);
        if (run->free[near[j]] && fabs(cosine) > how->least_cosine)
            run->members[run->member_count++] = near[j];
    }
    const size_t count = run->member_count;
    if (count < (how->neighbours < 12 ? 6u : 10u))
        return false;
    const bool loose = how->least_cosine < seg->least_cosine && count >= 10;
    crease_segmentation_sample_points(seg, run->members, count, SAMPLE, NULL, &fitter->sample);
    return crease_fit_choose(fitter, &fitter->sample, CREASE_RULE_GROWING,
               loose ? CREASE_LEVEL_ROUND : crease_fit_level_for(count), NULL, INFINITY) &&
        fitter->best.chi <= worst_seed;
}

/* Lets members go that no longer fit, and takes in free points around. Returns whether there were
 * more of these than one round takes. */
static bool spread(growth *run, const crease_model *model)
{
    const crease_segmentation *const seg = run->seg;
    uint32_t *const members = run->members;
    size_t count = 0;
    for (size_t i = 0; i < run->member_count; i++)
        if (fits(seg, model, members[i], stay_within)) {
            run->inside[members[i]] = 1;
            members[count++] = members[i];
        }
    const size_t most = count + count / 2 + 10;
    for (size_t i = 0; i < count && count < most; i++) {
        const uint32_t *const near = crease_segmentation_near(seg, members[i]);
        for (int j = 1; j <= seg->links; j++)
            if (!run->inside[near[j]] && run->free[near[j]] &&
                fits(seg, model, near[j], join_within)) {
                run->inside[near[j]] = 1;
                members[count++] = near[j];
            }
    }
    for (size_t i = 0; i < count; i++)
        run->inside[members[i]] = 0;
    run->member_count = count;
    return count >= most;
}

/* Grows one region; its model is fitter->best then. */
static bool grow(growth *run, size_t seed, const pass *how, crease_fitter *fitter)
{
    crease_sample *const sample = &fitter->sample;
    if (!begin(run, seed, how, fitter))
        return false;
    crease_model *const model = &fitter->best;
    size_t last = 0;
    for (int round = 0; round < MOST_ROUNDS; round++) {
        const bool more = spread(run, model);
        if (run->member_count < how->least_points)
            return false;
        if (!more && (double)run->member_count <= 1.02 * (double)last)
            break;
        last = run->member_count;
        crease_segmentation_sample_points(
            run->seg, run->members, run->member_count, SAMPLE, model, sample);
        const crease_model warm = *model;
        if (!crease_fit_choose(fitter, sample, CREASE_RULE_GROWING,
                crease_fit_level_for(run->member_count), &warm, INFINITY))
            return false;
    }
    return true;
}

static crease_status accept(growth *run, const crease_fitter *fitter)
{
    crease_segmentation *const seg = run->seg;
    crease_model model;
    crease_status status = crease_model_copy(seg->context, &fitter->best, &model);
    if (status == CREASE_OK)
        status = crease_segmentation_add(seg, &model);
    if (status != CREASE_OK) {
        crease_model_clear(&model);
        return status;
    }
    for (size_t i = 0; i < run->member_count; i++) {
        seg->labels[run->members[i]] = (int32_t)(seg->region_count - 1);
        run->free[run->members[i]] = 0;
    }
    return CREASE_OK;
}

static crease_status grow_pass(growth *run, const pass *how)
{
    crease_segmentation *const seg = run->seg;
    crease_fitter *const fitter = &seg->fitters[0];
    for (size_t o = 0; o < seg->count; o++) {
        if (o % PATIENCE == 0) {
            if (crease_cancelled(seg->context))
                return crease_fail_cancelled(seg->context);
            crease_progress(seg->context, (double)o / (double)seg->count);
        }
        const size_t seed = run->order[o];
        if (!run->free[seed] || !grow(run, seed, how, fitter))
            continue;
        const crease_status status = accept(run, fitter);
        if (status != CREASE_OK)
            return status;
    }
    return CREASE_OK;
}

static int at_most(int wanted, size_t stride)
{
    return (size_t)wanted < stride ? wanted : (int)stride - 1;
}

static crease_status grow_all(growth *run)
{
    crease_segmentation *const seg = run->seg;
    const size_t least = seg->least_points, usual = least > 16 ? least : 16;
    const int all = (int)seg->stride - 1;
    const pass passes[3] = {{all, seg->least_cosine, usual}, {all, loose_cosine, usual},
        {at_most(CREASE_LINKS, seg->stride), loose_cosine, least}};
    crease_status status = crease_parallel_for(seg->context, seg->count, GRAIN, find_free, run);
    if (status == CREASE_OK)
        status = sort_by_roughness(run);
    for (int i = 0; i < 3 && status == CREASE_OK; i++)
        status = grow_pass(run, &passes[i]);
    return status;
}

crease_status crease_grow(crease_segmentation *seg)
{
    growth run = {.seg = seg};
    crease_status status = CREASE_ERROR_NO_MEMORY;
    run.order = crease_allocate(seg->context, seg->count, sizeof *run.order);
    run.members = crease_allocate(seg->context, seg->count, sizeof *run.members);
    run.roughness = crease_allocate(seg->context, seg->count, sizeof *run.roughness);
    run.free = crease_allocate(seg->context, seg->count, sizeof *run.free);
    run.inside = crease_allocate(seg->context, seg->count, sizeof *run.inside);
    if (run.order && run.members && run.roughness && run.free && run.inside)
        status = grow_all(&run);
    free(run.order);
    free(run.members);
    free(run.roughness);
    free(run.free);
    free(run.inside);
    return status;
}
