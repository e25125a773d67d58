/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/carriers.h"

#include "base/memory.h"
#include "primitive/fitter.h"
#include "primitive/patch.h"
#include "segment/region.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    AREA_NEIGHBOURS = 8, /* the area of a point is that of the disc to this neighbour, over it */
    FIT_POINTS = 6000,   /* most points of a surface that a joint fit looks at */
    POLYNOMIAL_SPANS = 2 /* how many cubic pieces stand for a polynomial of degree 4 at most */
};

static const double same_radius = 0.2;   /* relative difference worth a closer look */
static const double same_distance = 2.5; /* rms of one's points from the other, in its noise */
static const double cut_sigmas = 4.0;    /* no residual counts more */
static const double joint_price[2] = {12.0, 3.0}; /* what one surface for two may cost in chi^2:
                                                     the first plus the second times log n */

struct crease_carriers {
    const crease_regions *regions;
    size_t count;
    crease_model *models;
    uint32_t *largest; /* region of each carrier */
    uint32_t *of_region;
    double *areas;
};

/* ------------------------------------------------------------------------------------- areas -- */

static double squared_distance(const double a[3], const double b[3])
{
    double sum = 0.0;
    for (int c = 0; c < 3; c++)
        sum += (a[c] - b[c]) * (a[c] - b[c]);
    return sum;
}

static void measure_areas(const crease_regions *regions, double *areas)
{
    const size_t k = (size_t)crease_neighbours_k(regions->neighbours);
    const size_t last = k - 1 < AREA_NEIGHBOURS ? k - 1 : AREA_NEIGHBOURS;
    const double pi = acos(-1.0);
    for (size_t i = 0; i < regions->count; i++) {
        const size_t other = crease_neighbours_of(regions->neighbours, i)[last];
        areas[regions->order[i]] = pi / (double)last *
            squared_distance(regions->points + 3 * i, regions->points + 3 * other);
    }
}

/* ---------------------------------------------------------------------------------- grouping -- */

typedef struct grouping {
    crease_context *context;
    const crease_regions *regions;
    crease_carriers *out;
    crease_fitter *fitters;
    uint32_t *members;   /* positions, region by region */
    size_t *first;       /* region_count + 1 */
    size_t *sizes;       /* points of each carrier */
    uint32_t *chosen[2]; /* FIT_POINTS each: some points of the carrier and of the region */
} grouping;

static void list_members(grouping *g)
{
    const crease_regions *const regions = g->regions;
    size_t *const next = g->sizes; /* of no other use yet */
    for (size_t i = 0; i < regions->count; i++)
        if (regions->labels[i] >= 0)
            g->first[regions->labels[i] + 1]++;
    for (size_t r = 0; r < regions->region_count; r++) {
        g->first[r + 1] += g->first[r];
        next[r] = g->first[r];
    }
    for (size_t i = 0; i < regions->count; i++)
        if (regions->labels[i] >= 0)
            g->members[next[regions->labels[i]]++] = (uint32_t)i;
}

static size_t size_of(const grouping *g, size_t region)
{
    return g->first[region + 1] - g->first[region];
}

/* Evenly chosen points of the regions below `end` that lie on the carrier. */
static size_t choose_of_carrier(const grouping *g, size_t carrier, size_t end, uint32_t *out)
{
    const size_t step = 1 + g->sizes[carrier] / FIT_POINTS;
    size_t count = 0, at = 0;
    for (size_t r = 0; r < end; r++) {
        if (g->out->of_region[r] != carrier)
            continue;
        for (size_t m = g->first[r]; m < g->first[r + 1]; m++, at++)
            if (at % step == 0)
                out[count++] = g->members[m];
    }
    return count;
}

static size_t choose_of_region(const grouping *g, size_t region, uint32_t *out)
{
    const size_t step = 1 + size_of(g, region) / FIT_POINTS;
    size_t count = 0;
    for (size_t m = g->first[region]; m < g->first[region + 1]; m += step)
        out[count++] = g->members[m];
    return count;
}

static double mean_square(
    const grouping *g, const crease_model *model, const uint32_t *points, size_t count)
{
    double sum = 0.0, gradient[3];
    for (size_t i = 0; i < count; i++) {
        const double d =
            crease_model_distance(model, g->regions->points + 3 * (size_t)points[i], gradient);
        sum += fmin(d * d, pow(cut_sigmas * g->regions->sigma, 2));
    }
    return sum / fmax((double)count, 1.0);
}

static void add_to_sample(
    const grouping *g, const crease_model *warm, const uint32_t *points, size_t count)
{
    crease_sample *const sample = &g->fitters[0].sample;
    for (size_t i = 0; i < count; i++) {
        const double *const place = g->regions->points + 3 * (size_t)points[i];
        if (sample->count == 0)
            memcpy(sample->origin, place, sizeof sample->origin);
        for (int c = 0; c < 3; c++)
            sample->points[3 * sample->count + (size_t)c] = place[c] - sample->origin[c];
        crease_model_distance(warm, place, sample->normals + 3 * sample->count);
        sample->count++;
    }
}

/* Whether one surface explains the region and the carrier as well as their own; *joint is it. */
static bool fits_jointly(grouping *g, size_t carrier, size_t region, crease_model *joint)
{
    const crease_model *const own = &g->regions->models[region];
    const crease_model *const other = &g->out->models[carrier];
    const double noise = pow(g->regions->sigma, 2);
    const size_t small = choose_of_region(g, region, g->chosen[1]);
    const double alone = mean_square(g, own, g->chosen[1], small);
    if (mean_square(g, other, g->chosen[1], small) > pow(same_distance, 2) * fmax(alone, noise))
        return false;
    const size_t large = choose_of_carrier(g, carrier, region, g->chosen[0]);
    g->fitters[0].sample.count = 0;
    g->fitters[0].sigma = g->regions->sigma;
    add_to_sample(g, other, g->chosen[0], large);
    add_to_sample(g, other, g->chosen[1], small);
    if (!crease_fit_kind(&g->fitters[0], &g->fitters[0].sample, own->type, other))
        return false;
    *joint = g->fitters[0].best;
    joint->patch = (crease_patch){0}; /* a primitive; the room for coefficients is the fitter's */
    const double n[2] = {(double)g->sizes[carrier], (double)size_of(g, region)};
    const double rise = n[0] *
            (mean_square(g, joint, g->chosen[0], large) -
                mean_square(g, other, g->chosen[0], large)) +
        n[1] * (mean_square(g, joint, g->chosen[1], small) - alone);
    return rise < noise * (joint_price[0] + joint_price[1] * log(n[0] + n[1]));
}

static bool may_be_one(const crease_model *a, const crease_model *b)
{
    if (a->type != b->type || a->type == CREASE_REGION_FREEFORM)
        return false;
    return a->type == CREASE_REGION_PLANE ||
        fabs(a->radius - b->radius) <= same_radius * fmax(a->radius, b->radius);
}

/* Puts the region on a carrier that is there, or on one of its own. */
static crease_status place_region(grouping *g, size_t region)
{
    crease_carriers *const out = g->out;
    const crease_model *const own = &g->regions->models[region];
    for (size_t c = 0; c < out->count; c++) {
        crease_model joint;
        if (!may_be_one(&out->models[c], own) || !fits_jointly(g, c, region, &joint))
            continue;
        out->models[c] = joint;
        out->of_region[region] = (uint32_t)c;
        g->sizes[c] += size_of(g, region);
        return CREASE_OK;
    }
    const crease_status status = crease_model_copy(g->context, own, &out->models[out->count]);
    if (status != CREASE_OK)
        return status;
    out->largest[out->count] = (uint32_t)region;
    out->of_region[region] = (uint32_t)out->count;
    g->sizes[out->count] = size_of(g, region);
    out->count++;
    return CREASE_OK;
}

/* The regions come from large to small. */
static crease_status group(crease_context *context, crease_carriers *out)
{
    const crease_regions *const regions = out->regions;
    grouping g = {.context = context, .regions = regions, .out = out};
    crease_status status = CREASE_ERROR_NO_MEMORY;
    g.members = crease_allocate(context, regions->count, sizeof *g.members);
    g.first = crease_allocate(context, regions->region_count + 1, sizeof *g.first);
    g.sizes = crease_allocate(context, regions->region_count, sizeof *g.sizes);
    for (int i = 0; i < 2; i++)
        g.chosen[i] = crease_allocate(context, FIT_POINTS + 1, sizeof *g.chosen[i]);
    if (g.members && g.first && g.sizes && g.chosen[0] && g.chosen[1])
        status = crease_fitters_create(context, &g.fitters);
    if (status == CREASE_OK)
        list_members(&g);
    for (size_t r = 0; r < regions->region_count && status == CREASE_OK; r++)
        status = place_region(&g, r);
    crease_fitters_free(context, g.fitters);
    free(g.members);
    free(g.first);
    free(g.sizes);
    free(g.chosen[0]);
    free(g.chosen[1]);
    return status;
}

/* ----------------------------------------------------------------------------------- objects -- */

crease_status crease_carriers_find(
    crease_context *context, const crease_regions *regions, crease_carriers **out)
{
    *out = NULL;
    crease_carriers *const carriers = crease_allocate(context, 1, sizeof *carriers);
    if (!carriers)
        return CREASE_ERROR_NO_MEMORY;
    const size_t count = regions->region_count;
    crease_status status = CREASE_ERROR_NO_MEMORY;
    carriers->regions = regions;
    carriers->models = crease_allocate(context, count, sizeof *carriers->models);
    carriers->largest = crease_allocate(context, count, sizeof *carriers->largest);
    carriers->of_region = crease_allocate(context, count, sizeof *carriers->of_region);
    carriers->areas = crease_allocate(context, regions->count, sizeof *carriers->areas);
    if (carriers->models && carriers->largest && carriers->of_region && carriers->areas) {
        measure_areas(regions, carriers->areas);
        status = group(context, carriers);
    }
    if (status == CREASE_OK)
        *out = carriers;
    else
        crease_carriers_free(carriers);
    return status;
}

void crease_carriers_free(crease_carriers *carriers)
{
    if (!carriers)
        return;
    for (size_t c = 0; c < carriers->count; c++)
        crease_model_clear(&carriers->models[c]);
    free(carriers->models);
    free(carriers->largest);
    free(carriers->of_region);
    free(carriers->areas);
    free(carriers);
}

size_t crease_carriers_count(const crease_carriers *carriers)
{
    return carriers->count;
}

crease_carrier crease_carriers_at(const crease_carriers *carriers, size_t index)
{
    const crease_model *const model = &carriers->models[index];
    crease_carrier carrier = {.type = model->type,
        .radius = model->radius,
        .shape = model->shape,
        .region = carriers->largest[index]};
    memcpy(carrier.centre, model->centre, sizeof carrier.centre);
    memcpy(carrier.axes, model->axes, sizeof carrier.axes);
    carrier.ball = model->type == CREASE_REGION_FREEFORM && model->patch.ball;
    carrier.round = model->type == CREASE_REGION_FREEFORM && model->patch.round;
    if (model->type == CREASE_REGION_FREEFORM)
        carrier.spans = model->patch.spline ? model->patch.spans : POLYNOMIAL_SPANS;
    return carrier;
}

const uint32_t *crease_carriers_of_regions(const crease_carriers *carriers)
{
    return carriers->of_region;
}

const double *crease_carriers_areas(const crease_carriers *carriers)
{
    return carriers->areas;
}

double crease_carriers_distance(
    const crease_carriers *carriers, size_t index, const double place[3], double gradient[3])
{
    return crease_model_distance(&carriers->models[index], place, gradient);
}

double crease_carriers_height(const crease_carriers *carriers, size_t index, double x, double y)
{
    double slope[2];
    return crease_patch_at(&carriers->models[index].patch, x, y, slope);
}
