/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Uniting regions that join without an angle: how a smooth surface was cut into primitives and free
 * forms says little, so one free form takes their place where it is as close to the points.
 * Primitives that the points show clearly stay, unless the whole is described shorter without them:
 * fillets and their planes join without an angle as well.
 *
 * Based on: Schwarz. Estimating the dimension of a model. 1978. */
#include "primitive/patch.h"
#include "segment/border.h"
#include "segment/vague.h"

#include <math.h>

enum {
    MOST_REGIONS = 400,
    MOST_TRIALS = 600, /* fits: what bounds the time */
    LEAST_WIDE_LINKS = 12,
    SAMPLE = 3000,
    MORE_SPANS = 2
};

static const double SMOOTH = 0.98;       /* mean cosine at a border without an angle */
static const double VAGUE_SMOOTH = 0.95; /* of two guesses, which may err there: 18 degrees */
static const double SHARP_SHARE = 0.1;   /* of the links that may show one */
static const double CLOSE = 1.1;         /* times the noise and what the own models leave */

struct uniting {
    crease_segmentation *seg;
    bool wide;
    size_t trials;
    double rough; /* mean square residual of primitives that are none */
    crease_borders borders;
};

/* Two regions on trial: a sample of both, that of the first before that of the second. */
struct pair {
    size_t regions[2], sizes[2], sampled[2];
    const crease_border *border;
};

/* ----------------------------------------------------------------------------------- borders -- */

static bool is_vague(const struct uniting *run, size_t region)
{
    return crease_region_is_vague(run->seg, run->rough, region);
}

static bool may_unite(const struct uniting *run, size_t a, size_t b)
{
    const crease_border *const border = crease_borders_between(&run->borders, a, b);
    if (border->tried)
        return false;
    if (run->wide)
        return border->beside.links >= LEAST_WIDE_LINKS &&
            border->beside.sharp <= SHARP_SHARE * border->beside.links;
    const crease_border_contact *const contact = crease_border_told_by(border);
    if (contact->links < CREASE_BORDER_LEAST_LINKS ||
        contact->parallel < VAGUE_SMOOTH * contact->links)
        return false;
    return contact->parallel >= SMOOTH * contact->links || (is_vague(run, a) && is_vague(run, b));
}

/* The smoothest border that may be opened; NULL when there is none. */
static crease_border *next_border(const struct uniting *run)
{
    const size_t count = run->borders.count;
    crease_border *best = NULL;
    double least = INFINITY;
    for (size_t a = 0; a < count; a++)
        for (size_t b = a + 1; b < count; b++) {
            crease_border *const border = crease_borders_between(&run->borders, a, b);
            const crease_border_contact *const contact = crease_border_told_by(border);
            const double bend = 1.0 - contact->parallel / (double)contact->links;
            if (contact->links > 0 && bend < least && may_unite(run, a, b)) {
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
            i && crease_border_told_by(pair->border)->agreement < 0.0, both);
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

/* Sum of the cut squared residuals of all points of the regions, extrapolated from the sample. */
static double misfit_of_all(
    const struct uniting *run, const struct pair *pair, const crease_model *model)
{
    double sum = 0.0;
    for (int i = 0; i < 2; i++)
        sum += (double)pair->sizes[i] / (double)pair->sampled[i] *
            misfit(run, pair, i, model ? model : &run->seg->models[pair->regions[i]]);
    return sum;
}

static double parameters_of(const struct pair *pair, const crease_model *model)
{
    return model->parameter_count * log((double)(pair->sizes[0] + pair->sizes[1]));
}

/* What the description of the points by the two surfaces and the border between them takes. */
static double cost_apart(const struct uniting *run, const struct pair *pair)
{
    double cost = CREASE_LINK_PRICE * pair->border->beside.links + misfit_of_all(run, pair, NULL);
    for (int i = 0; i < 2; i++)
        cost += run->seg->models[pair->regions[i]].parameter_count * log((double)pair->sizes[i]);
    return cost;
}

/* Whether the surface may take the place of a plane and another primitive: bends of sheet metal and
 * fillets, and the planes that they lead to, are no piece of a free form however well one fits. */
static bool keeps_planes(
    const struct uniting *run, const struct pair *pair, const crease_model *model)
{
    bool plane = false;
    for (int i = 0; i < 2; i++) {
        if (crease_region_is_form(run->seg, pair->regions[i]))
            return true;
        plane = plane || run->seg->models[pair->regions[i]].type == CREASE_REGION_PLANE;
    }
    return !plane || model->type != CREASE_REGION_FREEFORM ||
        (!model->patch.spline && model->patch.degree == 2);
}

/* Fits one surface to both, free forms with about so many spans; false when it will not do: it is
 * not as close, or, unless they are vague, does not make the description shorter. */
static bool fit_both(struct uniting *run, const struct pair *pair, int spans, bool vague)
{
    crease_fitter *const fitter = &run->seg->fitters[0];
    const crease_sample *const both = &fitter->sample;
    const double apart = vague ? INFINITY : cost_apart(run, pair);
    crease_model warm = {.type = CREASE_REGION_FREEFORM, .cost = INFINITY};
    warm.patch.spline = warm.patch.round = true;
    warm.patch.spans = spans < CREASE_PATCH_SPANS ? spans : CREASE_PATCH_SPANS;
    run->trials++;
    return crease_fit_choose(fitter, both, vague ? CREASE_RULE_AKAIKE : CREASE_RULE_BAYES,
               crease_fit_level_for(both->count), &warm, apart) &&
        is_close(run, pair, &fitter->best) && (vague || keeps_planes(run, pair, &fitter->best)) &&
        parameters_of(pair, &fitter->best) + misfit_of_all(run, pair, &fitter->best) < apart;
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

static bool is_rich(const struct uniting *run, size_t region)
{
    return crease_region_is_rich(run->seg, run->rough, region);
}

static bool try_pair(struct uniting *run, struct pair *pair)
{
    const crease_segmentation *const seg = run->seg;
    const size_t a = pair->regions[0], b = pair->regions[1];
    const bool vague = run->wide || (is_vague(run, a) && is_vague(run, b));
    const bool rich = run->wide || (vague && (is_rich(run, a) || is_rich(run, b)));
    const int spans[2] = {spans_of(&seg->models[a]), spans_of(&seg->models[b])};
    const int more = spans[0] > spans[1] ? spans[0] : spans[1];
    for (int i = 0; i < 2; i++)
        pair->sizes[i] = crease_segmentation_size(seg, pair->regions[i]);
    take_sample(run, pair);
    return (vague && !run->wide && fit_simply(run)) ||
        fit_both(run, pair, more + MORE_SPANS, rich) ||
        ((is_rich(run, a) || is_rich(run, b)) &&
            fit_both(run, pair, spans[0] + spans[1] + MORE_SPANS, rich));
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
    crease_borders_count(&run->borders, (int32_t)b);
    crease_borders_count(&run->borders, (int32_t)a);
    return crease_segmentation_list(seg);
}

static crease_status unite_all(struct uniting *run, size_t *united)
{
    crease_status status = crease_vague_find_rough(run->seg, &run->rough);
    crease_borders_count(&run->borders, CREASE_NO_LABEL);
    while (status == CREASE_OK && run->trials < MOST_TRIALS) {
        const size_t count = run->borders.count;
        crease_border *const border = next_border(run);
        if (!border)
            break;
        const size_t number = (size_t)(border - run->borders.items);
        struct pair pair = {.regions = {number / count, number % count}, .border = border};
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
    struct uniting run = {.seg = seg, .wide = wide};
    *united = 0;
    if (seg->region_count < 2 || seg->region_count > MOST_REGIONS)
        return CREASE_OK;
    crease_status status = crease_borders_make(seg, &run.borders);
    if (status == CREASE_OK)
        status = crease_segmentation_list(seg);
    if (status == CREASE_OK)
        status = unite_all(&run, united);
    crease_borders_clear(&run.borders);
    if (status == CREASE_OK)
        crease_segmentation_compact(seg);
    return status;
}
