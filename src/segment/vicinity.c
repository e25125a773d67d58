/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "segment/vicinity.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_ADJACENT = 32, ROUNDS = 6 };

static const uint32_t EMPTY = UINT32_MAX;

/* The slot of a point, or the empty one where it would be. */
static size_t slot_of(const crease_vicinity *v, uint32_t point)
{
    size_t slot = (point * 2654435761u) & (v->slots - 1);
    while (v->keys[slot] != EMPTY && v->keys[slot] != point)
        slot = (slot + 1) & (v->slots - 1);
    return slot;
}

/* Adds a point unless it is there, or there is no room. Returns whether it was added. */
static bool add(crease_vicinity *v, uint32_t point)
{
    const size_t slot = slot_of(v, point);
    if (v->keys[slot] == point || v->count >= v->slots / 2)
        return false;
    v->keys[slot] = point;
    v->places[slot] = (int32_t)v->count;
    v->points[v->count++] = point;
    return true;
}

typedef struct adjacent {
    int count;
    int32_t labels[MOST_ADJACENT];
} adjacent;

static void note_label(adjacent *around, int32_t label)
{
    for (int i = 0; i < around->count; i++)
        if (around->labels[i] == label)
            return;
    if (around->count < MOST_ADJACENT)
        around->labels[around->count++] = label;
}

static void add_rings(crease_vicinity *v, int rings, adjacent *around)
{
    const crease_segmentation *const seg = v->seg;
    size_t begin = 0;
    for (int ring = 0; ring < rings; ring++) {
        const size_t end = v->count;
        for (size_t i = begin; i < end; i++) {
            const uint32_t *const near = crease_segmentation_near(seg, v->points[i]);
            for (int j = 1; j <= seg->border_links; j++)
                if (add(v, near[j]) && seg->labels[near[j]] >= 0)
                    note_label(around, seg->labels[near[j]]);
        }
        begin = end;
    }
}

static void describe(crease_vicinity *v, const adjacent *around)
{
    const crease_segmentation *const seg = v->seg;
    for (size_t i = 0; i < v->count; i++) {
        const uint32_t point = v->points[i];
        const uint32_t *const near = crease_segmentation_near(seg, point);
        v->labels[i] = seg->labels[point];
        for (int j = 0; j < seg->links; j++) {
            const size_t slot = slot_of(v, near[j + 1]);
            v->near[i * (size_t)seg->links + (size_t)j] =
                v->keys[slot] == near[j + 1] ? v->places[slot] : -2 - seg->labels[near[j + 1]];
        }
        v->elsewhere[i] = 2.0 * CREASE_RESIDUAL_CUT;
        for (int a = 0; a < around->count; a++)
            v->elsewhere[i] = fmin(v->elsewhere[i],
                2.0 * crease_segmentation_price(seg, &seg->models[around->labels[a]], point));
    }
}

static bool allocate_table(crease_vicinity *v, size_t size)
{
    crease_context *const context = v->seg->context;
    v->slots = 64;
    while (v->slots < 8 * size + 4096)
        v->slots *= 2;
    v->keys = crease_allocate(context, v->slots, sizeof *v->keys);
    v->places = crease_allocate(context, v->slots, sizeof *v->places);
    v->points = crease_allocate(context, v->slots / 2, sizeof *v->points);
    if (v->keys)
        memset(v->keys, 0xff, v->slots * sizeof *v->keys);
    return v->keys && v->places && v->points;
}

static bool allocate_points(crease_vicinity *v)
{
    crease_context *const context = v->seg->context;
    v->near = crease_allocate(context, v->count, (size_t)v->seg->links * sizeof *v->near);
    v->labels = crease_allocate(context, v->count, sizeof *v->labels);
    v->trial = crease_allocate(context, v->count, sizeof *v->trial);
    v->elsewhere = crease_allocate(context, v->count, sizeof *v->elsewhere);
    v->chosen = crease_allocate(context, v->count, sizeof *v->chosen);
    return v->near && v->labels && v->trial && v->elsewhere && v->chosen;
}

crease_status crease_vicinity_create(
    crease_segmentation *seg, size_t region, int rings, crease_vicinity *out)
{
    *out = (crease_vicinity){.seg = seg, .region = (int32_t)region};
    adjacent around = {0};
    const size_t begin = seg->first[region], end = seg->first[region + 1];
    if (allocate_table(out, end - begin)) {
        for (size_t m = begin; m < end; m++)
            add(out, seg->members[m]);
        add_rings(out, rings, &around);
        if (allocate_points(out)) {
            describe(out, &around);
            return CREASE_OK;
        }
    }
    crease_vicinity_clear(out);
    return CREASE_ERROR_NO_MEMORY;
}

void crease_vicinity_clear(crease_vicinity *v)
{
    free(v->keys);
    free(v->places);
    free(v->points);
    free(v->near);
    free(v->labels);
    free(v->trial);
    free(v->elsewhere);
    free(v->chosen);
}

/* ------------------------------------------------------------------------------------ energy -- */

typedef struct contest {
    const crease_model *first, *second;
} contest;

static double price_of(const crease_vicinity *v, const contest *rivals, int32_t label, size_t i)
{
    const crease_segmentation *const seg = v->seg;
    const crease_model *const model = label == v->region ? rivals->first
        : label == (int32_t)seg->region_count            ? rivals->second
                                                         : &seg->models[label];
    return crease_segmentation_price(seg, model, v->points[i]);
}

/* How many neighbours of point i have the label. */
static int links_to(const int32_t labels[CREASE_LINKS], int count, int32_t label)
{
    int links = 0;
    for (int j = 0; j < count; j++)
        links += labels[j] == label;
    return links;
}

/* The cheapest label among the point's own and its neighbours'. */
static int32_t cheapest(const crease_vicinity *v, const contest *rivals, size_t i)
{
    const int links = v->seg->links;
    const int32_t own = v->trial[i], *const near = v->near + i * (size_t)links;
    int32_t labels[CREASE_LINKS];
    bool mixed = false;
    for (int j = 0; j < links; j++) {
        labels[j] = near[j] >= 0 ? v->trial[near[j]] : -2 - near[j];
        mixed |= labels[j] >= 0 && labels[j] != own;
    }
    if (!mixed)
        return own;
    int32_t best = own;
    double least = own < 0
        ? INFINITY
        : price_of(v, rivals, own, i) - CREASE_LINK_PRICE * links_to(labels, links, own);
    for (int j = 0; j < links; j++) {
        if (labels[j] < 0 || labels[j] == own || links_to(labels, j, labels[j]) > 0)
            continue;
        const double price = price_of(v, rivals, labels[j], i) -
            CREASE_LINK_PRICE * links_to(labels, links, labels[j]);
        if (price < least - 1e-9) {
            least = price;
            best = labels[j];
        }
    }
    return best;
}

double crease_vicinity_energy(
    crease_vicinity *v, const crease_model *first, const crease_model *second)
{
    const contest rivals = {first, second};
    for (int round = 0; round < ROUNDS; round++) {
        bool changed = false;
        for (size_t i = 0; i < v->count; i++) {
            const int32_t label = cheapest(v, &rivals, i);
            changed |= label != v->trial[i];
            v->trial[i] = label;
        }
        if (!changed)
            break;
    }
    double energy = 0.0;
    for (size_t i = 0; i < v->count; i++)
        energy +=
            2.0 * (v->trial[i] < 0 ? CREASE_RESIDUAL_CUT : price_of(v, &rivals, v->trial[i], i));
    return energy;
}
