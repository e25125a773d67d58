/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "segment/blend.h"

#include "base/memory.h"
#include "base/vector.h"

#include <math.h>
#include <stdlib.h>

enum { SEARCH_STEPS = 24, MOST_SLICES = 100000, LEAST_INTERIOR = 30 };

static const double smallest = 0.5; /* spacings from the edge to where the ball touches */
static const double grid = 1.06;    /* ratio of radii that are tried */
static const double widely = 2.0;   /* reach of the comparison, in that of the parts */
static const double slice = 2.0;    /* spacings by which a fillet grows along its edge */
static const double doubt = 3.0;    /* standard errors by which a fillet may be worse than parts
                                       that are curved anyway */
static const double golden = 0.6180339887498949;

/* Points around the parts, in the section of the edge. */
typedef struct witness {
    crease_section at;
    double along;
    double present; /* cost under its own region */
} witness;

typedef struct zone {
    witness *items;
    double *heights[2]; /* of the items above the planes */
    size_t count;       /* inside the blend; those of the planes beyond its ends follow */
    size_t all;
    double sigma;
} zone;

static double cut(double distance, double sigma)
{
    const double r = distance / sigma;
    return fmin(r * r, CREASE_COST_CUT);
}

static bool is_near(const crease_blend *blend, const double place[3], witness *out)
{
    out->along = crease_vector_dot(place, blend->wedge.along);
    out->at = crease_wedge_section(&blend->wedge, place);
    return crease_wedge_away(&blend->wedge, out->at) <= blend->reach;
}

bool crease_blend_holds(const crease_blend *blend, const double place[3], crease_section *out)
{
    witness one;
    const bool near = is_near(blend, place, &one);
    *out = one.at;
    return near && one.along >= blend->low && one.along <= blend->high;
}

/* ----------------------------------------------------------------------------------- planes -- */

static bool is_interior(const crease_segmentation *seg, size_t point, int32_t region)
{
    const uint32_t *const near = crease_segmentation_near(seg, point);
    for (int j = 1; j <= seg->border_links; j++)
        if (seg->labels[near[j]] != region)
            return false;
    return true;
}

crease_status crease_blend_refit(crease_segmentation *seg, crease_fitter *fitter, int32_t region,
    const crease_blend *without, crease_model *out)
{
    const size_t begin = seg->first[region], end = seg->first[region + 1];
    uint32_t *const inside = crease_allocate(seg->context, end - begin, sizeof *inside);
    *out = seg->models[region];
    if (!inside)
        return CREASE_ERROR_NO_MEMORY;
    size_t count = 0;
    for (size_t m = begin; m < end; m++) {
        const uint32_t point = seg->members[m];
        crease_section at;
        crease_rolling_part part = CREASE_ROLLING_FIRST;
        if (without && crease_blend_holds(without, seg->points + 3 * (size_t)point, &at))
            crease_rolling_distance(&without->wedge, without->radius, at, &part);
        if (part != CREASE_ROLLING_ARC && is_interior(seg, point, region))
            inside[count++] = point;
    }
    if (count >= LEAST_INTERIOR) {
        crease_segmentation_sample_points(
            seg, inside, count, CREASE_SAMPLE_POINTS, out, &fitter->sample);
        if (crease_fit_kind(fitter, &fitter->sample, CREASE_REGION_PLANE, out)) {
            crease_fit_covariance(fitter, &fitter->sample, &fitter->best);
            *out = fitter->best;
            out->patch.coefficients = NULL;
        }
    }
    free(inside);
    return CREASE_OK;
}

/* ----------------------------------------------------------------------------------- extent -- */

static void mean_of_parts(const crease_segmentation *seg, const crease_blend *blend, double mean[3])
{
    double total = 0.0;
    mean[0] = mean[1] = mean[2] = 0.0;
    for (int p = 0; p < blend->count; p++) {
        const size_t end = seg->first[blend->parts[p] + 1];
        for (size_t m = seg->first[blend->parts[p]]; m < end; m++, total++)
            for (size_t c = 0; c < 3; c++)
                mean[c] += seg->points[3 * (size_t)seg->members[m] + c];
    }
    for (int c = 0; c < 3; c++)
        mean[c] /= total;
}

/* Sets the wedge and how far the parts reach; false when the planes have no edge. */
static bool measure(
    const crease_segmentation *seg, const crease_model *const planes[2], crease_blend *blend)
{
    double mean[3], far = 0.0;
    mean_of_parts(seg, blend, mean);
    if (!crease_wedge_make(planes, mean, &blend->wedge))
        return false;
    blend->low = INFINITY;
    blend->high = -INFINITY;
    blend->reach = INFINITY;
    for (int p = 0; p < blend->count; p++)
        for (size_t m = seg->first[blend->parts[p]]; m < seg->first[blend->parts[p] + 1]; m++) {
            witness one;
            is_near(blend, seg->points + 3 * (size_t)seg->members[m], &one);
            blend->low = fmin(blend->low, one.along);
            blend->high = fmax(blend->high, one.along);
            far = fmax(far, crease_wedge_away(&blend->wedge, one.at));
        }
    blend->reach = widely * far + 5.0 * seg->spacing;
    return true;
}

/* Lists the region's points beside the edge, inside the blend's ends or beyond them. */
static void list(const crease_segmentation *seg, const crease_blend *blend, int32_t region,
    bool inside, zone *out)
{
    double gradient[3];
    for (size_t m = seg->first[region]; m < seg->first[region + 1]; m++) {
        const double *const place = seg->points + 3 * (size_t)seg->members[m];
        witness *const one = &out->items[out->all];
        if (!is_near(blend, place, one) ||
            (one->along >= blend->low && one->along <= blend->high) != inside)
            continue;
        one->present =
            cut(crease_model_distance(&seg->models[region], place, gradient), out->sigma);
        for (int i = 0; i < 2; i++)
            out->heights[i][out->all] = one->at.height[i];
        out->all++;
    }
}

static void fill(const crease_segmentation *seg, const crease_blend *blend, zone *out)
{
    out->all = 0;
    for (int p = 0; p < blend->count; p++)
        list(seg, blend, blend->parts[p], true, out);
    for (int i = 0; i < 2; i++)
        list(seg, blend, blend->planes[i], true, out);
    out->count = out->all;
    for (int i = 0; i < 2; i++)
        list(seg, blend, blend->planes[i], false, out);
}

/* What rounding gains between two places along the edge. */
static double gain_between(const crease_blend *blend, const zone *around, double low, double high)
{
    double gain = 0.0;
    crease_rolling_part part;
    for (size_t i = around->count; i < around->all; i++) {
        const witness *const one = &around->items[i];
        if (one->along > low && one->along <= high)
            gain += one->present -
                cut(crease_rolling_distance(&blend->wedge, blend->radius, one->at, &part),
                    around->sigma);
    }
    return gain;
}

/* Moves the ends outwards as long as that gains. */
static void extend(crease_blend *blend, const zone *around, double length)
{
    for (int i = 0; i < MOST_SLICES; i++) {
        if (!(gain_between(blend, around, blend->high, blend->high + length) > 0.0))
            break;
        blend->high += length;
    }
    for (int i = 0; i < MOST_SLICES; i++) {
        if (!(gain_between(blend, around, blend->low - length, blend->low) > 0.0))
            break;
        blend->low -= length;
    }
}

/* ----------------------------------------------------------------------------------- radius -- */

static double cost_of(const crease_blend *blend, const zone *around, double radius)
{
    return crease_rolling_cost(&blend->wedge, radius, around->heights[0], around->heights[1],
        around->count, around->sigma, CREASE_COST_CUT);
}

/* The best radius on a grid, and then between its neighbours there. */
static double find_radius(const crease_blend *blend, const zone *around, double spacing)
{
    const double touch = crease_wedge_touch(&blend->wedge);
    double least = INFINITY, radius = smallest * spacing / touch;
    for (double r = radius; r * touch < blend->reach; r *= grid) {
        const double cost = cost_of(blend, around, r);
        if (cost < least) {
            least = cost;
            radius = r;
        }
    }
    double low = radius / grid, high = radius * grid;
    double a = high - golden * (high - low), b = low + golden * (high - low);
    double below = cost_of(blend, around, a), above = cost_of(blend, around, b);
    for (int i = 0; i < SEARCH_STEPS; i++)
        if (below < above) {
            high = b;
            b = a;
            above = below;
            a = high - golden * (high - low);
            below = cost_of(blend, around, a);
        } else {
            low = a;
            a = b;
            below = above;
            b = low + golden * (high - low);
            above = cost_of(blend, around, b);
        }
    return 0.5 * (low + high);
}

/* Standard error of the difference of the costs from those of the regions as they are.
 * Based on: Vuong. Likelihood ratio tests for model selection and non-nested hypotheses. 1989. */
static double error_of(const crease_blend *blend, const zone *around, double radius)
{
    double squares = 0.0;
    crease_rolling_part part;
    for (size_t i = 0; i < around->count; i++) {
        const witness *const one = &around->items[i];
        const double difference = one->present -
            cut(crease_rolling_distance(&blend->wedge, radius, one->at, &part), around->sigma);
        squares += difference * difference;
    }
    return sqrt(squares);
}

/* Cost of the parts as they are. A plane among them is a chamfer: parallel to the edge. *curved:
 * not all are planes. */
static double present_cost(
    const crease_segmentation *seg, const crease_blend *blend, const zone *around, bool *curved)
{
    double cost = 0.0, parameters = 0.0;
    *curved = false;
    for (size_t i = 0; i < around->count; i++)
        cost += around->items[i].present;
    for (int p = 0; p < blend->count; p++) {
        const crease_model *const part = &seg->models[blend->parts[p]];
        const bool plane = part->type == CREASE_REGION_PLANE;
        parameters += plane ? part->parameter_count - 1.0 : part->parameter_count;
        *curved |= !plane;
    }
    return cost + parameters * log((double)around->count);
}

/* The sharp edge must be better than the parts; the fillet clearly better than the sharp edge. */
static void decide(const crease_segmentation *seg, crease_blend *blend, const zone *around)
{
    bool curved;
    const double present = present_cost(seg, blend, around, &curved);
    const double parameter = log((double)around->count);
    const double fillet = cost_of(blend, around, blend->radius) + parameter;
    const double sharp = cost_of(blend, around, 0.0);
    const double error = curved ? error_of(blend, around, blend->radius) : 0.0;
    if (fillet + parameter < sharp) {
        blend->gain = present - fillet + doubt * error;
    } else {
        blend->gain = present - sharp;
        blend->radius = 0.0;
    }
}

static crease_status refit_planes(crease_segmentation *seg, crease_fitter *fitter,
    const crease_blend *blend, crease_model planes[2])
{
    crease_status status = CREASE_OK;
    for (int i = 0; i < 2 && status == CREASE_OK; i++)
        status = crease_blend_refit(seg, fitter, blend->planes[i], blend, &planes[i]);
    return status;
}

static crease_status find(
    crease_segmentation *seg, crease_fitter *fitter, bool fresh, crease_blend *blend, zone *around)
{
    crease_model planes[2] = {seg->models[blend->planes[0]], seg->models[blend->planes[1]]};
    const crease_model *const beside[2] = {&planes[0], &planes[1]};
    if (!measure(seg, beside, blend))
        return CREASE_OK;
    fill(seg, blend, around);
    blend->radius = find_radius(blend, around, seg->spacing);
    if (fresh) {
        const crease_status status = refit_planes(seg, fitter, blend, planes);
        if (status != CREASE_OK || !measure(seg, beside, blend))
            return status;
        fill(seg, blend, around);
        blend->radius = find_radius(blend, around, seg->spacing);
    }
    extend(blend, around, slice * seg->spacing);
    fill(seg, blend, around);
    blend->radius = find_radius(blend, around, seg->spacing);
    decide(seg, blend, around);
    return CREASE_OK;
}

crease_status crease_blend_judge(
    crease_segmentation *seg, crease_fitter *fitter, bool fresh, crease_blend *blend)
{
    size_t room = 1;
    for (int i = 0; i < 2; i++)
        room += crease_segmentation_size(seg, (size_t)blend->planes[i]);
    for (int p = 0; p < blend->count; p++)
        room += crease_segmentation_size(seg, (size_t)blend->parts[p]);
    zone around = {.sigma = seg->sigma};
    around.items = crease_allocate(seg->context, room, sizeof *around.items);
    around.heights[0] = crease_allocate(seg->context, 2 * room, sizeof(double));
    around.heights[1] = around.heights[0] ? around.heights[0] + room : NULL;
    blend->gain = -INFINITY;
    crease_status status = CREASE_ERROR_NO_MEMORY;
    if (around.items && around.heights[0])
        status = find(seg, fitter, fresh, blend, &around);
    free(around.items);
    free(around.heights[0]);
    return status;
}
