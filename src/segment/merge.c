/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Merging neighbouring regions: the pair that one model explains at the greatest gain over two is
 * joined first, then the gains around it are worked out anew, until no pair gains. */
#include "segment/segmentation.h"

#include "base/memory.h"
#include "base/vector.h"

#include <math.h>
#include <stdlib.h>

enum { LEAST_LINKS = 3, SIGN_POINTS = 32 };

static const double least_agreement = 0.8; /* mean |cosine| between the models of large regions */
static const double waves_agree = 0.94;    /* the same for the waves of one face: 20 degrees */
static const uint32_t NONE = UINT32_MAX;

/* A link between two regions, at a point. */
typedef struct border_link {
    uint32_t low, high, point;
} border_link;

typedef struct region_pair {
    uint32_t low, high;
    uint32_t links;
    double agreement; /* sum of the cosines between the models' gradients at the links */
    double parallel;  /* sum of their absolute values */
    double gain;      /* of joining; only positive ones have a model */
    crease_model model;
} region_pair;

typedef struct merging {
    crease_segmentation *seg;
    size_t sample;    /* points of each region that are looked at */
    size_t large;     /* more points: a region whose surface at the border says what it is */
    double tolerance; /* mean square residual, in square sigmas, that one model may leave on each of
                         two regions, or 0: it must be the likelier */
    region_pair *pairs;
    size_t pair_count;
    size_t *pending; /* pairs whose gains are to be worked out */
    size_t pending_count;
    /* Regions joined so far are chains of the original ones. */
    uint32_t *next, *last;
    size_t *sizes;
} merging;

/* ------------------------------------------------------------------------------------- pairs -- */

static int compare_links(const void *a, const void *b)
{
    const border_link *x = a, *y = b;
    if (x->low != y->low)
        return x->low < y->low ? -1 : 1;
    if (x->high != y->high)
        return x->high < y->high ? -1 : 1;
    return x->point < y->point ? -1 : x->point > y->point;
}

/* Stores the links between different regions, unless links is NULL; returns their number. */
static size_t collect_links(const crease_segmentation *seg, border_link *links)
{
    size_t count = 0;
    for (size_t i = 0; i < seg->count; i++) {
        const uint32_t *const near = crease_segmentation_near(seg, i);
        const int32_t own = seg->labels[i];
        for (int j = 1; j <= seg->border_links && own >= 0; j++) {
            const int32_t other = seg->labels[near[j]];
            if (other < 0 || other == own)
                continue;
            if (links)
                links[count] = (border_link){(uint32_t)(own < other ? own : other),
                    (uint32_t)(own < other ? other : own), (uint32_t)i};
            count++;
        }
    }
    return count;
}

static bool same_pair(const border_link *a, const border_link *b)
{
    return a->low == b->low && a->high == b->high;
}

static void add_link(const crease_segmentation *seg, const border_link *link, region_pair *pair)
{
    double low[3], high[3];
    const double *const place = seg->points + 3 * (size_t)link->point;
    crease_model_distance(&seg->models[link->low], place, low);
    crease_model_distance(&seg->models[link->high], place, high);
    const double cosine = crease_vector_dot(low, high);
    pair->links++;
    pair->agreement += cosine;
    pair->parallel += fabs(cosine);
}

static crease_status find_pairs(merging *run)
{
    crease_segmentation *const seg = run->seg;
    const size_t count = collect_links(seg, NULL);
    border_link *const links = crease_allocate(seg->context, count, sizeof *links);
    if (!links)
        return CREASE_ERROR_NO_MEMORY;
    collect_links(seg, links);
    qsort(links, count, sizeof *links, compare_links);
    size_t pairs = 0;
    for (size_t i = 0; i < count; i++)
        pairs += i == 0 || !same_pair(&links[i - 1], &links[i]);
    run->pairs = crease_allocate(seg->context, pairs, sizeof *run->pairs);
    run->pending = crease_allocate(seg->context, pairs, sizeof *run->pending);
    if (run->pairs && run->pending)
        for (size_t i = 0; i < count; i++) {
            if (i == 0 || !same_pair(&links[i - 1], &links[i]))
                run->pairs[run->pair_count++] =
                    (region_pair){.low = links[i].low, .high = links[i].high};
            add_link(seg, &links[i], &run->pairs[run->pair_count - 1]);
        }
    free(links);
    return run->pairs && run->pending ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
}

/* ------------------------------------------------------------------------------------- gains -- */

/* Adds at most `most` points of a chain of regions to the sample, evenly, normals on the model's
 * positive side, or on the other. */
static void sample_chain(
    const merging *run, uint32_t region, size_t most, bool turned, crease_sample *sample)
{
    const crease_segmentation *const seg = run->seg;
    const crease_model *const model = &seg->models[region];
    const size_t size = run->sizes[region], taken = size < most ? size : most;
    size_t passed = 0; /* members of earlier links of the chain */
    uint32_t part = region;
    for (size_t i = 0; i < taken; i++) {
        const size_t wanted = i * size / taken;
        while (wanted - passed >= crease_segmentation_size(seg, part)) {
            passed += crease_segmentation_size(seg, part);
            part = run->next[part];
        }
        const size_t point = seg->members[seg->first[part] + wanted - passed];
        double side[3];
        crease_model_distance(model, seg->points + 3 * point, side);
        for (int c = 0; c < 3 && turned; c++)
            side[c] = -side[c];
        crease_segmentation_sample(seg, point, side, sample);
    }
}

/* The part of a sample from point `begin` on. */
static crease_sample part_of(const crease_sample *sample, size_t begin, size_t end)
{
    crease_sample part = *sample;
    part.points += 3 * begin;
    part.normals += 3 * begin;
    part.count = end - begin;
    return part;
}

static bool worth_trying(const merging *run, const region_pair *pair)
{
    const size_t low = run->sizes[pair->low], high = run->sizes[pair->high];
    if (run->tolerance > 0.0)
        return pair->links >= LEAST_LINKS && pair->parallel >= waves_agree * pair->links;
    return pair->links >= LEAST_LINKS &&
        (pair->parallel >= least_agreement * pair->links ||
            (low < high ? low : high) <= run->large);
}

static void keep_model(merging *run, region_pair *pair, const crease_model *model, double gain)
{
    if (!(gain > 0.0))
        return;
    if (crease_model_copy(run->seg->context, model, &pair->model) == CREASE_OK)
        pair->gain = gain;
    else
        atomic_store(&run->seg->no_memory, true);
}

/* Mean of the squared residuals of a sample in sigmas, each cut. */
static double mean_square(const merging *run, const crease_model *model, const crease_sample *of)
{
    const double count = (double)of->count;
    const double cost = crease_fit_cost(model, of, run->seg->sigma);
    return (cost - model->parameter_count * log(count)) / count;
}

/* How much less than the tolerance a model leaves on either region. */
static double within_tolerance(const merging *run, const crease_model *model,
    const crease_sample *low, const crease_sample *high)
{
    return run->tolerance - fmax(mean_square(run, model, low), mean_square(run, model, high));
}

/* The simplest models only, planes for planes: a rich one explains any two regions that meet
 * smoothly. */
static void find_tolerable(merging *run, crease_fitter *fitter, const crease_sample *low,
    const crease_sample *high, const crease_model *big, region_pair *pair)
{
    const crease_model *const models = run->seg->models;
    const bool flat = models[pair->low].type == CREASE_REGION_PLANE &&
        models[pair->high].type == CREASE_REGION_PLANE;
    const crease_fit_level level = flat ? CREASE_LEVEL_PLANE : CREASE_LEVEL_ROUND;
    keep_model(run, pair, big, within_tolerance(run, big, low, high));
    if (!(pair->gain > 0.0) &&
        crease_fit_choose(fitter, &fitter->sample, CREASE_RULE_BAYES, level, big, INFINITY))
        keep_model(run, pair, &fitter->best, within_tolerance(run, &fitter->best, low, high));
}

/* A small region next to one more than twice its size first tries that one's model as it is. */
static void find_gain(merging *run, region_pair *pair, crease_fitter *fitter)
{
    const crease_segmentation *const seg = run->seg;
    crease_model_clear(&pair->model);
    pair->gain = 0.0;
    if (!worth_trying(run, pair))
        return;
    crease_sample *const both = &fitter->sample;
    both->count = 0;
    sample_chain(run, pair->low, run->sample, false, both);
    const size_t border = both->count;
    sample_chain(run, pair->high, run->sample, pair->agreement < 0.0, both);
    const crease_sample low = part_of(both, 0, border), high = part_of(both, border, both->count);
    const double apart = crease_fit_cost(&seg->models[pair->low], &low, seg->sigma) +
        crease_fit_cost(&seg->models[pair->high], &high, seg->sigma);
    const size_t sizes[2] = {run->sizes[pair->low], run->sizes[pair->high]};
    const size_t small = sizes[0] < sizes[1] ? sizes[0] : sizes[1];
    const crease_model *const big = &seg->models[sizes[0] >= sizes[1] ? pair->low : pair->high];
    if (run->tolerance > 0.0) {
        find_tolerable(run, fitter, &low, &high, big, pair);
        return;
    }
    const double unchanged = apart - crease_fit_cost(big, both, seg->sigma);
    if (unchanged > 0.0 && sizes[0] + sizes[1] > 3 * small)
        keep_model(run, pair, big, unchanged);
    else if (crease_fit_choose(
                 fitter, both, CREASE_RULE_BAYES, crease_fit_level_for(both->count), big, apart))
        keep_model(run, pair, &fitter->best, apart - fitter->best.cost);
}

static void find_gains(void *user, size_t begin, size_t end, int worker)
{
    merging *const run = user;
    for (size_t i = begin; i < end; i++) {
        region_pair *const pair = &run->pairs[run->pending[i]];
        find_gain(run, pair, &run->seg->fitters[worker]);
    }
}

static crease_status find_pending(merging *run)
{
    return crease_segmentation_parallel(run->seg, run->pending_count, 1, find_gains, run);
}

/* ----------------------------------------------------------------------------------- joining -- */

/* Whether a model's positive side is, over a region, the other side than that of its old model. */
static bool turns(const merging *run, uint32_t region, const crease_model *model)
{
    const crease_segmentation *const seg = run->seg;
    const uint32_t *const members = seg->members + seg->first[region];
    const size_t size = crease_segmentation_size(seg, region);
    const size_t taken = size < SIGN_POINTS ? size : SIGN_POINTS;
    double sum = 0.0, before[3], after[3];
    for (size_t i = 0; i < taken; i++) {
        const double *const place = seg->points + 3 * (size_t)members[i * size / taken];
        crease_model_distance(&seg->models[region], place, before);
        crease_model_distance(model, place, after);
        sum += crease_vector_dot(before, after);
    }
    return sum < 0.0;
}

static void turn_pairs(merging *run, uint32_t region)
{
    for (size_t i = 0; i < run->pair_count; i++)
        if (run->pairs[i].low == region || run->pairs[i].high == region)
            run->pairs[i].agreement = -run->pairs[i].agreement;
}

/* Appends region b to the chain of region a, which gets the pair's model. */
static void join(merging *run, size_t best)
{
    crease_segmentation *const seg = run->seg;
    region_pair *const chosen = &run->pairs[best];
    const uint32_t a = chosen->low, b = chosen->high;
    const bool turned[2] = {turns(run, a, &chosen->model), turns(run, b, &chosen->model)};
    if (turned[0])
        turn_pairs(run, a);
    if (turned[1])
        turn_pairs(run, b);
    crease_segmentation_replace(seg, a, &chosen->model);
    chosen->model.patch.coefficients = NULL;
    run->next[run->last[a]] = b;
    run->last[a] = run->last[b];
    run->sizes[a] += run->sizes[b];
    run->sizes[b] = 0;
    run->pairs[best] = run->pairs[--run->pair_count];
}

/* The pair among the first `count` that joins region a with the other one. */
static region_pair *find_pair(merging *run, size_t count, uint32_t a, uint32_t other)
{
    for (size_t i = 0; i < count; i++) {
        region_pair *const found = &run->pairs[i];
        if ((found->low == a && found->high == other) || (found->high == a && found->low == other))
            return found;
    }
    return NULL;
}

/* Pairs with b become pairs with a; two for the same regions become one; all with a are pending. */
static void redirect_pairs(merging *run, uint32_t a, uint32_t b)
{
    size_t kept = 0;
    run->pending_count = 0;
    for (size_t i = 0; i < run->pair_count; i++) {
        region_pair moved = run->pairs[i];
        moved.low = moved.low == b ? a : moved.low;
        moved.high = moved.high == b ? a : moved.high;
        if (moved.low == a || moved.high == a) {
            region_pair *const known =
                find_pair(run, kept, a, moved.low == a ? moved.high : moved.low);
            if (known) {
                known->links += moved.links;
                known->agreement += moved.agreement;
                known->parallel += moved.parallel;
                crease_model_clear(&moved.model);
                continue;
            }
            run->pending[run->pending_count++] = kept;
        }
        run->pairs[kept++] = moved;
    }
    run->pair_count = kept;
}

static size_t best_pair(const merging *run)
{
    size_t best = 0;
    for (size_t i = 1; i < run->pair_count; i++)
        if (run->pairs[i].gain > run->pairs[best].gain)
            best = i;
    return best;
}

static crease_status merge_all(merging *run, size_t *merged)
{
    for (size_t i = 0; i < run->pair_count; i++)
        run->pending[run->pending_count++] = i;
    crease_status status = find_pending(run);
    while (status == CREASE_OK && run->pair_count > 0) {
        const size_t best = best_pair(run);
        if (!(run->pairs[best].gain > 0.0))
            break;
        const uint32_t a = run->pairs[best].low, b = run->pairs[best].high;
        join(run, best);
        redirect_pairs(run, a, b);
        ++*merged;
        status = find_pending(run);
    }
    return status;
}

static void label_chains(const merging *run)
{
    crease_segmentation *const seg = run->seg;
    for (uint32_t r = 0; r < seg->region_count; r++)
        for (uint32_t part = r; run->sizes[r] > 0 && part != NONE; part = run->next[part])
            for (size_t i = seg->first[part]; i < seg->first[part + 1]; i++)
                seg->labels[seg->members[i]] = (int32_t)r;
}

static crease_status allocate(merging *run)
{
    crease_segmentation *const seg = run->seg;
    const size_t count = seg->region_count;
    run->next = crease_allocate(seg->context, count, sizeof *run->next);
    run->last = crease_allocate(seg->context, count, sizeof *run->last);
    run->sizes = crease_allocate(seg->context, count, sizeof *run->sizes);
    if (!run->next || !run->last || !run->sizes)
        return CREASE_ERROR_NO_MEMORY;
    for (uint32_t r = 0; r < count; r++) {
        run->next[r] = NONE;
        run->last[r] = r;
        run->sizes[r] = crease_segmentation_size(seg, r);
    }
    return CREASE_OK;
}

static crease_status merge(merging *run, size_t *merged)
{
    crease_segmentation *const seg = run->seg;
    *merged = 0;
    crease_status status = allocate(run);
    if (status == CREASE_OK)
        status = find_pairs(run);
    if (status == CREASE_OK)
        status = merge_all(run, merged);
    if (status == CREASE_OK) {
        label_chains(run);
        status = crease_segmentation_list(seg);
    }
    if (status == CREASE_OK)
        crease_segmentation_compact(seg);
    for (size_t i = 0; i < run->pair_count; i++)
        crease_model_clear(&run->pairs[i].model);
    free(run->pairs);
    free(run->pending);
    free(run->next);
    free(run->last);
    free(run->sizes);
    return status;
}

crease_status crease_merge(crease_segmentation *seg, size_t sample, size_t large, size_t *merged)
{
    return merge(&(merging){.seg = seg, .sample = sample, .large = large}, merged);
}

crease_status crease_merge_within(crease_segmentation *seg, size_t sample, double tolerance)
{
    size_t merged;
    return merge(&(merging){.seg = seg, .sample = sample, .tolerance = tolerance}, &merged);
}
