/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Uniting regions that join without an angle: how a smooth surface was cut into primitives and free
 * forms says little, so one free form takes their place where it is as close to the points. */
#include "segment/segmentation.h"

#include "base/memory.h"
#include "base/vector.h"

#include <math.h>
#include <stdlib.h>

enum { MOST_REGIONS = 400, LEAST_LINKS = 12, SAMPLE = 3000, MORE_SPANS = 2 };

static const double SHARP = 0.985;     /* cosine of 10 degrees: less is an angle */
static const double SHARP_SHARE = 0.1; /* of the links that may show one */
static const double CLOSE = 1.1;       /* times the noise and what the regions' own models leave */

/* What the links between two regions, the first the lower, show. */
struct border {
    uint32_t links, sharp;
    double agreement; /* sum of the cosines between the gradients */
    bool tried;
};

struct uniting {
    crease_segmentation *seg;
    size_t count;
    struct border *borders; /* count x count */
    crease_model warm;
};

static struct border *border_of(const struct uniting *run, int32_t a, int32_t b)
{
    const size_t low = (size_t)(a < b ? a : b), high = (size_t)(a < b ? b : a);
    return &run->borders[low * run->count + high];
}

static void count_links(struct uniting *run)
{
    const crease_segmentation *const seg = run->seg;
    for (size_t i = 0; i < run->count * run->count; i++)
        run->borders[i] = (struct border){.tried = run->borders[i].tried};
    for (size_t i = 0; i < seg->count; i++)
        for (int k = 1; k <= seg->border_links && seg->labels[i] >= 0; k++) {
            const int32_t a = seg->labels[i], b = seg->labels[crease_segmentation_near(seg, i)[k]];
            double first[3], second[3];
            if (b < 0 || a == b)
                continue;
            crease_model_distance(&seg->models[a], seg->points + 3 * i, first);
            crease_model_distance(&seg->models[b], seg->points + 3 * i, second);
            const double cosine = crease_vector_dot(first, second);
            struct border *const border = border_of(run, a, b);
            border->links++;
            border->sharp += fabs(cosine) < SHARP;
            border->agreement += cosine;
        }
}

/* The smoothest border that has not been tried. */
static struct border *next_border(const struct uniting *run)
{
    struct border *best = NULL;
    double least = SHARP_SHARE;
    for (size_t i = 0; i < run->count * run->count; i++) {
        struct border *const border = &run->borders[i];
        const double share = (double)border->sharp / (double)border->links;
        if (!border->tried && border->links >= LEAST_LINKS &&
            (share < least || (share <= least && !best))) {
            least = share;
            best = border;
        }
    }
    return best;
}

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

/* Mean of the cut squared residuals of a region's points, of which there are `size`. */
static double misfit(const struct uniting *run, size_t region)
{
    const crease_segmentation *const seg = run->seg;
    const size_t begin = seg->first[region], end = seg->first[region + 1];
    double sum = 0.0, gradient[3];
    for (size_t m = begin; m < end; m++) {
        const double r = crease_model_distance(&seg->models[region],
                             seg->points + 3 * (size_t)seg->members[m], gradient) /
            seg->sigma;
        sum += fmin(r * r, CREASE_COST_CUT);
    }
    return sum;
}

static int spans_of(const crease_model *model)
{
    return model->type == CREASE_REGION_FREEFORM && model->patch.spline ? model->patch.spans : 4;
}

/* Fits one free form to both; false when it is not as close to the points. */
static bool fit_both(struct uniting *run, const struct border *border, size_t a, size_t b)
{
    const crease_segmentation *const seg = run->seg;
    crease_fitter *const fitter = &seg->fitters[0];
    crease_sample *const both = &fitter->sample;
    const size_t sizes[2] = {crease_segmentation_size(seg, a), crease_segmentation_size(seg, b)};
    const double total = (double)(sizes[0] + sizes[1]);
    const double before = (misfit(run, a) + misfit(run, b)) / total;
    const int spans[2] = {spans_of(&seg->models[a]), spans_of(&seg->models[b])};
    both->count = 0;
    for (int i = 0; i < 2; i++)
        add_sample(run, i ? b : a, 1 + (size_t)(SAMPLE * (double)sizes[i] / total),
            i && border->agreement < 0.0, both);
    run->warm = (crease_model){.type = CREASE_REGION_FREEFORM, .cost = INFINITY};
    run->warm.patch.spline = true;
    run->warm.patch.spans = (spans[0] > spans[1] ? spans[0] : spans[1]) + MORE_SPANS;
    if (run->warm.patch.spans > 12)
        run->warm.patch.spans = 12;
    const double most = CLOSE * fmax(1.0, before) + 3.0 * sqrt(2.0 / (double)both->count);
    return crease_fit_choose(fitter, both, CREASE_RULE_AKAIKE, crease_fit_level_for(both->count),
               &run->warm, INFINITY) &&
        fitter->best.chi <= most;
}

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
    for (size_t r = 0; r < run->count; r++)
        if (r != a)
            border_of(run, (int32_t)a, (int32_t)r)->tried = false;
    return crease_segmentation_list(seg);
}

static crease_status unite_all(struct uniting *run, size_t *united)
{
    crease_status status = CREASE_OK;
    count_links(run);
    for (struct border *border = next_border(run); border && status == CREASE_OK;
         border = next_border(run)) {
        const size_t number = (size_t)(border - run->borders);
        const size_t low = number / run->count, high = number % run->count;
        border->tried = true;
        if (!fit_both(run, border, low, high))
            continue;
        status = join(run, low, high);
        ++*united;
        count_links(run);
    }
    return status;
}

crease_status crease_unite(crease_segmentation *seg, size_t *united)
{
    struct uniting run = {.seg = seg, .count = seg->region_count};
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
