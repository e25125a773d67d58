/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/confluence.h"

#include "base/memory.h"
#include "base/vector.h"
#include "topology/crossing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    LEAST_BRANCH = 3, /* links of a pair that lead away from a confluence */
    LEAST_PAIRS = 3,
    MOST_AROUND = 256
};

/* In spacings. */
static const double TOGETHER = 3.0;   /* links of the pairs of three regions */
static const double APART = 3.0;      /* confluences from each other, and from other vertices */
static const double SAME_APART = 8.0; /* of the same regions */
static const double BESIDE[] = {4.5, 3.0, 6.0}; /* links of a further pair, in turn */
static const double BEGIN = 1.5;                /* of a branch, and its ... */
static const double END = 8.0;

static const double SMOOTH = 0.8; /* cosine between surfaces at a confluence */

/* All loose links, pair by pair. */
struct pairs {
    crease_graph *graph;
    size_t count;
    crease_loose *items;
};

/* Where links of three pairs come together. */
struct candidate {
    double place[3], apart;
    uint32_t regions[3];
};

struct candidates {
    size_t count, room;
    struct candidate *items;
};

/* ---------------------------------------------------------------------------------- pairs -- */

static void clear_pairs(struct pairs *pairs)
{
    for (size_t i = 0; i < pairs->count; i++)
        crease_loose_clear(&pairs->items[i]);
    free(pairs->items);
}

static crease_status find_pairs(const crease_links *links, struct pairs *pairs)
{
    size_t room = 0;
    for (size_t begin = 0; begin < links->count; begin = crease_links_run(links, begin))
        room++;
    pairs->items = crease_allocate(pairs->graph->context, room + 1, sizeof *pairs->items);
    crease_status status = pairs->items ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    for (size_t begin = 0; begin < links->count && status == CREASE_OK;) {
        const size_t end = crease_links_run(links, begin);
        crease_loose loose = {.count = 0};
        status = crease_loose_find(pairs->graph, links, begin, end, &loose);
        if (status == CREASE_OK && loose.count > 0)
            pairs->items[pairs->count++] = loose;
        else
            crease_loose_clear(&loose);
        begin = end;
    }
    return status;
}

static const crease_loose *pair_of(const struct pairs *pairs, uint32_t a, uint32_t b)
{
    const uint32_t regions[2] = {a < b ? a : b, a < b ? b : a};
    for (size_t i = 0; i < pairs->count; i++)
        if (memcmp(pairs->items[i].regions, regions, sizeof regions) == 0)
            return &pairs->items[i];
    return NULL;
}

/* ----------------------------------------------------------------------------- candidates -- */

static crease_status add_candidate(
    crease_context *context, struct candidates *all, const struct candidate *candidate)
{
    if (all->count == all->room) {
        const size_t room = 2 * all->room + 64;
        struct candidate *const items = crease_reallocate(context, all->items, room, sizeof *items);
        if (!items)
            return CREASE_ERROR_NO_MEMORY;
        all->items = items;
        all->room = room;
    }
    all->items[all->count++] = *candidate;
    return CREASE_OK;
}

/* The places where links of the first pair and of all others come together. */
static crease_status find_places(const struct pairs *pairs, const crease_loose *const around[],
    size_t count, const uint32_t regions[3], struct candidates *all)
{
    const double reach = TOGETHER * pairs->graph->survey->spacing;
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < around[0]->count && status == CREASE_OK; i++) {
        const double *const at = around[0]->places + 3 * i;
        struct candidate here = {.regions = {regions[0], regions[1], regions[2]}};
        bool together = true;
        memcpy(here.place, at, sizeof here.place);
        for (size_t k = 1; k < count && together; k++) {
            double other[3], away;
            together = crease_loose_nearest(around[k], at, reach, &away, other);
            here.apart = fmax(here.apart, away);
            for (int c = 0; c < 3 && together; c++)
                here.place[c] += other[c];
        }
        for (int c = 0; c < 3; c++)
            here.place[c] /= (double)count;
        if (together)
            status = add_candidate(pairs->graph->context, all, &here);
    }
    return status;
}

/* Four regions around a point, of which those on opposite sides have no links. */
static crease_status find_fours(const struct pairs *pairs, const crease_loose *ab,
    const crease_loose *ac, struct candidates *all)
{
    const uint32_t a = ab->regions[0], b = ab->regions[1], c = ac->regions[1];
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < pairs->count && status == CREASE_OK; i++) {
        const uint32_t *const r = pairs->items[i].regions;
        const uint32_t d = r[0] == b ? r[1] : r[0];
        if ((r[0] != b && r[1] != b) || d <= a || d == c)
            continue;
        const crease_loose *const around[4] = {ab, ac, &pairs->items[i], pair_of(pairs, c, d)};
        if (around[3])
            status = find_places(pairs, around, 4, (uint32_t[]){a, b, c}, all);
    }
    return status;
}

static int nearer(const void *first, const void *second)
{
    const struct candidate *const a = first, *const b = second;
    if (a->apart != b->apart)
        return a->apart < b->apart ? -1 : 1;
    return memcmp(a->regions, b->regions, sizeof a->regions);
}

static crease_status find_candidates(const struct pairs *pairs, struct candidates *all)
{
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < pairs->count; i++)
        for (size_t k = i + 1; k < pairs->count && status == CREASE_OK; k++) {
            const crease_loose *const ab = &pairs->items[i], *const ac = &pairs->items[k];
            if (ab->regions[0] != ac->regions[0])
                break; /* they are sorted */
            const crease_loose *const around[3] = {
                ab, ac, pair_of(pairs, ab->regions[1], ac->regions[1])};
            if (around[2])
                status = find_places(pairs, around, 3,
                    (uint32_t[]){ab->regions[0], ab->regions[1], ac->regions[1]}, all);
            if (status == CREASE_OK)
                status = find_fours(pairs, ab, ac, all);
        }
    if (all->count > 0)
        qsort(all->items, all->count, sizeof *all->items, nearer);
    return status;
}

/* ------------------------------------------------------------------------------- branches -- */

/* Whether two of the regions have edges at a vertex beside the place. */
static bool is_known(const crease_graph *graph, const struct candidate *candidate)
{
    const crease_topology *const t = graph->topology;
    for (size_t v = 0; v < t->vertex_count; v++) {
        int ends = 0;
        if (crease_vector_distance(t->vertices[v].place, candidate->place) >= APART * t->spacing)
            continue;
        for (int i = 0; i < 3; i++)
            ends += crease_graph_ends(graph, (int32_t)v, candidate->regions[i]) > 0;
        if (ends >= 2)
            return true;
    }
    return false;
}

static size_t times(const crease_confluence *confluence, uint32_t region)
{
    size_t count = 0;
    for (size_t i = 0; i < confluence->pair_count; i++)
        count += confluence->pairs[i][0] == region || confluence->pairs[i][1] == region;
    return count;
}

/* Whether there is a confluence beside the place already, of the same regions farther away: where
 * these hardly part, their points are mixed. */
static bool is_taken(const crease_graph *graph, const crease_confluences *confluences,
    const struct candidate *candidate)
{
    const crease_topology *const t = graph->topology;
    for (size_t i = 0; i < confluences->count; i++) {
        const crease_confluence *const confluence = &confluences->items[i];
        const double away =
            crease_vector_distance(t->vertices[confluence->vertex].place, candidate->place);
        bool same = true;
        for (int k = 0; k < 3; k++)
            same = same && times(confluence, candidate->regions[k]) > 0;
        if (away < (same ? SAME_APART : APART) * t->spacing)
            return true;
    }
    return false;
}

/* Whether the links of a pair lead away from a place, and no angle is between the surfaces. */
static bool is_branch(
    const struct pairs *pairs, const crease_loose *loose, const double place[3], double reach)
{
    const double s = pairs->graph->survey->spacing;
    uint32_t found[MOST_AROUND];
    double first[3], second[3];
    size_t count = 0, away = 0;
    crease_tree_within(loose->tree, place, reach * s, 1, found, &count);
    if (count == 0)
        return false;
    crease_graph_distance(pairs->graph, loose->regions[0], place, first);
    crease_graph_distance(pairs->graph, loose->regions[1], place, second);
    if (fabs(crease_vector_dot(first, second)) < SMOOTH)
        return false;
    crease_tree_within(loose->tree, place, END * s, MOST_AROUND, found, &count);
    for (size_t i = 0; i < count && i < MOST_AROUND; i++)
        away += crease_vector_distance(loose->places + 3 * (size_t)found[i], place) > BEGIN * s;
    return away >= LEAST_BRANCH;
}

/* How far from the place the links of a pair go. */
static double reach_of(const struct pairs *pairs, const uint32_t regions[2], const double place[3])
{
    const double s = pairs->graph->survey->spacing;
    const crease_loose *const loose = pair_of(pairs, regions[0], regions[1]);
    uint32_t found[MOST_AROUND];
    size_t count = 0;
    double most = 0.0;
    crease_tree_within(loose->tree, place, END * s, MOST_AROUND, found, &count);
    for (size_t i = 0; i < count && i < MOST_AROUND; i++)
        most = fmax(most, crease_vector_distance(loose->places + 3 * (size_t)found[i], place));
    return most;
}

/* Leaves out the pairs with the shortest reach of which both regions have more than two. */
static void drop_diagonals(
    const struct pairs *pairs, const double place[3], crease_confluence *confluence)
{
    for (;;) {
        size_t shortest = SIZE_MAX;
        double least = INFINITY;
        for (size_t i = 0; i < confluence->pair_count; i++) {
            const uint32_t *const pair = confluence->pairs[i];
            const double reach = reach_of(pairs, pair, place);
            if (times(confluence, pair[0]) > 2 && times(confluence, pair[1]) > 2 && reach < least) {
                least = reach;
                shortest = i;
            }
        }
        if (shortest == SIZE_MAX)
            return;
        confluence->pair_count--;
        memmove(confluence->pairs[shortest], confluence->pairs[shortest + 1],
            (confluence->pair_count - shortest) * sizeof *confluence->pairs);
    }
}

/* Leaves out the pairs of regions that only one pair has: they end near by. */
static void drop_loose_ends(crease_confluence *confluence)
{
    for (size_t i = 0; i < confluence->pair_count;) {
        if (times(confluence, confluence->pairs[i][0]) > 1 &&
            times(confluence, confluence->pairs[i][1]) > 1) {
            i++;
            continue;
        }
        confluence->pair_count--;
        memmove(confluence->pairs[i], confluence->pairs[i + 1],
            (confluence->pair_count - i) * sizeof *confluence->pairs);
        i = 0;
    }
}

static bool is_cycle(const crease_confluence *confluence)
{
    bool all = confluence->pair_count >= LEAST_PAIRS;
    for (size_t i = 0; i < confluence->pair_count && all; i++)
        all = times(confluence, confluence->pairs[i][0]) == 2 &&
            times(confluence, confluence->pairs[i][1]) == 2;
    return all;
}

/* The pairs whose smooth edges come to a place, each of whose regions must be in two. */
static bool find_branches(
    const struct pairs *pairs, const double place[3], double reach, crease_confluence *confluence)
{
    confluence->pair_count = 0;
    for (size_t i = 0; i < pairs->count; i++) {
        if (!is_branch(pairs, &pairs->items[i], place, reach))
            continue;
        if (confluence->pair_count == CREASE_CONFLUENCE_PAIRS)
            return false;
        memcpy(confluence->pairs[confluence->pair_count++], pairs->items[i].regions,
            sizeof confluence->pairs[0]);
    }
    drop_diagonals(pairs, place, confluence);
    drop_loose_ends(confluence);
    return is_cycle(confluence);
}

/* ------------------------------------------------------------------------------- confluences -- */

static crease_status add_confluence(crease_graph *graph, crease_confluences *all,
    crease_confluence *confluence, const double place[3])
{
    if (all->count == all->room) {
        const size_t room = 2 * all->room + 16;
        crease_confluence *const items =
            crease_reallocate(graph->context, all->items, room, sizeof *items);
        if (!items)
            return CREASE_ERROR_NO_MEMORY;
        all->items = items;
        all->room = room;
    }
    const crease_status status = crease_graph_vertex(graph, place, &confluence->vertex);
    if (status == CREASE_OK)
        all->items[all->count++] = *confluence;
    return status;
}

static void settle(const struct pairs *pairs, const crease_confluence *confluence, double place[3])
{
    const crease_loose *lines[CREASE_CONFLUENCE_PAIRS];
    for (size_t i = 0; i < confluence->pair_count; i++)
        lines[i] = pair_of(pairs, confluence->pairs[i][0], confluence->pairs[i][1]);
    crease_crossing_find(pairs->graph, lines, confluence->pair_count, place);
}

static crease_status take_candidate(
    const struct pairs *pairs, const struct candidate *candidate, crease_confluences *out)
{
    crease_confluence confluence;
    double place[3];
    bool found = false;
    memcpy(place, candidate->place, sizeof place);
    if (is_taken(pairs->graph, out, candidate) || is_known(pairs->graph, candidate))
        return CREASE_OK;
    for (size_t i = 0; i < sizeof BESIDE / sizeof *BESIDE && !found; i++)
        found = find_branches(pairs, place, BESIDE[i], &confluence);
    if (!found)
        return CREASE_OK;
    settle(pairs, &confluence, place);
    return add_confluence(pairs->graph, out, &confluence, place);
}

crease_status crease_confluences_find(
    crease_graph *graph, const crease_links *links, crease_confluences *out)
{
    struct pairs pairs = {.graph = graph};
    struct candidates candidates = {.count = 0};
    *out = (crease_confluences){.count = 0};
    crease_status status = find_pairs(links, &pairs);
    if (status == CREASE_OK)
        status = find_candidates(&pairs, &candidates);
    for (size_t i = 0; i < candidates.count && status == CREASE_OK; i++)
        status = take_candidate(&pairs, &candidates.items[i], out);
    free(candidates.items);
    clear_pairs(&pairs);
    return status;
}

const crease_confluence *crease_confluence_at(const crease_confluences *confluences, int32_t vertex)
{
    for (size_t i = 0; confluences && i < confluences->count; i++)
        if (confluences->items[i].vertex == vertex)
            return &confluences->items[i];
    return NULL;
}

bool crease_confluence_awaits(
    const crease_graph *graph, const crease_confluence *confluence, const uint32_t regions[2])
{
    const crease_topology *const t = graph->topology;
    bool has = false;
    for (size_t i = 0; i < confluence->pair_count && !has; i++)
        has = memcmp(confluence->pairs[i], regions, sizeof confluence->pairs[i]) == 0;
    for (size_t e = 0; e < t->edge_count && has; e++)
        has = memcmp(t->edges[e].regions, regions, sizeof t->edges[e].regions) != 0 ||
            (t->edges[e].vertices[0] != confluence->vertex &&
                t->edges[e].vertices[1] != confluence->vertex);
    return has;
}

void crease_confluences_clear(crease_confluences *confluences)
{
    free(confluences->items);
    *confluences = (crease_confluences){.count = 0};
}
