/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Uniting regions that join without an angle: how a smooth surface was cut into primitives and free
 * forms says little, so one free form takes their place where it is as close to the points.
 * Primitives that the points show clearly stay, unless the whole is described shorter without them:
 * fillets and their planes join without an angle as well.
 *
 * Based on: Schwarz. Estimating the dimension of a model. 1978. */
#include "segment/segmentation.h"

#include "base/memory.h"
#include "base/vector.h"
#include "segment/patch.h"

#include <math.h>
#include <stdlib.h>

enum {
    MOST_REGIONS = 400,
    MOST_TRIALS = 600, /* fits: what bounds the time */
    LEAST_LINKS = 3,
    LEAST_WIDE_LINKS = 12,
    SAMPLE = 3000,
    MORE_SPANS = 2,
    LOOKED_AT = 32, /* points that tell how much a region turns */
    SMALL = 60,     /* points of a plane that may be a piece of something else */
    FEW = 150       /* and of other pieces */
};

static const double SMOOTH = 0.98;       /* mean cosine at a border without an angle */
static const double FORMS_SMOOTH = 0.95; /* of two free forms, which go on straight: 18 degrees */
static const double SHARP = 0.985;       /* cosine of 10 degrees: less is an angle */
static const double SHARP_SHARE = 0.1;   /* of the links that may show one */
static const double CLOSE = 1.1;         /* times the noise and what the own models leave */
static const double FLAT_COSINE = 0.966; /* 15 degrees from the mean normal */

/* What the links between two regions, the first the lower, show. */
struct border {
    uint32_t links, sharp;
    double agreement; /* sum of the cosines between the gradients */
    double parallel;  /* and of their absolute values */
    bool tried;
};

struct uniting {
    crease_segmentation *seg;
    bool wide;
    size_t count, trials;
    struct border *borders; /* count x count */
};

/* Two regions on trial: a sample of both, that of the first before that of the second. */
struct pair {
    size_t regions[2], sizes[2], sampled[2];
    const struct border *border;
};

/* ----------------------------------------------------------------------------------- borders -- */

static struct border *border_of(const struct uniting *run, int32_t a, int32_t b)
{
    const size_t low = (size_t)(a < b ? a : b), high = (size_t)(a < b ? b : a);
    return &run->borders[low * run->count + high];
}

static void add_link(const struct uniting *run, size_t point, int32_t a, int32_t b)
{
    const crease_segmentation *const seg = run->seg;
    double first[3], second[3];
    crease_model_distance(&seg->models[a], seg->points + 3 * point, first);
    crease_model_distance(&seg->models[b], seg->points + 3 * point, second);
    const double cosine = crease_vector_dot(first, second);
    struct border *const border = border_of(run, a, b);
    border->links++;
    border->sharp += fabs(cosine) < SHARP;
    border->agreement += cosine;
    border->parallel += fabs(cosine);
}

/* Counts the links of one region anew, or, when it is CREASE_NO_LABEL, of all. */
static void count_links(const struct uniting *run, int32_t region)
{
    const crease_segmentation *const seg = run->seg;
    for (size_t r = 0; r < run->count && region >= 0; r++)
        *border_of(run, region, (int32_t)r) = (struct border){0};
    for (size_t i = 0; i < seg->count; i++)
        for (int k = 1; k <= seg->border_links && seg->labels[i] >= 0; k++) {
            const int32_t a = seg->labels[i], b = seg->labels[crease_segmentation_near(seg, i)[k]];
            if (b >= 0 && a != b && (region < 0 || a == region || b == region))
                add_link(run, i, a, b);
        }
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

static bool is_form(const crease_segmentation *seg, size_t region)
{
    return seg->models[region].type == CREASE_REGION_FREEFORM;
}

/* Free forms, and small pieces of anything else that hardly turn. */
static bool is_vague(const crease_segmentation *seg, size_t region)
{
    if (is_form(seg, region))
        return true;
    if (seg->models[region].type == CREASE_REGION_PLANE)
        return crease_segmentation_size(seg, region) < SMALL;
    return crease_segmentation_size(seg, region) < FEW && is_flat(seg, region);
}

static bool may_unite(const struct uniting *run, size_t a, size_t b)
{
    const crease_segmentation *const seg = run->seg;
    const struct border *const border = &run->borders[a * run->count + b];
    if (border->tried)
        return false;
    if (run->wide)
        return border->links >= LEAST_WIDE_LINKS && border->sharp <= SHARP_SHARE * border->links;
    const double smooth = is_form(seg, a) && is_form(seg, b) ? FORMS_SMOOTH : SMOOTH;
    if (border->links < LEAST_LINKS || border->parallel < smooth * border->links)
        return false;
    return is_form(seg, a) || is_form(seg, b) || (is_vague(seg, a) && is_vague(seg, b));
}

/* The smoothest border that may be opened; NULL when there is none. */
static struct border *next_border(const struct uniting *run)
{
    struct border *best = NULL;
    double least = INFINITY;
    for (size_t a = 0; a < run->count; a++)
        for (size_t b = a + 1; b < run->count; b++) {
            struct border *const border = &run->borders[a * run->count + b];
            const double bend = 1.0 - border->parallel / (double)border->links;
            if (border->links > 0 && bend < least && may_unite(run, a, b)) {
                least = bend;
                best = border;
            }
        }
    return best;
}

/* -------------------------------------------------------------------------------------- fits -- */

static void add_sample(
    const struct uniting *run, size_t region, size_t most, bool turned, crease_sample *sample)
{
    const crease_segmentation *const seg = run->seg;
    const size_t size = crease_segmentation_size(seg, region), taken = size < most ? size : most;
    for (size_t i = 0; i < taken; i++) {
        const size_t point = seg->members[seg->first[region] + i * size / taken];
        double side[3];
        crease_model_distance(&seg->models[region], seg->points + 3 * point, side);
        for (int c = 0; c < 3 && turned; c++)
            side[c] = -side[c];
        crease_segmentation_sample(seg, point, side, sample);
    }
}

/* Sum of the cut squared residuals, in sigmas, of one of the regions' sampled points. */
static double misfit(
    const struct uniting *run, const struct pair *pair, int which, const crease_model *model)
{
    crease_sample part = run->seg->fitters[0].sample;
    part.points += which ? 3 * pair->sampled[0] : 0;
    part.count = pair->sampled[which];
    return crease_fit_cost(model, &part, run->seg->sigma) -
        model->parameter_count * log(fmax((double)part.count, 2.0));
}

static int spans_of(const crease_model *model)
{
    return model->type == CREASE_REGION_FREEFORM && model->patch.spline ? model->patch.spans : 4;
}

static void take_sample(const struct uniting *run, struct pair *pair)
{
    crease_sample *const both = &run->seg->fitters[0].sample;
    const double total = (double)(pair->sizes[0] + pair->sizes[1]);
    both->count = 0;
    for (int i = 0; i < 2; i++) {
        const size_t before = both->count;
        add_sample(run, pair->regions[i], 1 + (size_t)(SAMPLE * (double)pair->sizes[i] / total),
            i && pair->border->agreement < 0.0, both);
        pair->sampled[i] = both->count - before;
    }
}

/* Whether the surface is as close to the points of either region as noise and the region's own. */
static bool is_close(const struct uniting *run, const struct pair *pair, const crease_model *model)
{
    for (int i = 0; i < 2; i++) {
        const double count = (double)pair->sampled[i];
        const double own = misfit(run, pair, i, &run->seg->models[pair->regions[i]]) / count;
        const double most = CLOSE * fmax(1.0, own) + 3.0 * sqrt(2.0 / count);
        if (!(misfit(run, pair, i, model) / count <= most))
            return false;
    }
    return true;
}

/* Whether one surface describes the points shorter than the two and the border between them. */
static bool is_shorter(
    const struct uniting *run, const struct pair *pair, const crease_model *model)
{
    const double total = (double)(pair->sizes[0] + pair->sizes[1]);
    double gain = CREASE_LINK_PRICE * pair->border->links - model->parameter_count * log(total);
    for (int i = 0; i < 2; i++) {
        const crease_model *const own = &run->seg->models[pair->regions[i]];
        const double size = (double)pair->sizes[i], weight = size / (double)pair->sampled[i];
        gain += own->parameter_count * log(size) +
            weight * (misfit(run, pair, i, own) - misfit(run, pair, i, model));
    }
    return gain > 0.0;
}

/* Fits one free form to both, beginning with so many spans; false when it will not do. */
static bool fit_both(struct uniting *run, const struct pair *pair, int spans, bool vague)
{
    crease_fitter *const fitter = &run->seg->fitters[0];
    const crease_sample *const both = &fitter->sample;
    crease_model warm = {.type = CREASE_REGION_FREEFORM, .cost = INFINITY};
    warm.patch.spline = warm.patch.round = true;
    warm.patch.spans = spans < CREASE_PATCH_SPANS ? spans : CREASE_PATCH_SPANS;
    run->trials++;
    return crease_fit_choose(fitter, both, vague ? CREASE_RULE_AKAIKE : CREASE_RULE_BAYES,
               crease_fit_level_for(both->count), &warm, INFINITY) &&
        is_close(run, pair, &fitter->best) && (vague || is_shorter(run, pair, &fitter->best));
}

/* The same with few spans, for two vague regions. */
static bool fit_simply(struct uniting *run)
{
    crease_fitter *const fitter = &run->seg->fitters[0];
    const crease_sample *const both = &fitter->sample;
    run->trials++;
    return crease_fit_choose(fitter, both, CREASE_RULE_AKAIKE, crease_fit_level_for(both->count),
               NULL, INFINITY) &&
        fitter->best.chi < 1.0 + 3.0 * sqrt(2.0 / (double)both->count);
}

static bool try_pair(struct uniting *run, struct pair *pair)
{
    const crease_segmentation *const seg = run->seg;
    const bool vague =
        run->wide || (is_vague(seg, pair->regions[0]) && is_vague(seg, pair->regions[1]));
    const int spans[2] = {
        spans_of(&seg->models[pair->regions[0]]), spans_of(&seg->models[pair->regions[1]])};
    const int more = spans[0] > spans[1] ? spans[0] : spans[1];
    for (int i = 0; i < 2; i++)
        pair->sizes[i] = crease_segmentation_size(seg, pair->regions[i]);
    take_sample(run, pair);
    return (vague && !run->wide && fit_simply(run)) ||
        fit_both(run, pair, more + MORE_SPANS, vague) ||
        fit_both(run, pair, spans[0] + spans[1] + MORE_SPANS, vague);
}

/* ----------------------------------------------------------------------------------- joining -- */

static crease_status join(struct uniting *run, size_t a, size_t b)
{
    crease_segmentation *const seg = run->seg;
    crease_model model;
    crease_fitter *const fitter = &seg->fitters[0];
    crease_fit_covariance(fitter, &fitter->sample, &fitter->best);
    crease_status status = crease_model_copy(seg->context, &fitter->best, &model);
    if (status != CREASE_OK)
        return status;
    model.tangent_count = 0;
    crease_segmentation_replace(seg, a, &model);
    for (size_t r = 0; r < seg->region_count; r++)
        for (int i = 0; i < seg->models[r].tangent_count; i++)
            if (seg->models[r].tangent[i] == (int32_t)a || seg->models[r].tangent[i] == (int32_t)b)
                seg->models[r].tangent_count = 0;
    for (size_t m = seg->first[b]; m < seg->first[b + 1]; m++)
        seg->labels[seg->members[m]] = (int32_t)a;
    count_links(run, (int32_t)b);
    count_links(run, (int32_t)a);
    return crease_segmentation_list(seg);
}

static crease_status unite_all(struct uniting *run, size_t *united)
{
    crease_status status = CREASE_OK;
    count_links(run, CREASE_NO_LABEL);
    while (status == CREASE_OK && run->trials < MOST_TRIALS) {
        struct border *const border = next_border(run);
        if (!border)
            break;
        const size_t number = (size_t)(border - run->borders);
        struct pair pair = {
            .regions = {number / run->count, number % run->count}, .border = border};
        border->tried = true;
        if (!try_pair(run, &pair))
            continue;
        status = join(run, pair.regions[0], pair.regions[1]);
        ++*united;
    }
    return status;
}

crease_status crease_unite(crease_segmentation *seg, bool wide, size_t *united)
{
    struct uniting run = {.seg = seg, .wide = wide, .count = seg->region_count};
    *united = 0;
    if (run.count < 2 || run.count > MOST_REGIONS)
        return CREASE_OK;
    run.borders = crease_allocate(seg->context, run.count * run.count, sizeof *run.borders);
    crease_status status = run.borders ? crease_segmentation_list(seg) : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK)
        status = unite_all(&run, united);
    free(run.borders);
    if (status == CREASE_OK)
        crease_segmentation_compact(seg);
    return status;
}
