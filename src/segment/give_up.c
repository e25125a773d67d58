/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Regions that are not worth having: the description of the cloud is shorter when their neighbours'
 * models explain their points. */
#include "segment/segmentation.h"

#include "base/memory.h"
#include "base/vector.h"

#include <math.h>
#include <stdlib.h>

enum { MOST_ADJACENT = 64, LONELY = 12, MOST_PASSES = 8 };

static const double ABREAST = 0.8; /* points per spacing along a region */

typedef struct surroundings {
    int count;
    int32_t labels[MOST_ADJACENT];
    size_t cut; /* links to other regions */
} surroundings;

static void look_around(const crease_segmentation *seg, size_t region, surroundings *out)
{
    out->count = 0;
    out->cut = 0;
    for (size_t m = seg->first[region]; m < seg->first[region + 1]; m++) {
        const uint32_t *const near = crease_segmentation_near(seg, seg->members[m]);
        for (int j = 1; j <= seg->border_links; j++) {
            const int32_t label = seg->labels[near[j]];
            if (label < 0 || label == (int32_t)region)
                continue;
            out->cut++;
            int at = 0;
            while (at < out->count && out->labels[at] != label)
                at++;
            if (at == out->count && at < MOST_ADJACENT)
                out->labels[out->count++] = label;
        }
    }
}

/* The cheapest of the surrounding labels for a point, and twice its price. */
static int32_t second_choice(
    const crease_segmentation *seg, size_t point, const surroundings *around, double *price)
{
    int32_t best = around->labels[0];
    *price = INFINITY;
    for (int i = 0; i < around->count; i++) {
        const double own =
            2.0 * crease_segmentation_price(seg, &seg->models[around->labels[i]], point);
        if (own < *price) {
            *price = own;
            best = around->labels[i];
        }
    }
    return best;
}

/* Whether the members lie along a line, clearly less than one abreast: no face is seen so narrow.
 */
static bool is_thread(const crease_segmentation *seg, size_t region)
{
    const size_t begin = seg->first[region], end = seg->first[region + 1];
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t m = begin; m < end; m++)
        for (size_t c = 0; c < 3; c++) {
            low[c] = fmin(low[c], seg->points[3 * (size_t)seg->members[m] + c]);
            high[c] = fmax(high[c], seg->points[3 * (size_t)seg->members[m] + c]);
        }
    return ABREAST * crease_vector_distance(low, high) > (double)(end - begin) * seg->spacing;
}

/* Whether the description of the points is shorter without the region: its parameters and its
 * border are saved. */
static bool is_dispensable(
    const crease_segmentation *seg, size_t region, const surroundings *around)
{
    const size_t begin = seg->first[region], end = seg->first[region + 1];
    const crease_model *const model = &seg->models[region];
    if (end - begin < seg->least_points || is_thread(seg, region))
        return true;
    double keep = model->parameter_count * log(fmax((double)(end - begin), 2.0)) +
        CREASE_LINK_PRICE * (double)around->cut;
    for (size_t m = begin; m < end; m++)
        keep += 2.0 * crease_segmentation_price(seg, model, seg->members[m]);
    double without = 0.0, price;
    for (size_t m = begin; m < end && without < keep; m++) {
        second_choice(seg, seg->members[m], around, &price);
        without += price;
    }
    return without < keep;
}

/* Hands the members of a dispensable region over; touched regions wait for the next pass. */
static bool give_up(crease_segmentation *seg, size_t region, uint8_t *touched)
{
    surroundings around;
    const size_t begin = seg->first[region], end = seg->first[region + 1];
    look_around(seg, region, &around);
    const size_t lonely = seg->least_points > LONELY ? seg->least_points : LONELY;
    if (around.count == 0 ? end - begin >= lonely : !is_dispensable(seg, region, &around))
        return false;
    for (size_t m = begin; m < end; m++) {
        double price;
        const size_t point = seg->members[m];
        const int32_t label =
            around.count ? second_choice(seg, point, &around, &price) : CREASE_NO_LABEL;
        seg->labels[point] = label;
        if (label >= 0)
            touched[label] = 1;
    }
    return true;
}

typedef struct sized {
    size_t size, region;
} sized;

static int compare_sizes(const void *a, const void *b)
{
    const sized *x = a, *y = b;
    if (x->size != y->size)
        return x->size < y->size ? -1 : 1;
    return x->region < y->region ? -1 : x->region > y->region;
}

/* One pass from small to large. */
static crease_status give_up_pass(
    crease_segmentation *seg, sized *order, uint8_t *touched, size_t *dropped)
{
    *dropped = 0;
    for (size_t r = 0; r < seg->region_count; r++) {
        order[r] = (sized){crease_segmentation_size(seg, r), r};
        touched[r] = 0;
    }
    qsort(order, seg->region_count, sizeof *order, compare_sizes);
    for (size_t i = 0; i < seg->region_count; i++)
        if (order[i].size > 0 && !touched[order[i].region])
            *dropped += give_up(seg, order[i].region, touched);
    const crease_status status = crease_segmentation_list(seg);
    if (status == CREASE_OK)
        crease_segmentation_compact(seg);
    return status;
}

crease_status crease_give_up(crease_segmentation *seg, size_t *dropped)
{
    sized *const order = crease_allocate(seg->context, seg->region_count, sizeof *order);
    uint8_t *const touched = crease_allocate(seg->context, seg->region_count, sizeof *touched);
    crease_status status = order && touched ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    size_t now = 1;
    *dropped = 0;
    for (int pass = 0; pass < MOST_PASSES && now > 0 && status == CREASE_OK; pass++) {
        status = give_up_pass(seg, order, touched, &now);
        *dropped += now;
    }
    free(order);
    free(touched);
    return status;
}
