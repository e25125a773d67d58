/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "segment/assign.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "base/select.h"
#include "segment/segmentation.h"
#include "space/nearest.h"

#include <math.h>
#include <stdlib.h>

enum { GRAIN = 1024 };

static const double outlier_sigmas = 5.0;
static const double flatness = 0.03;   /* least sigma in spacings: see noise/noise.h */
static const double to_sigma = 1.4826; /* from the median of absolute values */

/* All labelled points, region by region; first: where those of each begin, and the end. */
static void list_members(const crease_regions *regions, size_t *first, uint32_t *members)
{
    for (size_t i = 0; i < regions->count; i++)
        if (regions->labels[i] >= 0)
            first[regions->labels[i]]++;
    for (size_t r = 0, sum = 0; r <= regions->region_count; r++) {
        sum += first[r];
        first[r] = sum;
    }
    for (size_t i = regions->count; i-- > 0;)
        if (regions->labels[i] >= 0)
            members[--first[regions->labels[i]]] = (uint32_t)i;
}

/* How far the points are from their regions' surfaces, by robust means: in sparse samples the noise
 * is overrated, because the surface bends between neighbours. Like the noise it is at least a small
 * share of the spacing, and never more than what was found from the sample. */
static double sigma_of(
    const crease_regions *regions, double spacing, double *distances, size_t count)
{
    const double least = flatness * spacing;
    const double sigma = count ? to_sigma * crease_select(distances, count, count / 2) : 0.0;
    return fmin(regions->sigma, fmax(sigma, least));
}

/* Distances of members from the surface of their region. */
static void measure(const crease_regions *regions, const uint32_t *members, size_t count, double *d)
{
    double gradient[3];
    for (size_t m = 0; m < count; m++)
        d[m] = fabs(crease_model_distance(&regions->models[regions->labels[members[m]]],
            regions->points + 3 * (size_t)members[m], gradient));
}

static void judge(
    crease_assignment *out, double spacing, const size_t *first, const uint32_t *members, double *d)
{
    const crease_regions *const regions = out->regions;
    const size_t count = regions->region_count;
    measure(regions, members, first[count], d);
    out->sigma = sigma_of(regions, spacing, d, first[count]);
    measure(regions, members, first[count], d); /* the selection has moved them */
    for (size_t r = 0; r < count; r++) {
        const size_t size = first[r + 1] - first[r];
        const double median = size ? crease_select(d + first[r], size, size / 2) : 0.0;
        out->farthest[r] = outlier_sigmas * fmax(to_sigma * median, out->sigma);
    }
}

static crease_status find_farthest(crease_context *context, double spacing, crease_assignment *out)
{
    const crease_regions *const regions = out->regions;
    const size_t count = regions->region_count;
    size_t *const first = crease_allocate(context, count + 1, sizeof *first);
    uint32_t *const members = crease_allocate(context, regions->count, sizeof *members);
    double *const distances = crease_allocate(context, regions->count, sizeof *distances);
    out->farthest = crease_allocate(context, count, sizeof *out->farthest);
    const bool enough = first && members && distances && out->farthest;
    if (enough) {
        list_members(regions, first, members);
        judge(out, spacing, first, members, distances);
    }
    free(first);
    free(members);
    free(distances);
    return enough ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
}

crease_status crease_assignment_create(
    crease_context *context, const crease_regions *regions, double spacing, crease_assignment *out)
{
    *out = (crease_assignment){.regions = regions,
        .links = regions->count < CREASE_LINKS ? (int)regions->count : CREASE_LINKS};
    crease_status status = find_farthest(context, spacing, out);
    if (status == CREASE_OK)
        status = crease_tree_create(context, regions->points, regions->count, &out->tree);
    if (status != CREASE_OK)
        crease_assignment_free(out);
    return status;
}

void crease_assignment_free(crease_assignment *assignment)
{
    crease_tree_free(assignment->tree);
    free(assignment->farthest);
    *assignment = (crease_assignment){0};
}

void crease_regions_slim(crease_regions *regions)
{
    crease_neighbours_free(regions->neighbours);
    regions->neighbours = NULL;
    free(regions->noise->normals);
    free(regions->noise->scores);
    free(regions->noise->local_spacing);
    regions->noise->normals = NULL;
    regions->noise->scores = regions->noise->local_spacing = NULL;
    free(regions->normals_by_index);
    regions->normals_by_index = NULL;
}

/* -------------------------------------------------------------------------------- assigning -- */

typedef struct assigning {
    const crease_assignment *to;
    const double *points;
    const uint8_t *own;
    int32_t *labels;
    double *distances;
} assigning;

/* The cheapest region, and the signed distance from it. */
static int32_t cheapest(
    const crease_assignment *to, const double place[3], const uint32_t *near, double *distance)
{
    const crease_regions *const regions = to->regions;
    int32_t best = CREASE_NO_REGION, seen[CREASE_LINKS];
    double least = INFINITY, gradient[3];
    int count = 0;
    for (int j = 0; j < to->links; j++) {
        const int32_t label = regions->labels[near[j]];
        bool known = label < 0;
        int links = 0;
        for (int i = 0; i < count && !known; i++)
            known = seen[i] == label;
        if (known)
            continue;
        seen[count++] = label;
        for (int i = j; i < to->links; i++)
            links += regions->labels[near[i]] == label;
        const double d = crease_model_distance(&regions->models[label], place, gradient);
        const double r = d / to->sigma;
        const double price = 0.5 * fmin(r * r, CREASE_RESIDUAL_CUT) - CREASE_LINK_PRICE * links;
        if (price < least) {
            least = price;
            best = label;
            *distance = d;
        }
    }
    return best;
}

static void assign_some(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const assigning *const run = user;
    const crease_assignment *const to = run->to;
    const crease_regions *const regions = to->regions;
    uint32_t near[CREASE_LINKS];
    double squared[CREASE_LINKS];
    for (size_t i = begin; i < end; i++) {
        if (!run->own[i])
            continue;
        crease_tree_nearest_place(
            to->tree, run->points + 3 * i, CREASE_NO_POSITION, to->links, near, squared);
        for (int j = 0; j < to->links; j++)
            near[j] = to->tree->index[near[j]];
        run->distances[i] = 0.0;
        run->labels[i] = cheapest(to, run->points + 3 * i, near, &run->distances[i]);
        const bool beside = regions->rounded && regions->rounded[near[0]];
        if (run->labels[i] >= 0 && !beside &&
            fabs(run->distances[i]) > to->farthest[run->labels[i]])
            run->labels[i] = CREASE_NO_REGION;
    }
}

crease_status crease_assign(crease_context *context, const crease_assignment *assignment,
    const double *points, const uint8_t *own, size_t count, int32_t *labels, double *distances)
{
    assigning run = {assignment, points, own, labels, distances};
    return crease_parallel_for(context, count, GRAIN, assign_some, &run);
}
