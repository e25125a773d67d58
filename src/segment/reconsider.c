/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Other explanations of a region. Growing and merging may end with one surface laid over two, or
 * with the wrong kind of surface whose neighbours have taken the points it does not fit. Here a
 * region is freed from its past: surfaces of every kind are fitted to its interior and to it with
 * its surroundings, and pairs of surfaces to its halves; each is fitted again to the points that it
 * explains best, and all points around choose their labels anew. What lowers the energy clearly is
 * taken. */
#include "segment/segmentation.h"

#include "base/memory.h"
#include "base/symmetric.h"
#include "base/vector.h"
#include "segment/vicinity.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    RINGS = 3,
    LEAST_POINTS = 12,
    LARGE_PLANE = 600,
    LARGE_PLAIN = 150,
    LARGE = 3000,
    COEFFICIENTS = 6, /* of a polynomial of degree 2, the only free form among the candidates */
    MOST_DIRECTIONS = 5,
    LEAST_HALF = 10
};

static const double margin = 6.0;       /* of energy by which another explanation must be better */
static const double good_chi = 0.3;     /* energy per point that leaves nothing to gain */
static const double still_tried = 0.02; /* change of size below which a region is not tried again */

typedef struct candidate {
    crease_model model;
    double coefficients[COEFFICIENTS];
} candidate;

typedef struct proposal {
    bool found, split;
    crease_model first, second;
} proposal;

typedef struct reconsidering {
    crease_segmentation *seg;
    proposal *proposals; /* by region */
} reconsidering;

typedef struct trial {
    crease_segmentation *seg;
    crease_fitter *fitter;
    crease_vicinity vicinity;
    size_t region, size;
    const crease_model *current;
    bool poor;  /* its points are further from the model than noise explains */
    bool plain; /* plane, cylinder or cone: nothing that bends around a corner */
    double log_size;
    double least; /* energy to beat */
    bool found, split;
    candidate best[2];
} trial;

/* -------------------------------------------------------------------------------- candidates -- */

static void keep(candidate *to, const crease_model *model)
{
    to->model = *model;
    to->model.patch.coefficients = to->coefficients;
    if (model->type == CREASE_REGION_FREEFORM)
        memcpy(to->coefficients, model->patch.coefficients,
            model->patch.coefficient_count * sizeof *to->coefficients);
}

/* Fits again to the points that the candidate explains better than the surrounding regions and than
 * its rival do; kind FREEFORM: of any simple kind. */
static bool fit_closest(trial *at, candidate *one, const candidate *rival, crease_region_type kind)
{
    const crease_vicinity *const v = &at->vicinity;
    size_t count = 0;
    for (size_t i = 0; i < v->count; i++) {
        const uint32_t point = v->points[i];
        const double price = 2.0 * crease_segmentation_price(at->seg, &one->model, point);
        if (price < v->elsewhere[i] && price < CREASE_COST_CUT &&
            (!rival || price <= 2.0 * crease_segmentation_price(at->seg, &rival->model, point)))
            v->chosen[count++] = point;
    }
    if (count < 8)
        return false;
    crease_sample *const sample = &at->fitter->sample;
    crease_segmentation_sample_points(at->seg, v->chosen, count, 300, &one->model, sample);
    const crease_fit_level level = sample->count < 16 ? CREASE_LEVEL_QUADRATIC : CREASE_LEVEL_ROUND;
    const bool fitted = kind == CREASE_REGION_FREEFORM
        ? crease_fit_choose(at->fitter, sample, CREASE_RULE_BAYES, level, &one->model, INFINITY)
        : crease_fit_kind(at->fitter, sample, kind, &one->model);
    if (fitted)
        keep(one, &at->fitter->best);
    return fitted;
}

/* ------------------------------------------------------------------------------- other kinds -- */

/* Points whose nearest neighbours are all of the region, into the list; all points when these are
 * fewer than half. Returns their number. */
static size_t list_interior(const trial *at)
{
    const crease_segmentation *const seg = at->seg;
    const crease_vicinity *const v = &at->vicinity;
    size_t count = 0;
    for (size_t i = 0; i < at->size; i++) {
        const uint32_t *const near = crease_segmentation_near(seg, v->points[i]);
        int j = 1;
        while (j <= seg->border_links && seg->labels[near[j]] == v->region)
            j++;
        if (j > seg->border_links)
            v->chosen[count++] = v->points[i];
    }
    if (2 * count >= at->size && count >= 30)
        return count;
    memcpy(v->chosen, v->points, at->size * sizeof *v->chosen);
    return at->size;
}

static void try_kind(trial *at, crease_region_type kind, bool around)
{
    const crease_vicinity *const v = &at->vicinity;
    crease_sample *const sample = &at->fitter->sample;
    if (around)
        crease_segmentation_sample_points(at->seg, v->points, v->count, 400, at->current, sample);
    else
        crease_segmentation_sample_points(
            at->seg, v->chosen, list_interior(at), 300, at->current, sample);
    if (!crease_fit_kind(at->fitter, sample, kind, at->current))
        return;
    candidate one;
    keep(&one, &at->fitter->best);
    for (int round = 0; round < 2; round++)
        if (!fit_closest(at, &one, NULL, kind))
            return;
    memcpy(v->trial, v->labels, v->count * sizeof *v->trial);
    const double rare = kind == CREASE_REGION_TORUS ? 4.0
        : kind == CREASE_REGION_SPHERE              ? 2.0
                                                    : 0.0;
    const double energy = crease_vicinity_energy(&at->vicinity, &one.model, NULL) +
        one.model.parameter_count * at->log_size + rare;
    if (energy < at->least) {
        at->least = energy;
        at->found = true;
        keep(&at->best[0], &one.model);
    }
}

static void try_kinds(trial *at)
{
    for (int around = 0; around < 2; around++)
        for (int kind = CREASE_REGION_PLANE; kind <= CREASE_REGION_TORUS; kind++) {
            const bool ball = kind == CREASE_REGION_SPHERE || kind == CREASE_REGION_TORUS;
            if ((kind == (int)at->current->type && !around) || (ball && at->plain && !at->poor))
                continue;
            try_kind(at, (crease_region_type)kind, around);
        }
}

/* ------------------------------------------------------------------------------------ halves -- */

/* Directions across which the region may fall into two: its main axes, the axis of its model, and
 * that in which its normals change most. */
typedef struct cutting {
    int count;
    double mean[3], directions[MOST_DIRECTIONS][3];
    double low[MOST_DIRECTIONS], high[MOST_DIRECTIONS];
} cutting;

static void main_axes(const double *vectors, size_t count, double mean[3], double axes[9])
{
    double matrix[6] = {0}, values[3], d[3];
    const crease_sample sample = {.count = count, .points = (double *)(uintptr_t)vectors};
    crease_sample_mean(&sample, mean);
    for (size_t i = 0; i < count; i++) {
        crease_sample_from(&sample, i, mean, d);
        crease_symmetric_add(matrix, 1.0, d);
    }
    crease_symmetric_axes(matrix, values, axes);
}

static cutting find_cuts(const trial *at)
{
    crease_sample *const sample = &at->fitter->sample;
    cutting cuts = {.count = 3};
    double axes[9], mean[3];
    crease_segmentation_sample_points(
        at->seg, at->vicinity.points, at->size, 1000, at->current, sample);
    main_axes(sample->points, sample->count, cuts.mean, axes);
    memcpy(cuts.directions, axes, sizeof axes);
    const crease_region_type type = at->current->type;
    if (type == CREASE_REGION_CYLINDER || type == CREASE_REGION_CONE || type == CREASE_REGION_TORUS)
        memcpy(cuts.directions[cuts.count++], at->current->axes + 6, 3 * sizeof(double));
    main_axes(sample->normals, sample->count, mean, axes);
    memcpy(cuts.directions[cuts.count++], axes + 6, 3 * sizeof(double));
    for (int d = 0; d < cuts.count; d++) {
        cuts.low[d] = INFINITY;
        cuts.high[d] = -INFINITY;
        for (size_t i = 0; i < sample->count; i++) {
            double offset[3];
            crease_sample_from(sample, i, cuts.mean, offset);
            const double along = crease_vector_dot(offset, cuts.directions[d]);
            cuts.low[d] = fmin(cuts.low[d], along);
            cuts.high[d] = fmax(cuts.high[d], along);
        }
    }
    for (int c = 0; c < 3; c++)
        cuts.mean[c] += sample->origin[c];
    return cuts;
}

/* Fits a simple model to the region's points on one side of a cut. */
static bool fit_half(
    trial *at, const cutting *cuts, int direction, double place, bool upper, candidate *out)
{
    const crease_vicinity *const v = &at->vicinity;
    size_t count = 0;
    for (size_t i = 0; i < at->size; i++) {
        double along = 0.0;
        for (size_t c = 0; c < 3; c++)
            along += (at->seg->points[3 * (size_t)v->points[i] + c] - cuts->mean[c]) *
                cuts->directions[direction][c];
        if ((along > place) == upper)
            v->chosen[count++] = v->points[i];
    }
    if (count < LEAST_HALF)
        return false;
    crease_sample *const sample = &at->fitter->sample;
    crease_segmentation_sample_points(at->seg, v->chosen, count, 200, at->current, sample);
    if (!crease_fit_choose(
            at->fitter, sample, CREASE_RULE_BAYES, CREASE_LEVEL_ROUND, NULL, INFINITY))
        return false;
    keep(out, &at->fitter->best);
    return true;
}

static void try_cut(trial *at, const cutting *cuts, int direction, double share)
{
    crease_vicinity *const v = &at->vicinity;
    candidate half[2];
    const double low = cuts->low[direction], high = cuts->high[direction];
    for (int k = 0; k < 2; k++)
        if (!fit_half(at, cuts, direction, low + share * (high - low), k == 1, &half[k]))
            return;
    for (int round = 0; round < 3; round++)
        for (int k = 0; k < 2; k++)
            if (!fit_closest(at, &half[k], &half[1 - k], CREASE_REGION_FREEFORM))
                return;
    for (size_t i = 0; i < v->count; i++) {
        v->trial[i] = v->labels[i];
        if (v->labels[i] == v->region &&
            crease_segmentation_price(at->seg, &half[0].model, v->points[i]) >
                crease_segmentation_price(at->seg, &half[1].model, v->points[i]))
            v->trial[i] = (int32_t)at->seg->region_count;
    }
    const double energy = crease_vicinity_energy(v, &half[0].model, &half[1].model) +
        (half[0].model.parameter_count + half[1].model.parameter_count) * at->log_size;
    if (energy < at->least) {
        at->least = energy;
        at->found = at->split = true;
        for (int k = 0; k < 2; k++)
            keep(&at->best[k], &half[k].model);
    }
}

static void try_halves(trial *at)
{
    const cutting cuts = find_cuts(at);
    const bool large = at->size > LARGE;
    for (int d = 0; d < cuts.count; d++)
        for (int quarter = 1; quarter <= 3; quarter++)
            if (!large || quarter == 2)
                try_cut(at, &cuts, d, 0.25 * quarter);
}

/* ----------------------------------------------------------------------------------- regions -- */

static double mean_misfit(const crease_segmentation *seg, size_t region)
{
    const size_t begin = seg->first[region], end = seg->first[region + 1];
    double sum = 0.0, gradient[3];
    for (size_t m = begin; m < end; m++) {
        const double *const place = seg->points + 3 * (size_t)seg->members[m];
        const double r = crease_model_distance(&seg->models[region], place, gradient) / seg->sigma;
        sum += fmin(r * r, CREASE_RESIDUAL_CUT);
    }
    return sum / (double)(end - begin);
}

/* Whether the region leaves something to explain and the search is not too dear for it. */
static bool is_doubtful(trial *at)
{
    const crease_region_type type = at->current->type;
    if (at->size < LEAST_POINTS || (type == CREASE_REGION_PLANE && at->size > LARGE_PLANE))
        return false;
    const double chi = mean_misfit(at->seg, at->region);
    at->poor = chi > 1.0 + sqrt(2.0 / (double)at->size);
    at->plain =
        type == CREASE_REGION_PLANE || type == CREASE_REGION_CYLINDER || type == CREASE_REGION_CONE;
    return chi >= good_chi &&
        (at->poor || (at->size <= LARGE && !(at->plain && at->size > LARGE_PLAIN)));
}

static void explain(trial *at)
{
    crease_vicinity *const v = &at->vicinity;
    memcpy(v->trial, v->labels, v->count * sizeof *v->trial);
    const double energy =
        crease_vicinity_energy(v, at->current, NULL) + at->current->parameter_count * at->log_size;
    at->least = energy - margin;
    if (energy <= good_chi * (double)at->size)
        return;
    if (at->size < LARGE)
        try_kinds(at);
    if (at->current->type != CREASE_REGION_PLANE && at->size >= 2 * LEAST_POINTS &&
        (at->poor || !at->plain))
        try_halves(at);
}

static crease_status propose(const trial *at, proposal *out)
{
    crease_context *const context = at->seg->context;
    crease_status status = crease_model_copy(context, &at->best[0].model, &out->first);
    if (status == CREASE_OK && at->split)
        status = crease_model_copy(context, &at->best[1].model, &out->second);
    out->found = status == CREASE_OK;
    out->split = at->split;
    return status;
}

static crease_status reconsider_region(
    crease_segmentation *seg, size_t region, crease_fitter *fitter, proposal *out)
{
    const size_t size = crease_segmentation_size(seg, region);
    trial at = {.seg = seg,
        .fitter = fitter,
        .region = region,
        .size = size,
        .current = &seg->models[region],
        .log_size = log((double)size)};
    const double tried = (double)seg->tried[region];
    if (fabs(tried - (double)size) <= still_tried * (double)size)
        return CREASE_OK;
    seg->tried[region] = size;
    if (!is_doubtful(&at))
        return CREASE_OK;
    crease_status status = crease_vicinity_create(seg, region, RINGS, &at.vicinity);
    if (status != CREASE_OK)
        return status;
    explain(&at);
    if (at.found)
        status = propose(&at, out);
    crease_vicinity_clear(&at.vicinity);
    return status;
}

static void reconsider_regions(void *user, size_t begin, size_t end, int worker)
{
    const reconsidering *run = user;
    crease_segmentation *const seg = run->seg;
    for (size_t region = begin; region < end; region++)
        if (reconsider_region(seg, region, &seg->fitters[worker], &run->proposals[region]) !=
            CREASE_OK)
            atomic_store(&seg->no_memory, true);
}

static crease_status accept(crease_segmentation *seg, size_t region, proposal *accepted)
{
    crease_segmentation_replace(seg, region, &accepted->first);
    accepted->first.patch.coefficients = NULL;
    seg->tried[region] = 0;
    if (!accepted->split)
        return CREASE_OK;
    const int32_t label = (int32_t)seg->region_count;
    const size_t begin = seg->first[region], end = seg->first[region + 1];
    const crease_status status = crease_segmentation_add(seg, &accepted->second);
    if (status != CREASE_OK)
        return status;
    accepted->second.patch.coefficients = NULL;
    for (size_t m = begin; m < end; m++) {
        const size_t point = seg->members[m];
        if (crease_segmentation_price(seg, &seg->models[label], point) <
            crease_segmentation_price(seg, &seg->models[region], point))
            seg->labels[point] = label;
    }
    return CREASE_OK;
}

crease_status crease_reconsider(crease_segmentation *seg, size_t *changed)
{
    const size_t count = seg->region_count;
    *changed = 0;
    reconsidering run = {.seg = seg};
    run.proposals = crease_allocate(seg->context, count, sizeof *run.proposals);
    if (!run.proposals)
        return CREASE_ERROR_NO_MEMORY;
    crease_status status = crease_segmentation_parallel(seg, count, 1, reconsider_regions, &run);
    for (size_t r = 0; r < count && status == CREASE_OK; r++)
        if (run.proposals[r].found) {
            status = accept(seg, r, &run.proposals[r]);
            ++*changed;
        }
    for (size_t r = 0; r < count; r++) {
        crease_model_clear(&run.proposals[r].first);
        crease_model_clear(&run.proposals[r].second);
    }
    free(run.proposals);
    return status == CREASE_OK ? crease_segmentation_list(seg) : status;
}
