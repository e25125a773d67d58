/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A sheet found so far in another process: its frame and knots, the heights that feet are taken
 * from and that were solved last, and the surface. */
#include "base/memory.h"
#include "base/packing.h"
#include "fit/sum.h"

#include <stdlib.h>
#include <string.h>

/* What is of one size. */
typedef struct summary {
    crease_frame frame;
    crease_layout layout, below_layout;
    crease_sum_box all;
    double spacing, epsilon, scale;
    uint64_t height[2], below[2], surface[2]; /* control points; 0: there is none */
    uint64_t ready;                           /* for distances */
} summary;

static void put_all(crease_packing *out, const void *user)
{
    const crease_sheet_sum *const sum = user;
    const crease_draft *const draft = &sum->fitting.draft;
    const crease_height *const height = &draft->height, *const below = &sum->below;
    crease_surface_parts surface = {0};
    if (sum->surface)
        surface = crease_surface_parts_of(sum->surface);
    const summary head = {.frame = draft->frame,
        .layout = draft->layout,
        .below_layout = sum->below_layout,
        .all = sum->all,
        .spacing = sum->sample.spacing,
        .epsilon = sum->fitting.epsilon,
        .scale = sum->scale,
        .height = {height->count[0], height->count[1]},
        .below = {below->count[0], below->count[1]},
        .surface = {surface.count[0], surface.count[1]},
        .ready = sum->closest != NULL};
    crease_packing_put(out, &head, sizeof head);
    crease_packing_put(
        out, height->coefficients, height->count[0] * height->count[1] * sizeof(double));
    crease_packing_put(
        out, below->coefficients, below->count[0] * below->count[1] * sizeof(double));
    for (int d = 0; d < 2 && sum->surface; d++)
        crease_packing_put(
            out, surface.knots[d], (surface.count[d] + (size_t)surface.order[d]) * sizeof(double));
    crease_packing_put(
        out, surface.control_points, 3 * surface.count[0] * surface.count[1] * sizeof(double));
}

crease_status crease_sheet_sum_pack(
    crease_context *context, const crease_sheet_sum *sum, char **bytes, size_t *size)
{
    return crease_packing_make(context, put_all, sum, bytes, size);
}

/* The knots follow from the layout. */
static crease_status get_height(crease_context *context, const char **from,
    const crease_layout *layout, const uint64_t count[2], crease_height *out)
{
    if (count[0] == 0)
        return CREASE_OK;
    const crease_status status = crease_height_create(context, layout, out);
    if (status == CREASE_OK)
        memcpy(out->coefficients, *from, count[0] * count[1] * sizeof(double));
    *from += count[0] * count[1] * sizeof(double);
    return status;
}

static crease_status get_surface(
    crease_context *context, const char *from, const summary *head, crease_surface **out)
{
    const size_t order = (size_t)head->layout.order;
    if (head->surface[0] == 0)
        return CREASE_OK;
    const double *const knots = (const double *)(const void *)from;
    const crease_surface_parts parts = {.order = {head->layout.order, head->layout.order},
        .count = {head->surface[0], head->surface[1]},
        .knots = {knots, knots + head->surface[0] + order},
        .control_points = knots + head->surface[0] + head->surface[1] + 2 * order};
    return crease_surface_create(context, &parts, out);
}

crease_status crease_sheet_sum_unpack(
    crease_context *context, const char *bytes, crease_sheet_sum **out)
{
    summary head;
    memcpy(&head, bytes, sizeof head);
    bytes += sizeof head;
    *out = NULL;
    crease_sheet_sum *const sum = crease_allocate(context, 1, sizeof *sum);
    if (!sum)
        return CREASE_ERROR_NO_MEMORY;
    crease_draft *const draft = &sum->fitting.draft;
    draft->frame = head.frame;
    draft->layout = head.layout;
    sum->below_layout = head.below_layout;
    sum->all = head.all;
    sum->sample.spacing = head.spacing;
    sum->fitting.epsilon = head.epsilon;
    sum->scale = head.scale;
    crease_status status = get_height(context, &bytes, &head.layout, head.height, &draft->height);
    if (status == CREASE_OK)
        status = get_height(context, &bytes, &head.below_layout, head.below, &sum->below);
    if (status == CREASE_OK)
        status = get_surface(context, bytes, &head, &sum->surface);
    if (status == CREASE_OK && head.ready)
        status = crease_sheet_sum_make_ready(context, sum);
    if (status == CREASE_OK)
        *out = sum;
    else
        crease_sheet_sum_free(sum);
    return status;
}
