/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/links.h"

#include "base/memory.h"
#include "base/vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NEIGHBOURS = 8, MOST_AROUND = 256 };

/* In spacings. */
static const double LONGEST = 4.0;
static const double BESIDE_EDGE = 2.5; /* and 2 sigma: what an edge accounts for */

/* --------------------------------------------------------------------------------- links -- */

static bool is_link(const crease_survey *survey, size_t i, size_t k)
{
    const crease_regions *const r = survey->regions;
    return r->labels[i] >= 0 && r->labels[k] >= 0 && r->labels[i] != r->labels[k] &&
        crease_vector_distance(r->points + 3 * i, r->points + 3 * k) <= LONGEST * survey->spacing;
}

static crease_link link_of(const crease_regions *r, size_t i, size_t k)
{
    const uint32_t a = (uint32_t)r->labels[i], b = (uint32_t)r->labels[k];
    crease_link link = {.regions = {a < b ? a : b, a < b ? b : a}};
    for (size_t c = 0; c < 3; c++)
        link.place[c] = 0.5 * (r->points[3 * i + c] + r->points[3 * k + c]);
    return link;
}

/* All links, in the order of the points; only their number when there is no room. */
static size_t gather(const crease_survey *survey, crease_link *out)
{
    const crease_regions *const r = survey->regions;
    const size_t k = (size_t)r->neighbours->k;
    size_t count = 0;
    for (size_t i = 0; i < r->count; i++)
        for (size_t n = 1; n < k && n < NEIGHBOURS; n++) {
            const size_t other = r->neighbours->indices[i * k + n];
            if (!is_link(survey, i, other))
                continue;
            if (out)
                out[count] = link_of(r, i, other);
            count++;
        }
    return count;
}

static int compare(const void *first, const void *second)
{
    const crease_link *const a = first, *const b = second;
    for (int i = 0; i < 2; i++)
        if (a->regions[i] != b->regions[i])
            return a->regions[i] < b->regions[i] ? -1 : 1;
    for (int c = 0; c < 3; c++)
        if (a->place[c] != b->place[c])
            return a->place[c] < b->place[c] ? -1 : 1;
    return 0;
}

crease_status crease_links_find(
    crease_context *context, const crease_survey *survey, crease_links *out)
{
    *out = (crease_links){.count = gather(survey, NULL)};
    out->items = crease_allocate(context, out->count, sizeof *out->items);
    if (!out->items)
        return CREASE_ERROR_NO_MEMORY;
    gather(survey, out->items);
    qsort(out->items, out->count, sizeof *out->items, compare);
    return CREASE_OK;
}

void crease_links_clear(crease_links *links)
{
    free(links->items);
    *links = (crease_links){.count = 0};
}

size_t crease_links_run(const crease_links *links, size_t begin)
{
    size_t end = begin;
    while (end < links->count &&
        memcmp(links->items[end].regions, links->items[begin].regions,
            sizeof links->items[end].regions) == 0)
        end++;
    return end;
}

bool crease_links_between(const crease_links *links, const uint32_t regions[2], size_t run[2])
{
    run[0] = run[1] = 0;
    while (run[0] < links->count) {
        run[1] = crease_links_run(links, run[0]);
        if (memcmp(links->items[run[0]].regions, regions, 2 * sizeof *regions) == 0)
            return true;
        run[0] = run[1];
    }
    return false;
}

/* --------------------------------------------------------------------------------- loose -- */

/* A tree of the points of all edges between two regions; NULL when there are none. */
static crease_status tree_of_edges(
    const crease_graph *graph, const uint32_t regions[2], crease_tree **out)
{
    const crease_topology *const t = graph->topology;
    size_t count = 0;
    *out = NULL;
    for (size_t i = 0; i < t->edge_count; i++)
        if (memcmp(t->edges[i].regions, regions, 2 * sizeof *regions) == 0)
            count += t->edges[i].count;
    if (count == 0)
        return CREASE_OK;
    double *const points = crease_allocate(graph->context, count, 3 * sizeof *points);
    if (!points)
        return CREASE_ERROR_NO_MEMORY;
    double *to = points;
    for (size_t i = 0; i < t->edge_count; i++)
        if (memcmp(t->edges[i].regions, regions, 2 * sizeof *regions) == 0) {
            memcpy(to, t->edges[i].points, 3 * t->edges[i].count * sizeof *to);
            to += 3 * t->edges[i].count;
        }
    const crease_status status = crease_tree_create(graph->context, points, count, out);
    free(points);
    return status;
}

crease_status crease_loose_find(const crease_graph *graph, const crease_links *links, size_t begin,
    size_t end, crease_loose *out)
{
    const crease_survey *const survey = graph->survey;
    const double beside = BESIDE_EDGE * survey->spacing + 2.0 * survey->sigma;
    crease_tree *edges = NULL;
    *out = (crease_loose){.count = 0};
    memcpy(out->regions, links->items[begin].regions, sizeof out->regions);
    crease_status status = tree_of_edges(graph, out->regions, &edges);
    out->places = crease_allocate(graph->context, end - begin, 3 * sizeof *out->places);
    if (status == CREASE_OK && !out->places)
        status = CREASE_ERROR_NO_MEMORY;
    for (size_t i = begin; i < end && status == CREASE_OK; i++) {
        size_t near = 0;
        uint32_t found;
        if (edges)
            crease_tree_within(edges, links->items[i].place, beside, 1, &found, &near);
        if (near == 0)
            memcpy(out->places + 3 * out->count++, links->items[i].place,
                sizeof links->items[i].place);
    }
    if (status == CREASE_OK && out->count > 0)
        status = crease_tree_create(graph->context, out->places, out->count, &out->tree);
    crease_tree_free(edges);
    if (status != CREASE_OK)
        crease_loose_clear(out);
    return status;
}

void crease_loose_clear(crease_loose *loose)
{
    crease_tree_free(loose->tree);
    free(loose->places);
    *loose = (crease_loose){.count = 0};
}

size_t crease_loose_direction(const crease_loose *loose, const double place[3], double distance,
    double mean[3], double direction[3])
{
    uint32_t found[MOST_AROUND];
    double around[3 * MOST_AROUND], values[3], axes[9];
    size_t count = 0;
    if (loose->tree)
        crease_tree_within(loose->tree, place, distance, MOST_AROUND, found, &count);
    count = count < MOST_AROUND ? count : MOST_AROUND;
    if (count == 0)
        return 0;
    for (size_t i = 0; i < count; i++)
        memcpy(around + 3 * i, loose->places + 3 * found[i], 3 * sizeof *around);
    crease_vector_main_axes(around, NULL, count, mean, values, axes);
    memcpy(direction, axes + 6, 3 * sizeof *direction);
    return count;
}

bool crease_loose_nearest(
    const crease_loose *loose, const double place[3], double within, double *away, double out[3])
{
    uint32_t found[MOST_AROUND];
    size_t count = 0;
    crease_tree_within(loose->tree, place, within, MOST_AROUND, found, &count);
    *away = within;
    for (size_t i = 0; i < count && i < MOST_AROUND; i++) {
        const double *const at = loose->places + 3 * (size_t)found[i];
        const double distance = crease_vector_distance(at, place);
        if (distance <= *away) {
            *away = distance;
            memcpy(out, at, 3 * sizeof *out);
        }
    }
    return count > 0;
}
