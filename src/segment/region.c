/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Regions of a cloud: its surroundings, the rounds of the segmentation, and what they leave. */
#include "segment/region.h"

#include "base/memory.h"
#include "cloud/cloud.h"
#include "noise/blur.h"
#include "primitive/uncertainty.h"
#include "segment/excerpt.h"
#include "segment/result.h"
#include "segment/segmentation.h"
#include "segment/surroundings.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LEAST_POINTS = 8, FEW = 10000 };

static const double normals_agree = 20.0; /* degrees between a point's normal and its region's, on
                                             top of twice the error of the normals */

crease_regions_options crease_regions_options_default(void)
{
    return (crease_regions_options){.least_points = LEAST_POINTS};
}

static crease_status by_index(crease_context *context, crease_regions *regions)
{
    regions->labels_by_index =
        crease_allocate(context, regions->count, sizeof *regions->labels_by_index);
    regions->normals_by_index =
        crease_allocate(context, regions->count, 3 * sizeof *regions->normals_by_index);
    if (!regions->labels_by_index || !regions->normals_by_index)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < regions->count; i++) {
        const size_t index = regions->order[i];
        regions->labels_by_index[index] = regions->labels[i];
        memcpy(regions->normals_by_index + 3 * index, regions->noise->normals + 3 * i,
            3 * sizeof(double));
    }
    return CREASE_OK;
}

static int links_of(int wanted, const crease_regions *regions)
{
    const int others = crease_neighbours_k(regions->neighbours) - 1;
    return wanted < others ? wanted : others;
}

/* Runs the stages on the points that the segmentation has by now. */
static crease_status run(crease_segmentation *seg)
{
    memset(seg->labels, 0xff, seg->count * sizeof *seg->labels);
    seg->members = crease_allocate(seg->context, seg->count, sizeof *seg->members);
    return seg->members ? crease_rounds_run(seg) : CREASE_ERROR_NO_MEMORY;
}

/* Runs them on the points beside rounded edges, and continues the regions there. */
static crease_status run_beside_edges(crease_segmentation *seg, const crease_regions *regions)
{
    crease_excerpt part;
    const size_t least = (size_t)(0.6 * CREASE_BLUR_REACH * CREASE_BLUR_REACH);
    crease_status status = crease_excerpt_take(
        seg->context, seg->points, seg->count, seg->noise, regions->rounded, &part);
    if (status == CREASE_OK) {
        seg->count = part.count;
        seg->points = part.points;
        seg->neighbours = part.neighbours->indices;
        seg->noise = &part.noise;
        seg->labels = part.labels;
        seg->least_points = least > seg->least_points ? least : seg->least_points;
        status = run(seg);
        free(seg->members);
        seg->members = NULL;
    }
    if (status == CREASE_OK)
        status = crease_excerpt_spread(
            seg->context, &part, seg->models, regions->points, regions->count, regions->labels);
    crease_excerpt_clear(&part);
    seg->count = regions->count;
    seg->points = regions->points;
    seg->neighbours = regions->neighbours->indices;
    seg->noise = regions->noise;
    seg->labels = regions->labels;
    if (status == CREASE_OK)
        seg->members = crease_allocate(seg->context, seg->count, sizeof *seg->members);
    if (status == CREASE_OK && !seg->members)
        status = CREASE_ERROR_NO_MEMORY;
    return status == CREASE_OK ? crease_segmentation_list(seg) : status;
}

/* Among four times as many points there are four times as many places where some fit a surface by
 * chance, and one more of them is as unlikely: no more than a quarter of all that are near lie in
 * its noise. */
static size_t least_among(size_t least, size_t count)
{
    for (size_t points = FEW; points <= count / 4; points *= 4)
        least++;
    return least;
}

static crease_segmentation begin(crease_context *context, crease_regions *regions)
{
    const crease_regions_options *const options = &regions->options;
    const bool known = options->sigma > 0.0;
    crease_segmentation seg = {.context = context,
        .count = regions->count,
        .points = regions->points,
        .neighbours = regions->neighbours->indices,
        .stride = (size_t)regions->neighbours->k,
        .links = links_of(CREASE_LINKS, regions),
        .border_links = links_of(CREASE_BORDER_LINKS, regions),
        .noise = regions->noise,
        .sigma = known ? options->sigma : regions->noise->sigma * sqrt(regions->noise->alike),
        .alike = known ? 1.0 : regions->noise->alike,
        .known_sigma = known || regions->noise->alike > 1.0,
        .spacing = regions->noise->spacing,
        .least_points = least_among(options->least_points, regions->count),
        .labels = regions->labels};
    /* Error of a normal: the noise over half the window's radius and the root of its points. */
    const double pi = acos(-1.0), window = CREASE_NOISE_NEIGHBOURS - 1;
    const double error = seg.sigma / (0.5 * seg.spacing * sqrt(window / pi) * sqrt(window));
    seg.least_cosine = cos(fmin(normals_agree * pi / 180.0 + 2.0 * error, pi / 3.0));
    return seg;
}

static void end(crease_segmentation *seg)
{
    for (size_t r = 0; r < seg->region_count; r++)
        crease_model_clear(&seg->models[r]);
    crease_fitters_free(seg->context, seg->fitters);
    free(seg->models);
    free(seg->tried);
    free(seg->members);
    free(seg->first);
}

static crease_status segment(crease_context *context, crease_regions *regions)
{
    crease_segmentation seg = begin(context, regions);
    crease_status status = crease_fitters_create(context, &seg.fitters);
    if (status == CREASE_OK)
        status = regions->rounded ? run_beside_edges(&seg, regions) : run(&seg);
    if (status == CREASE_OK && regions->options.united)
        status = crease_rounds_unite(&seg, true);
    if (status == CREASE_OK)
        status = crease_regions_take(context, regions, &seg);
    end(&seg);
    return status;
}

/* The segmentation goes on where that of other regions ended. */
static crease_status resume(crease_segmentation *seg, const crease_regions *from)
{
    crease_status status = crease_fitters_create(seg->context, &seg->fitters);
    seg->members = crease_allocate(seg->context, seg->count, sizeof *seg->members);
    if (status == CREASE_OK && !seg->members)
        status = CREASE_ERROR_NO_MEMORY;
    seg->sigma = from->sigma;
    for (size_t r = 0; r < from->region_count && status == CREASE_OK; r++) {
        crease_model model;
        status = crease_model_copy(seg->context, &from->models[r], &model);
        if (status != CREASE_OK)
            break;
        status = crease_segmentation_add(seg, &model);
        if (status != CREASE_OK)
            crease_model_clear(&model);
    }
    return status == CREASE_OK ? crease_segmentation_list(seg) : status;
}

static crease_status unite(
    crease_context *context, crease_regions *regions, const crease_regions *from)
{
    crease_segmentation seg = begin(context, regions);
    crease_status status = resume(&seg, from);
    if (status == CREASE_OK)
        status = crease_rounds_unite(&seg, true);
    if (status == CREASE_OK)
        status = crease_regions_take(context, regions, &seg);
    end(&seg);
    return status;
}

static crease_status check(
    crease_context *context, size_t count, const crease_regions_options *options)
{
    if (!(options->sigma >= 0.0) || !isfinite(options->sigma))
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "regions: a noise of %g; give a length, or 0 to have it estimated", options->sigma);
    if (options->least_points < LEAST_POINTS)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "regions: regions of %zu points; a surface needs %d or more", options->least_points,
            LEAST_POINTS);
    if (count < LEAST_POINTS)
        return crease_fail(context, CREASE_ERROR_TOO_FEW_POINTS,
            "regions: the cloud has %zu points; at least %d are needed", count, LEAST_POINTS);
    return CREASE_OK;
}

crease_status crease_regions_find(crease_context *context, const crease_cloud *cloud,
    const crease_regions_options *options, crease_regions **out)
{
    return crease_regions_find_by(context, cloud, options, crease_surroundings_here, NULL, out);
}

crease_status crease_regions_find_by(crease_context *context, const crease_cloud *cloud,
    const crease_regions_options *options, crease_surroundings_find *surroundings, void *user,
    crease_regions **out)
{
    *out = NULL;
    const crease_regions_options chosen = options ? *options : crease_regions_options_default();
    crease_status status = check(context, crease_cloud_count(cloud), &chosen);
    if (status != CREASE_OK)
        return status;
    crease_regions *const regions = crease_allocate(context, 1, sizeof *regions);
    if (!regions)
        return CREASE_ERROR_NO_MEMORY;
    regions->count = crease_cloud_count(cloud);
    regions->options = chosen;
    status = crease_regions_surround(context, regions, cloud, surroundings, user);
    if (status == CREASE_OK) {
        crease_stage(context, "regions");
        status = segment(context, regions);
    }
    if (status == CREASE_OK)
        status = by_index(context, regions);
    if (status == CREASE_OK)
        *out = regions;
    else
        crease_regions_free(regions);
    return status;
}

crease_status crease_regions_unite(
    crease_context *context, const crease_regions *from, crease_regions **out)
{
    *out = NULL;
    crease_regions *const regions = crease_allocate(context, 1, sizeof *regions);
    if (!regions)
        return CREASE_ERROR_NO_MEMORY;
    regions->options = from->options;
    regions->options.united = true;
    crease_status status = crease_regions_surround_like(context, regions, from);
    if (status == CREASE_OK)
        status = unite(context, regions, from);
    if (status == CREASE_OK)
        status = by_index(context, regions);
    if (status == CREASE_OK)
        *out = regions;
    else
        crease_regions_free(regions);
    return status;
}

void crease_regions_free(crease_regions *regions)
{
    if (!regions)
        return;
    for (size_t r = 0; r < regions->region_count; r++)
        crease_model_clear(&regions->models[r]);
    crease_neighbours_free(regions->neighbours);
    crease_noise_free(regions->noise);
    free(regions->points);
    free(regions->order);
    free(regions->labels);
    free(regions->rounded);
    free(regions->models);
    free(regions->sizes);
    free(regions->rms);
    crease_snaps_clear(&regions->snaps);
    free(regions->labels_by_index);
    free(regions->normals_by_index);
    free(regions);
}

/* --------------------------------------------------------------------------------- accessors -- */

size_t crease_regions_point_count(const crease_regions *regions)
{
    return regions->count;
}

size_t crease_regions_count(const crease_regions *regions)
{
    return regions->region_count;
}

const int32_t *crease_regions_labels(const crease_regions *regions)
{
    return regions->labels_by_index;
}

const double *crease_regions_normals(const crease_regions *regions)
{
    return regions->normals_by_index;
}

double crease_regions_spacing(const crease_regions *regions)
{
    return regions->noise->spacing;
}

double crease_regions_sigma(const crease_regions *regions)
{
    return regions->noise_sigma;
}

static void add_numbers(crease_region *region, const double *numbers, size_t count)
{
    memcpy(region->parameters + region->parameter_count, numbers, count * sizeof *numbers);
    region->parameter_count += count;
}

static void add_errors(crease_region *region, const crease_regions *regions, size_t index)
{
    const crease_model *const model = &regions->models[index];
    const crease_model *planes[2] = {0};
    for (int i = 0; i < model->tangent_count; i++)
        planes[i] = &regions->models[model->tangent[i]];
    const crease_uncertainty errors =
        crease_model_uncertainty(model, model->tangent_count == 2 ? planes : NULL);
    region->place_error = errors.place;
    region->direction_error = errors.direction * 180.0 / acos(-1.0);
    region->radius_error = errors.radius;
    region->shape_error = errors.shape;
}

crease_region crease_regions_at(const crease_regions *regions, size_t index)
{
    const crease_model *const model = &regions->models[index];
    crease_region region = {.type = model->type,
        .point_count = regions->sizes[index],
        .rms = regions->rms[index],
        .chi = model->chi,
        .tangent = {CREASE_NO_REGION, CREASE_NO_REGION}};
    memcpy(region.tangent, model->tangent, (size_t)model->tangent_count * sizeof *model->tangent);
    add_errors(&region, regions, index);
    if (model->type == CREASE_REGION_FREEFORM)
        return region;
    add_numbers(&region, model->centre, 3);
    if (model->type != CREASE_REGION_SPHERE)
        add_numbers(&region, model->axes + 6, 3);
    if (model->type != CREASE_REGION_PLANE)
        add_numbers(&region, &model->radius, 1);
    if (model->type == CREASE_REGION_CONE || model->type == CREASE_REGION_TORUS)
        add_numbers(&region, &model->shape, 1);
    return region;
}

double crease_regions_distance(
    const crease_regions *regions, size_t index, const double place[3], double gradient[3])
{
    return crease_model_distance(&regions->models[index], place, gradient);
}
