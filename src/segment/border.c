/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "segment/border.h"

#include "base/memory.h"
#include "base/vector.h"

#include <math.h>
#include <stdlib.h>

static const double SHARP = 0.985; /* cosine of 10 degrees: less is an angle */

crease_status crease_borders_make(const crease_segmentation *seg, crease_borders *out)
{
    *out = (crease_borders){.seg = seg, .count = seg->region_count};
    out->items = crease_allocate(seg->context, out->count * out->count, sizeof *out->items);
    return out->items ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
}

void crease_borders_clear(crease_borders *borders)
{
    free(borders->items);
    borders->items = NULL;
}

crease_border *crease_borders_between(const crease_borders *borders, size_t a, size_t b)
{
    return &borders->items[(a < b ? a : b) * borders->count + (a < b ? b : a)];
}

static void add_link(
    const crease_segmentation *seg, size_t point, int32_t a, int32_t b, crease_border_contact *out)
{
    double first[3], second[3];
    crease_model_distance(&seg->models[a], seg->points + 3 * point, first);
    crease_model_distance(&seg->models[b], seg->points + 3 * point, second);
    const double cosine = crease_vector_dot(first, second);
    out->links++;
    out->sharp += fabs(cosine) < SHARP;
    out->agreement += cosine;
    out->parallel += fabs(cosine);
}

/* Whether no surface of another region beside the first point runs between the two. */
static bool is_open(const crease_segmentation *seg, size_t i, size_t k)
{
    const uint32_t *const near = crease_segmentation_near(seg, i);
    int32_t last = CREASE_NO_LABEL;
    double gradient[3];
    for (size_t n = 1; n < seg->stride; n++) {
        const int32_t other = seg->labels[near[n]];
        if (other < 0 || other == last || other == seg->labels[i] || other == seg->labels[k])
            continue;
        last = other;
        if (crease_model_distance(&seg->models[other], seg->points + 3 * i, gradient) *
                crease_model_distance(&seg->models[other], seg->points + 3 * k, gradient) <
            0.0)
            return false;
    }
    return true;
}

static void add_links(const crease_borders *borders, size_t point, int32_t region)
{
    const crease_segmentation *const seg = borders->seg;
    const uint32_t *const near = crease_segmentation_near(seg, point);
    const int32_t a = seg->labels[point];
    for (size_t k = 1; k < seg->stride; k++) {
        const int32_t b = seg->labels[near[k]];
        if (b < 0 || a == b || (region >= 0 && a != region && b != region))
            continue;
        crease_border *const border = crease_borders_between(borders, (size_t)a, (size_t)b);
        if (k <= (size_t)seg->border_links)
            add_link(seg, point, a, b, &border->beside);
        else if (border->beside.links < CREASE_BORDER_LEAST_LINKS && is_open(seg, point, near[k]))
            add_link(seg, point, a, b, &border->across);
    }
}

void crease_borders_count(const crease_borders *borders, int32_t region)
{
    for (size_t r = 0; r < borders->count && region >= 0; r++)
        *crease_borders_between(borders, (size_t)region, r) = (crease_border){.tried = false};
    for (size_t i = 0; i < borders->seg->count; i++)
        if (borders->seg->labels[i] >= 0)
            add_links(borders, i, region);
}

const crease_border_contact *crease_border_told_by(const crease_border *border)
{
    return border->beside.links < CREASE_BORDER_LEAST_LINKS ? &border->across : &border->beside;
}
