/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Regions from a cloud: the stages of segmentation.h in turn, until nothing changes. */
#include "segment/region.h"

#include "base/memory.h"
#include "base/select.h"
#include "base/store.h"
#include "cloud/blur.h"
#include "cloud/cloud.h"
#include "segment/excerpt.h"
#include "segment/fillet.h"
#include "segment/segmentation.h"
#include "segment/uncertainty.h"
#include "space/morton.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    LEAST_POINTS = 8,
    ROUNDS = 6,
    LABEL_ROUNDS = 12,
    FIRST_SAMPLE = 300,
    FIRST_LARGE = 100,
    SAMPLE = 800,
    LARGE = 50,
    LARGE_SAMPLE = 2000,
    STILL = 1000 /* at most one label in this many changes: the result stands */
};

static const double normals_agree = 20.0; /* degrees between a point's normal and its region's, on
                                             top of twice the error of the normals */
static const double outlier_sigmas = 5.0;
static const double waving = 1.5; /* mean square residual of a face, in square sigmas, that shared
                                     errors leave at most */

crease_regions_options crease_regions_options_default(void)
{
    return (crease_regions_options){.least_points = LEAST_POINTS};
}

/* ---------------------------------------------------------------------------------- the line -- */

/* What one round did. */
typedef struct progress {
    size_t merged, dropped, reconsidered, changed;
} progress;

static crease_status relabel(crease_segmentation *seg, int rounds, progress *done)
{
    size_t changed = 0;
    const crease_status status = crease_relabel(seg, rounds, &changed);
    done->changed += changed;
    return status;
}

static void set_sigma(crease_segmentation *seg)
{
    for (int i = 0; i < crease_context_threads(seg->context); i++)
        seg->fitters[i].sigma = seg->sigma;
}

static crease_status improve(crease_segmentation *seg, int number, progress *done)
{
    crease_status status = number == 1 || number == 2 ? crease_grow(seg) : CREASE_OK;
    if (status == CREASE_OK)
        status = crease_segmentation_list(seg);
    if (status == CREASE_OK)
        status = number ? crease_merge(seg, SAMPLE, LARGE, &done->merged)
                        : crease_merge(seg, FIRST_SAMPLE, FIRST_LARGE, &done->merged);
    if (status == CREASE_OK)
        status = relabel(seg, LABEL_ROUNDS, done);
    if (status == CREASE_OK && number < 4)
        status = crease_reconsider(seg, &done->reconsidered);
    if (status == CREASE_OK && done->reconsidered)
        status = relabel(seg, LABEL_ROUNDS, &(progress){0});
    if (status == CREASE_OK)
        status = crease_give_up(seg, &done->dropped);
    return status;
}

static crease_status settle(crease_segmentation *seg, int number, progress *done)
{
    const bool keep_kinds = number > 0 || done->reconsidered;
    crease_status status = crease_refit(seg, number ? LARGE_SAMPLE : SAMPLE, keep_kinds);
    if (status == CREASE_OK)
        status = relabel(seg, LABEL_ROUNDS, done);
    if (status == CREASE_OK) {
        crease_segmentation_compact(seg);
        status = crease_refit(seg, LARGE_SAMPLE, keep_kinds);
    }
    if (status == CREASE_OK)
        status = crease_measure_noise(seg);
    set_sigma(seg);
    return status;
}

static bool stands(const crease_segmentation *seg, const progress *done)
{
    return done->changed < seg->count / STILL + 1;
}

static crease_status polish(crease_segmentation *seg)
{
    crease_status status = crease_refit_closely(seg);
    for (int i = 0; i < 2 && status == CREASE_OK; i++) {
        progress done = {0};
        status = relabel(seg, LABEL_ROUNDS / 2, &done);
        if (stands(seg, &done))
            break;
        if (status == CREASE_OK)
            status = crease_refit_closely(seg);
    }
    if (status == CREASE_OK)
        crease_segmentation_compact(seg);
    return status;
}

/* Where neighbouring points err alike, a face waves by more than independent errors explain, and
 * falls apart. Its pieces are joined where a simple surface follows them about as well as that. */
static crease_status join_waves(crease_segmentation *seg)
{
    if (!(seg->alike > 1.0))
        return CREASE_OK;
    crease_status status = crease_merge_within(seg, SAMPLE, waving);
    if (status == CREASE_OK)
        status = relabel(seg, LABEL_ROUNDS, &(progress){0});
    if (status == CREASE_OK) {
        crease_segmentation_compact(seg);
        status = crease_refit(seg, LARGE_SAMPLE, true);
    }
    return status;
}

static crease_status unite(crease_segmentation *seg, bool wide)
{
    size_t united = 0;
    const crease_status status = crease_unite(seg, wide, &united);
    return status == CREASE_OK && united ? polish(seg) : status;
}

/* Free forms that were found in pieces. Where neighbours err alike the noise would explain too
 * much. */
static crease_status join_pieces(crease_segmentation *seg)
{
    return seg->alike > 1.0 ? CREASE_OK : unite(seg, false);
}

static crease_status run_stages(crease_segmentation *seg)
{
    set_sigma(seg);
    crease_status status = crease_grow(seg);
    for (int number = 0; number < ROUNDS && status == CREASE_OK; number++) {
        progress done = {0};
        status = improve(seg, number, &done);
        if (status == CREASE_OK)
            status = settle(seg, number, &done);
        if (number > 0 && !done.merged && !done.dropped && !done.reconsidered && stands(seg, &done))
            break;
    }
    if (status == CREASE_OK)
        status = polish(seg);
    if (status == CREASE_OK)
        status = join_waves(seg);
    if (status == CREASE_OK)
        status = join_pieces(seg);
    return status == CREASE_OK ? crease_fillets_find(seg) : status;
}

/* ------------------------------------------------------------------------------------ result -- */

typedef struct ranked {
    size_t size, region;
} ranked;

static int compare_ranks(const void *a, const void *b)
{
    const ranked *x = a, *y = b;
    if (x->size != y->size)
        return x->size > y->size ? -1 : 1;
    return x->region < y->region ? -1 : x->region > y->region;
}

/* Points far from the surface of their region, by the noise or by the region's own residuals where
 * these are larger, are no part of it. Those on rounded edges are beside it by nature. */
static void set_outliers_aside(
    crease_regions *regions, const crease_segmentation *seg, size_t region, double *scratch)
{
    const size_t begin = seg->first[region], size = crease_segmentation_size(seg, region);
    double gradient[3];
    size_t known = 0, beside = 0;
    for (size_t m = 0; m < size; m++) {
        const size_t point = seg->members[begin + m];
        if (regions->rounded && regions->rounded[point])
            continue;
        scratch[known++] =
            fabs(crease_model_distance(&seg->models[region], seg->points + 3 * point, gradient));
    }
    const double sigma = regions->noise_sigma;
    const double median = known ? crease_select(scratch, known, known / 2) : 0.0;
    const double scale = fmax(1.4826 * median, sigma);
    double squares = 0.0, cut = 0.0;
    size_t kept = 0;
    for (size_t m = 0; m < size; m++) {
        const size_t point = seg->members[begin + m];
        if (regions->rounded && regions->rounded[point]) {
            beside++;
            continue;
        }
        const double d =
            crease_model_distance(&seg->models[region], seg->points + 3 * point, gradient);
        if (fabs(d) > outlier_sigmas * scale) {
            regions->labels[point] = CREASE_NO_REGION;
            continue;
        }
        squares += d * d;
        cut += fmin(d * d / (sigma * sigma), CREASE_COST_CUT);
        kept++;
    }
    regions->sizes[region] = kept + beside;
    regions->rms[region] = kept ? sqrt(squares / (double)kept) : 0.0;
    seg->models[region].chi = kept ? cut / (double)kept : 0.0;
}

/* Numbers the regions from large to small. */
static crease_status rank_regions(crease_context *context, crease_regions *regions)
{
    const size_t count = regions->region_count;
    crease_status status = CREASE_ERROR_NO_MEMORY;
    ranked *const ranks = crease_allocate(context, count, sizeof *ranks);
    int32_t *const number = crease_allocate(context, count, sizeof *number);
    crease_model *const models = crease_duplicate(context, regions->models, count, sizeof *models);
    double *const rms = crease_duplicate(context, regions->rms, count, sizeof *rms);
    if (ranks && number && models && rms) {
        for (size_t r = 0; r < count; r++)
            ranks[r] = (ranked){regions->sizes[r], r};
        qsort(ranks, count, sizeof *ranks, compare_ranks);
        for (size_t r = 0; r < count; r++) {
            const size_t from = ranks[r].region;
            number[from] = (int32_t)r;
            regions->models[r] = models[from];
            regions->rms[r] = rms[from];
            regions->sizes[r] = ranks[r].size;
        }
        for (size_t r = 0; r < count; r++)
            for (int i = 0; i < regions->models[r].tangent_count; i++)
                regions->models[r].tangent[i] = number[models[ranks[r].region].tangent[i]];
        for (size_t i = 0; i < regions->count; i++)
            if (regions->labels[i] >= 0)
                regions->labels[i] = number[regions->labels[i]];
        status = CREASE_OK;
    }
    free(ranks);
    free(number);
    free(models);
    free(rms);
    return status;
}

/* Takes the models over from the segmentation. */
static crease_status take_models(
    crease_context *context, crease_regions *regions, crease_segmentation *seg)
{
    const size_t count = seg->region_count;
    regions->sizes = crease_allocate(context, count, sizeof *regions->sizes);
    regions->rms = crease_allocate(context, count, sizeof *regions->rms);
    double *const scratch = crease_allocate(context, regions->count, sizeof *scratch);
    const bool enough = regions->sizes && regions->rms && scratch;
    regions->sigma = seg->sigma;
    regions->noise_sigma = seg->sigma / sqrt(seg->alike);
    for (size_t r = 0; r < count && enough; r++)
        set_outliers_aside(regions, seg, r, scratch);
    free(scratch);
    if (!enough)
        return CREASE_ERROR_NO_MEMORY;
    regions->models = seg->models;
    regions->region_count = count;
    seg->models = NULL;
    seg->region_count = 0;
    return rank_regions(context, regions);
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
    return seg->members ? run_stages(seg) : CREASE_ERROR_NO_MEMORY;
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

static crease_status segment(
    crease_context *context, crease_regions *regions, const crease_regions_options *options)
{
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
        .least_points = options->least_points,
        .labels = regions->labels};
    /* Error of a normal: the noise over half the window's radius and the root of its points. */
    const double pi = acos(-1.0), window = CREASE_NOISE_NEIGHBOURS - 1;
    const double error = seg.sigma / (0.5 * seg.spacing * sqrt(window / pi) * sqrt(window));
    seg.least_cosine = cos(fmin(normals_agree * pi / 180.0 + 2.0 * error, pi / 3.0));
    crease_status status = crease_fitters_create(context, &seg.fitters);
    if (status == CREASE_OK)
        status = regions->rounded ? run_beside_edges(&seg, regions) : run(&seg);
    if (status == CREASE_OK && options->united)
        status = unite(&seg, true);
    if (status == CREASE_OK)
        status = take_models(context, regions, &seg);
    for (size_t r = 0; r < seg.region_count; r++)
        crease_model_clear(&seg.models[r]);
    crease_fitters_free(context, seg.fitters);
    free(seg.models);
    free(seg.tried);
    free(seg.members);
    free(seg.first);
    return status;
}

/* Marks the points on rounded edges, if the scanner has rounded them all. */
static crease_status find_rounded(crease_context *context, crease_regions *regions)
{
    bool blurred = false;
    if (!(regions->noise->alike > 1.0))
        return CREASE_OK;
    regions->rounded = crease_allocate(context, regions->count, sizeof *regions->rounded);
    if (!regions->rounded)
        return CREASE_ERROR_NO_MEMORY;
    const crease_status status = crease_blur_find(
        context, regions->points, regions->count, regions->noise, &blurred, regions->rounded);
    if (!blurred) {
        free(regions->rounded);
        regions->rounded = NULL;
    }
    return status;
}

/* The points in Morton order. */
static crease_status sort_points(
    crease_context *context, crease_regions *regions, const crease_cloud *cloud)
{
    const size_t count = regions->count;
    regions->order = crease_allocate(context, count, sizeof *regions->order);
    regions->points = crease_allocate(context, count, 3 * sizeof *regions->points);
    regions->labels = crease_allocate(context, count, sizeof *regions->labels);
    uint64_t *const keys = crease_allocate(context, count, sizeof *keys);
    crease_status status = CREASE_ERROR_NO_MEMORY;
    if (regions->order && regions->points && regions->labels && keys)
        status =
            crease_morton_sort(context, crease_cloud_points(cloud), count, keys, regions->order);
    free(keys);
    for (size_t i = 0; i < count && status == CREASE_OK; i++)
        memcpy(regions->points + 3 * i, crease_cloud_points(cloud) + 3 * (size_t)regions->order[i],
            3 * sizeof(double));
    return status;
}

static crease_status find_surroundings(crease_context *context, void *user, const double *points,
    size_t count, int k, crease_neighbours **neighbours, crease_noise **noise)
{
    (void)user;
    const crease_cloud sorted = {.count = count, .points = (double *)(uintptr_t)points};
    const crease_status status = crease_neighbours_find(context, &sorted, k, neighbours);
    return status == CREASE_OK ? crease_noise_estimate_from(context, points, *neighbours, noise)
                               : status;
}

static void list_arrays(const crease_regions *regions, double numbers[3], crease_stored arrays[5])
{
    const crease_noise *const noise = regions->noise;
    const size_t count = regions->count, k = (size_t)regions->neighbours->k;
    arrays[0] = (crease_stored){regions->neighbours->indices, count * k * sizeof(uint32_t)};
    arrays[1] = (crease_stored){noise->normals, 3 * count * sizeof *noise->normals};
    arrays[2] = (crease_stored){noise->scores, count * sizeof *noise->scores};
    arrays[3] = (crease_stored){noise->local_spacing, count * sizeof *noise->local_spacing};
    arrays[4] = (crease_stored){numbers, 3 * sizeof *numbers};
}

static uint64_t key_of(const crease_regions *regions)
{
    const uint64_t key = crease_store_key(0, crease_version(), strlen(crease_version()));
    return crease_store_key(key, regions->points, 3 * regions->count * sizeof *regions->points);
}

/* What is known of the surroundings already. *known: false when it is nothing. */
static crease_status load(crease_context *context, crease_regions *regions, int k, bool *known)
{
    crease_stored arrays[5];
    double numbers[3];
    crease_status status =
        crease_neighbours_create(context, regions->count, k, &regions->neighbours);
    if (status == CREASE_OK)
        status = crease_noise_create(context, regions->count, &regions->noise);
    if (status != CREASE_OK)
        return status;
    list_arrays(regions, numbers, arrays);
    *known = crease_store_load(context, "surroundings", key_of(regions), arrays, 5);
    if (*known) {
        regions->noise->spacing = numbers[0];
        regions->noise->sigma = numbers[1];
        regions->noise->alike = numbers[2];
        return CREASE_OK;
    }
    crease_neighbours_free(regions->neighbours);
    crease_noise_free(regions->noise);
    regions->neighbours = NULL;
    regions->noise = NULL;
    return CREASE_OK;
}

static void save(crease_context *context, const crease_regions *regions)
{
    crease_stored arrays[5];
    double numbers[3] = {regions->noise->spacing, regions->noise->sigma, regions->noise->alike};
    list_arrays(regions, numbers, arrays);
    crease_store_save(context, "surroundings", key_of(regions), arrays, 5);
}

static crease_status find(crease_context *context, crease_regions *regions,
    const crease_regions_options *options, crease_surroundings_find *surroundings, void *user)
{
    const int k =
        regions->count < CREASE_NOISE_NEIGHBOURS ? (int)regions->count : CREASE_NOISE_NEIGHBOURS;
    bool known = false;
    crease_status status = context->kept ? load(context, regions, k, &known) : CREASE_OK;
    if (status == CREASE_OK && !known) {
        status = surroundings(context, user, regions->points, regions->count, k,
            &regions->neighbours, &regions->noise);
        if (status == CREASE_OK && context->kept)
            save(context, regions);
    }
    if (status == CREASE_OK)
        status = find_rounded(context, regions);
    if (status != CREASE_OK)
        return status;
    crease_stage(context, "regions");
    status = segment(context, regions, options);
    return status == CREASE_OK ? by_index(context, regions) : status;
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
    return crease_regions_find_by(context, cloud, options, find_surroundings, NULL, out);
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
    status = sort_points(context, regions, cloud);
    if (status == CREASE_OK)
        status = find(context, regions, &chosen, surroundings, user);
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
