/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Surfaces that are parallel, perpendicular, coaxial or equally large within their errors are made
 * so exactly. First the directions, the most certain of them before the others; then the axes of
 * one direction, then the radii, then places about mirror planes: what was settled before is not
 * touched again. A surface that its
 * points then suit clearly less than before is left as it was.
 *
 * Based on: Benko, Kos, Varady, Andor, Martin. Constrained fitting in reverse engineering. 2002
 * (the order of the constraints); here each is met by conditioning the fit's covariance. */
#include "base/memory.h"
#include "primitive/rolling.h"
#include "primitive/uncertainty.h"
#include "snap/snapping.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LEAST_POINTS = 20, SAMPLED = 2000 };

static const double MOST_CHI = 1.5;   /* of a surface that takes part */
static const double MOST_TILT = 0.1;  /* radians: standard error of an axis that takes part */
static const double MOST_RISE = 35.0; /* of the sum of squared distances over the noise; more than
                                         all conditions together allow */
static const double CUT = 5.0;        /* noises beyond which a distance counts no more */

/* ---------------------------------------------------------------------------------- checking -- */

/* Sums of squared distances of the regions' points, cut. */
static void add_squares(
    const crease_regions *regions, const crease_model *models, size_t stride, double *sums)
{
    const double noise = regions->sigma, most = CUT * CUT;
    double gradient[3];
    for (size_t i = 0; i < regions->count; i++) {
        const int32_t label = regions->labels[i];
        if (label < 0)
            continue;
        const crease_model *const model =
            (const crease_model *)(const void *)((const char *)models + stride * (size_t)label);
        const double r = crease_model_distance(model, regions->points + 3 * i, gradient) / noise;
        sums[label] += fmin(r * r, most);
    }
}

/* Bodies that their points do not suit are as they were. */
static crease_status check_points(crease_snapping *all)
{
    double *const before = crease_allocate(all->context, all->count, sizeof *before);
    double *const after = crease_allocate(all->context, all->count, sizeof *after);
    if (before && after) {
        const crease_regions *const regions = all->regions;
        add_squares(regions, regions->models, sizeof *regions->models, before);
        add_squares(regions, &all->bodies[0].model, sizeof *all->bodies, after);
        for (size_t i = 0; i < all->count; i++) {
            const double share = fmax(1.0, (double)regions->sizes[i] / SAMPLED);
            if (all->moved[i] && !(after[i] - before[i] < MOST_RISE * share))
                all->moved[i] = false;
        }
    }
    free(before);
    free(after);
    return before && after ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
}

/* ------------------------------------------------------------------------------------ result -- */

/* A fillet rolls along its planes as they are now. */
static void roll_again(crease_regions *regions, size_t index, const bool *moved)
{
    crease_model *const model = &regions->models[index];
    if (model->tangent_count != 2 || (!moved[model->tangent[0]] && !moved[model->tangent[1]]))
        return;
    const crease_model *const planes[2] = {
        &regions->models[model->tangent[0]], &regions->models[model->tangent[1]]};
    crease_wedge wedge;
    crease_model rolled;
    if (!crease_wedge_make(planes, model->centre, &wedge))
        return;
    crease_rolling_cylinder(&wedge, model->radius, model->centre, &rolled);
    memcpy(model->centre, rolled.centre, sizeof rolled.centre);
    memcpy(model->axes, rolled.axes, sizeof rolled.axes);
}

static void measure_again(crease_regions *regions)
{
    double gradient[3];
    memset(regions->rms, 0, regions->region_count * sizeof *regions->rms);
    for (size_t i = 0; i < regions->count; i++) {
        const int32_t label = regions->labels[i];
        if (label < 0)
            continue;
        const double d =
            crease_model_distance(&regions->models[label], regions->points + 3 * i, gradient);
        regions->rms[label] += d * d;
    }
    for (size_t r = 0; r < regions->region_count; r++)
        regions->rms[r] = sqrt(regions->rms[r] / (double)regions->sizes[r]);
}

static void take_models(crease_snapping *all)
{
    for (size_t i = 0; i < all->count; i++)
        if (all->moved[i])
            crease_body_replace(&all->bodies[i], &all->regions->models[i]);
    for (size_t i = 0; i < all->count; i++)
        roll_again(all->regions, i, all->moved);
    measure_again(all->regions);
}

/* Lists the clusters of two and more that are still in force. */
static crease_status list_clusters(const crease_snapping *all, const crease_clusters *from,
    crease_snap_kind kind, crease_snaps *out)
{
    for (size_t k = 0; k < from->count; k++) {
        const crease_status status = crease_snaps_begin(all->context, out, kind);
        if (status != CREASE_OK)
            return status;
        for (size_t i = 0; i < all->count; i++)
            if (from->of[i] == (int32_t)k && all->moved[i]) {
                const crease_status added = crease_snaps_add(all->context, out, (uint32_t)i);
                if (added != CREASE_OK)
                    return added;
            }
        crease_snaps_end(out);
    }
    return CREASE_OK;
}

/* The first region of a direction that has it still, or the number of regions. */
static size_t first_of(const crease_snapping *all, int32_t direction)
{
    size_t i = 0;
    while (i < all->count && (all->directions.of[i] != direction || !all->moved[i]))
        i++;
    /* the leader of a direction of its own has not moved, and stands for it */
    return i < all->count ? i : all->directions.items[direction].leader;
}

static crease_status list_upright(const crease_snapping *all, crease_snaps *out)
{
    for (size_t k = 0; k < all->directions.count; k++)
        for (int n = 0; n < 2 && all->upright[k][n] >= 0; n++) {
            const size_t pair[2] = {first_of(all, all->upright[k][n]), first_of(all, (int32_t)k)};
            if (all->directions.of[pair[0]] != all->upright[k][n] ||
                all->directions.of[pair[1]] != (int32_t)k || !all->moved[pair[1]])
                continue;
            crease_status status = crease_snaps_begin(all->context, out, CREASE_SNAP_PERPENDICULAR);
            for (int i = 0; i < 2 && status == CREASE_OK; i++)
                status = crease_snaps_add(all->context, out, (uint32_t)pair[i]);
            if (status != CREASE_OK)
                return status;
            crease_snaps_end(out);
        }
    return CREASE_OK;
}

/* A direction and its image. */
static crease_status list_images(const crease_snapping *all, crease_snaps *out)
{
    for (size_t k = 0; k < all->directions.count; k++) {
        const int32_t image = all->image_of[k];
        if (image <= (int32_t)k)
            continue;
        crease_status status = crease_snaps_begin(all->context, out, CREASE_SNAP_SYMMETRIC);
        const size_t pair[2] = {first_of(all, (int32_t)k), first_of(all, image)};
        for (int i = 0; i < 2 && status == CREASE_OK; i++)
            if (all->moved[pair[i]])
                status = crease_snaps_add(all->context, out, (uint32_t)pair[i]);
        if (status != CREASE_OK)
            return status;
        crease_snaps_end(out);
    }
    return CREASE_OK;
}

static crease_status list_mirrors(const crease_snapping *all, crease_snaps *out)
{
    for (size_t m = 0; m < all->mirror_count; m++) {
        crease_status status = crease_snaps_begin(all->context, out, CREASE_SNAP_SYMMETRIC);
        for (size_t i = 0; i < all->count && status == CREASE_OK; i++)
            if (all->mirrored[all->count * m + i] && all->moved[i])
                status = crease_snaps_add(all->context, out, (uint32_t)i);
        if (status != CREASE_OK)
            return status;
        crease_snaps_end(out);
    }
    return CREASE_OK;
}

static crease_status list_all(const crease_snapping *all, crease_snaps *out)
{
    crease_snaps_clear(out);
    crease_status status = list_clusters(all, &all->directions, CREASE_SNAP_PARALLEL, out);
    if (status == CREASE_OK)
        status = list_upright(all, out);
    if (status == CREASE_OK)
        status = list_clusters(all, &all->axes, CREASE_SNAP_COAXIAL, out);
    if (status == CREASE_OK)
        status = list_clusters(all, &all->radii, CREASE_SNAP_EQUAL_RADII, out);
    if (status == CREASE_OK)
        status = list_images(all, out);
    if (status == CREASE_OK)
        status = list_mirrors(all, out);
    return status;
}

static void choose_bodies(crease_snapping *all)
{
    const crease_regions *const regions = all->regions;
    for (size_t i = 0; i < all->count; i++) {
        const crease_model *const model = &regions->models[i];
        all->bodies[i] = crease_body_of(model);
        all->takes_part[i] = model->type != CREASE_REGION_FREEFORM && model->tangent_count == 0 &&
            model->chi <= MOST_CHI && regions->sizes[i] >= LEAST_POINTS &&
            model->covariance[0] > 0.0;
        all->has_axis[i] = all->takes_part[i] && model->type != CREASE_REGION_SPHERE &&
            crease_model_uncertainty(model, NULL).direction < MOST_TILT;
    }
}

static crease_status snap(crease_snapping *all)
{
    choose_bodies(all);
    crease_status status = crease_snap_directions(all);
    if (status == CREASE_OK)
        status = crease_snap_axes(all);
    if (status == CREASE_OK)
        status = crease_snap_radii(all);
    if (status == CREASE_OK)
        status = crease_snap_symmetry(all);
    if (status == CREASE_OK)
        status = check_points(all);
    if (status == CREASE_OK)
        status = list_all(all, &all->regions->snaps);
    if (status == CREASE_OK)
        take_models(all);
    all->regions->snapped = status == CREASE_OK;
    return status;
}

crease_status crease_regions_snap(crease_context *context, crease_regions *regions)
{
    const size_t count = regions->region_count;
    if (count == 0 || regions->snapped)
        return CREASE_OK;
    crease_snapping all = {.context = context, .regions = regions, .count = count};
    crease_status status = CREASE_ERROR_NO_MEMORY;
    all.bodies = crease_allocate(context, count, sizeof *all.bodies);
    all.takes_part = crease_allocate(context, count, sizeof *all.takes_part);
    all.has_axis = crease_allocate(context, count, sizeof *all.has_axis);
    all.moved = crease_allocate(context, count, sizeof *all.moved);
    if (all.bodies && all.takes_part && all.has_axis && all.moved)
        status = snap(&all);
    crease_clusters_clear(&all.directions);
    crease_clusters_clear(&all.axes);
    crease_clusters_clear(&all.radii);
    free(all.bodies);
    free(all.takes_part);
    free(all.has_axis);
    free(all.moved);
    free(all.axis_of);
    free(all.across);
    free(all.upright);
    free(all.image_of);
    free(all.mirrored);
    return status;
}
