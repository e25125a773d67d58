/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A fillet is narrow and its neighbours are tangent to it, so that what is found there by itself is
 * often wrong: a chamfer, a cone, several pieces. But when the two planes beside it are known, its
 * radius is all that is unknown (see rolling.h). So clusters of small regions between two planes
 * are compared, by all points around, with the profile plane | arc | plane, and with the sharp edge
 * plane | plane. In the end the planes are fitted again, without the points that the fillets took
 * from them, and the fillets once more to these planes. */
#include "segment/fillet.h"

#include "base/memory.h"
#include "base/vector.h"
#include "segment/blend.h"
#include "segment/contact.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LEAST_LINKS = 4, MOST_PLANES = 32, LOOKED_AT = 64, SAMPLE = 2000, MOST_PASSES = 4 };

/* Share of the smaller plane that a plane between them may have. */
static const double small = 0.6;
/* Mean square of the part of a fillet's normals along the edge. */
static const double across = 0.1;

typedef struct inquiry {
    crease_segmentation *seg;
    crease_contacts contacts;
    crease_blend *items;
    size_t count, room;
    bool fresh;
} inquiry;

/* ------------------------------------------------------------------------------- candidates -- */

static bool has(const int32_t *list, int count, int32_t wanted)
{
    for (int i = 0; i < count; i++)
        if (list[i] == wanted)
            return true;
    return false;
}

/* Whether the region's normals are across the direction, as those of a fillet along it. */
static bool is_across(const crease_segmentation *seg, int32_t region, const double direction[3])
{
    const size_t size = crease_segmentation_size(seg, (size_t)region);
    const size_t looked = size < LOOKED_AT ? size : LOOKED_AT;
    double sum = 0.0, gradient[3];
    for (size_t i = 0; i < looked; i++) {
        const size_t point = seg->members[seg->first[region] + i * size / looked];
        crease_model_distance(&seg->models[region], seg->points + 3 * point, gradient);
        const double along = crease_vector_dot(gradient, direction);
        sum += along * along;
    }
    return sum < across * (double)looked;
}

static bool is_fillet_of(const crease_model *model, const int32_t planes[2])
{
    return model->tangent_count == 2 && has(planes, 2, model->tangent[0]) &&
        has(planes, 2, model->tangent[1]);
}

static bool is_part(
    const inquiry *at, int32_t region, const int32_t planes[2], const double edge[3])
{
    const crease_segmentation *const seg = at->seg;
    const crease_model *const model = &seg->models[region];
    const double size = (double)crease_segmentation_size(seg, (size_t)region);
    if (region == planes[0] || region == planes[1] ||
        (model->tangent_count > 0 && !is_fillet_of(model, planes)))
        return false;
    for (int i = 0; i < 2; i++)
        if (size > small * (double)crease_segmentation_size(seg, (size_t)planes[i]) &&
            model->type == CREASE_REGION_PLANE)
            return false;
    return is_across(seg, region, edge);
}

static bool touches(const inquiry *at, int32_t region, int32_t plane)
{
    return crease_contacts_has(&at->contacts, region, plane);
}

/* Gathers the parts that hang together with the first, all of them beside a plane or not; false
 * unless they lead from plane to plane and the first has the lowest number of those beside a plane,
 * so that each cluster is found once. */
static bool gather(const inquiry *at, int32_t first, bool all_beside, crease_blend *out)
{
    const crease_contacts *const contacts = &at->contacts;
    const crease_model *const models = at->seg->models;
    const int32_t *const planes = out->planes;
    double edge[3];
    bool reached[2] = {false, false};
    crease_vector_cross(models[planes[0]].axes + 6, models[planes[1]].axes + 6, edge);
    crease_vector_normalise(edge);
    if (!is_part(at, first, planes, edge))
        return false;
    out->parts[0] = first;
    out->count = 1;
    for (int p = 0; p < out->count; p++) {
        const int32_t part = out->parts[p];
        for (int i = 0; i < 2; i++)
            reached[i] |= touches(at, part, planes[i]);
        for (size_t i = contacts->first[part]; i < contacts->first[part + 1]; i++) {
            const int32_t next = contacts->to[i];
            const bool beside = touches(at, next, planes[0]) || touches(at, next, planes[1]);
            if (has(out->parts, out->count, next) || (all_beside && !beside) ||
                !is_part(at, next, planes, edge))
                continue;
            if ((beside && next < first) || out->count == CREASE_BLEND_PARTS)
                return false;
            out->parts[out->count++] = next;
        }
    }
    return reached[0] && reached[1] && (out->count > 1 || models[first].tangent_count == 0);
}

static void add_planes(const inquiry *at, int32_t region, int32_t *planes, int *count)
{
    for (size_t i = at->contacts.first[region]; i < at->contacts.first[region + 1]; i++) {
        const int32_t next = at->contacts.to[i];
        if (at->seg->models[next].type == CREASE_REGION_PLANE && *count < MOST_PLANES &&
            !has(planes, *count, next))
            planes[(*count)++] = next;
    }
}

static crease_status add(inquiry *at, const crease_blend *one)
{
    if (at->count == at->room) {
        const size_t room = 2 * at->room + 16;
        crease_blend *const items =
            crease_reallocate(at->seg->context, at->items, room, sizeof *items);
        if (!items)
            return CREASE_ERROR_NO_MEMORY;
        at->items = items;
        at->room = room;
    }
    at->items[at->count++] = *one;
    return CREASE_OK;
}

/* Planes that the region touches, then those that its neighbours and theirs touch; returns how many
 * are of the first kind. */
static int list_planes(const inquiry *at, int32_t region, int32_t *planes, int *count)
{
    const crease_contacts *const contacts = &at->contacts;
    *count = 0;
    add_planes(at, region, planes, count);
    const int beside = *count;
    for (size_t i = contacts->first[region]; i < contacts->first[region + 1]; i++)
        add_planes(at, contacts->to[i], planes, count);
    for (size_t i = contacts->first[region]; i < contacts->first[region + 1]; i++) {
        const int32_t next = contacts->to[i];
        if (at->seg->models[next].type != CREASE_REGION_PLANE)
            for (size_t j = contacts->first[next]; j < contacts->first[next + 1]; j++)
                add_planes(at, contacts->to[j], planes, count);
    }
    return beside;
}

/* All clusters in which the region has the lowest number. */
static crease_status suppose(inquiry *at, int32_t region)
{
    int32_t planes[MOST_PLANES];
    int count;
    const int beside = list_planes(at, region, planes, &count);
    crease_status status = CREASE_OK;
    for (int a = 0; a < beside; a++)
        for (int b = a + 1; b < count && status == CREASE_OK; b++) {
            crease_blend strict = {.planes = {planes[a], planes[b]}}, loose = strict;
            const bool found = gather(at, region, true, &strict);
            if (found)
                status = add(at, &strict);
            if (status == CREASE_OK && gather(at, region, false, &loose) &&
                !(found && strict.count == loose.count))
                status = add(at, &loose);
        }
    return status;
}

/* All fillets that there are. */
static crease_status list_fillets(inquiry *at)
{
    crease_status status = CREASE_OK;
    for (size_t r = 0; r < at->seg->region_count && status == CREASE_OK; r++) {
        const crease_model *const model = &at->seg->models[r];
        const crease_blend one = {
            .planes = {model->tangent[0], model->tangent[1]}, .parts = {(int32_t)r}, .count = 1};
        if (model->tangent_count > 0)
            status = add(at, &one);
    }
    return status;
}

static void judge(void *user, size_t begin, size_t end, int worker)
{
    const inquiry *const at = user;
    for (size_t i = begin; i < end; i++)
        if (crease_blend_judge(at->seg, &at->seg->fitters[worker], at->fresh, &at->items[i]) !=
            CREASE_OK)
            atomic_store(&at->seg->no_memory, true);
}

static crease_status judge_all(inquiry *at)
{
    return crease_segmentation_parallel(at->seg, at->count, 1, judge, at);
}

/* ----------------------------------------------------------------------------------- change -- */

/* The cheapest of the given label and those around a point. */
static int32_t cheapest(const crease_segmentation *seg, size_t point, int32_t given)
{
    const uint32_t *const near = crease_segmentation_near(seg, point);
    double least = crease_segmentation_price(seg, &seg->models[given], point);
    int32_t best = given;
    for (int j = 1; j <= seg->links; j++) {
        const int32_t label = seg->labels[near[j]];
        if (label < 0)
            continue;
        const double price = crease_segmentation_price(seg, &seg->models[label], point);
        if (price < least) {
            least = price;
            best = label;
        }
    }
    return best;
}

/* Points beside the profile go to its parts, others that were between the planes to whatever
 * explains them best. */
static void relabel_point(crease_segmentation *seg, const crease_blend *blend, size_t point)
{
    crease_section at;
    crease_rolling_part part;
    if (!crease_blend_holds(blend, seg->points + 3 * point, &at))
        return;
    const double r = crease_rolling_distance(&blend->wedge, blend->radius, at, &part) / seg->sigma;
    if (part == CREASE_ROLLING_ARC && blend->radius == 0.0)
        part = at.height[1] < at.height[0] ? CREASE_ROLLING_SECOND : CREASE_ROLLING_FIRST;
    const int32_t label = part == CREASE_ROLLING_ARC ? blend->parts[0] : blend->planes[part];
    if (r * r <= CREASE_RESIDUAL_CUT)
        seg->labels[point] = label;
    else if (!has(blend->planes, 2, seg->labels[point]))
        seg->labels[point] = cheapest(seg, point, label);
}

static crease_status relabel(crease_segmentation *seg, const crease_blend *blend)
{
    for (int p = 0; p < blend->count; p++) {
        const int32_t part = blend->parts[p];
        for (size_t m = seg->first[part]; m < seg->first[part + 1]; m++)
            relabel_point(seg, blend, seg->members[m]);
    }
    for (int i = 0; i < 2; i++) {
        const int32_t plane = blend->planes[i];
        for (size_t m = seg->first[plane]; m < seg->first[plane + 1]; m++)
            relabel_point(seg, blend, seg->members[m]);
    }
    for (int p = 0; p < blend->count; p++) {
        const int32_t part = blend->parts[p];
        for (size_t m = seg->first[part]; m < seg->first[part + 1]; m++) {
            int32_t *const label = &seg->labels[seg->members[m]];
            if (has(blend->parts + 1, blend->count - 1, *label))
                *label = blend->parts[0];
        }
    }
    return crease_segmentation_list(seg);
}

/* The model of the first part becomes the fillet. */
static void round_edge(crease_segmentation *seg, const crease_blend *blend)
{
    const int32_t own = blend->parts[0];
    const uint32_t *const members = seg->members + seg->first[own];
    const size_t size = crease_segmentation_size(seg, (size_t)own);
    crease_fitter *const fitter = &seg->fitters[0];
    crease_model model;
    crease_rolling_cylinder(
        &blend->wedge, blend->radius, seg->points + 3 * (size_t)members[size / 2], &model);
    model.tangent_count = 2;
    memcpy(model.tangent, blend->planes, sizeof blend->planes);
    crease_segmentation_sample_points(seg, members, size, SAMPLE, &model, &fitter->sample);
    crease_fit_covariance(fitter, &fitter->sample, &model);
    crease_segmentation_replace(seg, (size_t)own, &model);
}

/* The parts become one fillet, or vanish into a sharp edge. */
static crease_status apply(crease_segmentation *seg, const crease_blend *blend)
{
    if (blend->radius > 0.0)
        round_edge(seg, blend);
    return relabel(seg, blend);
}

static int compare_gains(const void *a, const void *b)
{
    const crease_blend *x = a, *y = b;
    if (x->gain != y->gain)
        return x->gain > y->gain ? -1 : 1;
    const int32_t one[3] = {x->parts[0], x->planes[0], x->planes[1]};
    const int32_t other[3] = {y->parts[0], y->planes[0], y->planes[1]};
    for (int i = 0; i < 3; i++)
        if (one[i] != other[i])
            return one[i] < other[i] ? -1 : 1;
    return 0;
}

/* Takes the best ones, as long as they do not contradict better ones. */
static crease_status apply_best(inquiry *at, size_t *changed)
{
    enum { FREE, BESIDE, PART };
    uint8_t *const role = crease_allocate(at->seg->context, at->seg->region_count, sizeof *role);
    crease_status status = role ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < at->count && status == CREASE_OK; i++) {
        const crease_blend *const one = &at->items[i];
        bool possible =
            one->gain > 0.0 && role[one->planes[0]] != PART && role[one->planes[1]] != PART;
        for (int p = 0; p < one->count; p++)
            possible = possible && role[one->parts[p]] == FREE;
        if (!possible)
            continue;
        for (int p = 0; p < one->count; p++)
            role[one->parts[p]] = PART;
        role[one->planes[0]] = role[one->planes[1]] = BESIDE;
        status = apply(at->seg, one);
        *changed += 1;
    }
    free(role);
    return status;
}

/* ----------------------------------------------------------------------------------- passes -- */

static crease_status find_once(crease_segmentation *seg, size_t *changed)
{
    inquiry at = {.seg = seg, .fresh = true};
    crease_status status = crease_contacts_find(seg, LEAST_LINKS, &at.contacts);
    for (size_t r = 0; r < seg->region_count && status == CREASE_OK; r++)
        status = suppose(&at, (int32_t)r);
    if (status == CREASE_OK)
        status = judge_all(&at);
    if (status == CREASE_OK && at.count > 0) {
        qsort(at.items, at.count, sizeof *at.items, compare_gains);
        status = apply_best(&at, changed);
    }
    crease_contacts_clear(&at.contacts);
    free(at.items);
    if (status == CREASE_OK)
        crease_segmentation_compact(seg);
    return status;
}

static crease_status refit_plane(crease_segmentation *seg, int32_t region)
{
    crease_model model;
    const crease_status status = crease_blend_refit(seg, &seg->fitters[0], region, NULL, &model);
    if (status == CREASE_OK)
        crease_segmentation_replace(seg, (size_t)region, &model);
    return status;
}

/* Planes beside fillets, and then the fillets, fitted to the labels that they have now. */
static crease_status settle(crease_segmentation *seg)
{
    inquiry at = {.seg = seg};
    crease_status status = list_fillets(&at);
    for (size_t i = 0; i < at.count; i++)
        for (int side = 0; side < 2 && status == CREASE_OK; side++)
            status = refit_plane(seg, at.items[i].planes[side]);
    if (status == CREASE_OK)
        status = judge_all(&at);
    for (size_t i = 0; i < at.count && status == CREASE_OK; i++)
        status = apply(seg, &at.items[i]);
    free(at.items);
    if (status == CREASE_OK)
        crease_segmentation_compact(seg);
    return status;
}

crease_status crease_fillets_find(crease_segmentation *seg)
{
    crease_status status = crease_segmentation_list(seg);
    size_t changed = 1, all = 0;
    for (int pass = 0; pass < MOST_PASSES && changed > 0 && status == CREASE_OK; pass++) {
        changed = 0;
        status = find_once(seg, &changed);
        all += changed;
    }
    if (status != CREASE_OK || all == 0)
        return status;
    status = crease_give_up(seg, &changed);
    return status == CREASE_OK ? settle(seg) : status;
}
