/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "crease/junction.h"

#include "base/memory.h"
#include "base/vector.h"
#include "crease/intersect.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BALL_POINTS = 512, BALL_ENDS = 64, MOST_THIRDS = 16, LEAST_THIRD_POINTS = 2 };

/* Lengths in spacings. */
static const double THIRD_RADIUS = 5.0; /* around an end, to see which regions are there */
static const double THIRD_REACH = 5.0;  /* from an end to where it meets the third region */
static const double TOGETHER = 2.0;     /* between ends of one corner */
static const double MEETING_REACH = 3.0;
static const double CLOSE = 0.3;       /* and 1.5 sigma: models that meet */
static const double SHORT_CHAIN = 5.0; /* whose own two ends are never one corner */
static const double CUT_RANGE = 6.0;   /* of a chain's end, within which the corner is looked for */
static const double AHEAD = 0.1;       /* that a corner is before the last point of its chain */
static const double BESIDE = 0.6;      /* from a point that the corner need not be ahead of */

struct end {
    crease_chain *chain;
    int which;       /* 0: the first point of the chain, 1: the last */
    int64_t third;   /* region that ends it, or -1 */
    double place[3]; /* where it meets that region, or its last point */
    size_t root;     /* an end of the same corner, at last the lowest one */
    size_t corner;   /* of a root: the number of its corner, or SIZE_MAX */
};

struct ends {
    size_t count;
    struct end *items;
};

/* ----------------------------------------------------------------------------------- ends -- */

static const double *tip(const struct end *end)
{
    return end->chain->points + (end->which ? 3 * (end->chain->count - 1) : 0);
}

static bool meet(const crease_survey *survey, const uint32_t *regions, size_t count, double reach,
    double place[3])
{
    const crease_model *models[CREASE_MOST_CORNER_REGIONS];
    const double s = survey->spacing;
    for (size_t i = 0; i < count; i++)
        models[i] = &survey->regions->models[regions[i]];
    return crease_intersection_meet(
        models, count, reach * s, CLOSE * s + 1.5 * survey->sigma, place);
}

struct thirds {
    size_t count;
    int32_t regions[MOST_THIRDS];
    size_t points[MOST_THIRDS];
};

static void count_third(struct thirds *thirds, int32_t region)
{
    size_t i = 0;
    while (i < thirds->count && thirds->regions[i] != region)
        i++;
    if (i == MOST_THIRDS)
        return;
    if (i == thirds->count) {
        thirds->regions[thirds->count++] = region;
        thirds->points[i] = 0;
    }
    thirds->points[i]++;
}

/* Other regions that have points around a place. */
static struct thirds regions_around(
    const crease_survey *survey, const double place[3], const uint32_t own[2])
{
    uint32_t found[BALL_POINTS];
    size_t count = 0;
    struct thirds out = {.count = 0};
    crease_tree_within(
        survey->tree, place, THIRD_RADIUS * survey->spacing, BALL_POINTS, found, &count);
    for (size_t i = 0; i < count && i < BALL_POINTS; i++) {
        const int32_t label = survey->regions->labels[found[i]];
        if (label >= 0 && label != (int32_t)own[0] && label != (int32_t)own[1])
            count_third(&out, label);
    }
    return out;
}

/* Finds where an end meets a third region: the nearest such place. */
static void find_third(const crease_survey *survey, struct end *end)
{
    const crease_chain *const chain = end->chain;
    const double *const last = tip(end);
    const struct thirds thirds = regions_around(survey, last, chain->regions);
    double nearest = INFINITY;
    memcpy(end->place, last, sizeof end->place);
    for (size_t i = 0; i < thirds.count; i++) {
        const uint32_t regions[3] = {
            chain->regions[0], chain->regions[1], (uint32_t)thirds.regions[i]};
        double place[3] = {last[0], last[1], last[2]};
        if (thirds.points[i] < LEAST_THIRD_POINTS || !meet(survey, regions, 3, THIRD_REACH, place))
            continue;
        const double away = crease_vector_distance(place, last);
        if (away < nearest) {
            nearest = away;
            memcpy(end->place, place, sizeof place);
            end->third = thirds.regions[i];
        }
    }
}

static crease_status list_ends(
    crease_context *context, const crease_survey *survey, crease_chains *chains, struct ends *ends)
{
    ends->items = crease_allocate(context, 2 * chains->count, sizeof *ends->items);
    if (!ends->items)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < 2 * chains->count; i++) {
        crease_chain *const chain = &chains->items[i / 2];
        if (chain->closed)
            continue;
        struct end *const next = &ends->items[ends->count];
        *next = (struct end){.chain = chain,
            .which = (int)(i % 2),
            .third = -1,
            .root = ends->count,
            .corner = SIZE_MAX};
        find_third(survey, next);
        ends->count++;
    }
    return CREASE_OK;
}

/* -------------------------------------------------------------------------------- uniting -- */

static size_t root_of(const struct ends *ends, size_t i)
{
    while (ends->items[i].root != i)
        i = ends->items[i].root;
    return i;
}

static bool belong_together(const crease_survey *survey, const struct end *a, const struct end *b)
{
    const uint32_t *const x = a->chain->regions;
    const uint32_t *const y = b->chain->regions;
    if (a->chain == b->chain && crease_chain_length(a->chain) < SHORT_CHAIN * survey->spacing)
        return false;
    return x[0] == y[0] || x[0] == y[1] || x[1] == y[0] || x[1] == y[1];
}

static void unite_with_near(
    const crease_survey *survey, const crease_tree *tree, struct ends *ends, size_t i)
{
    uint32_t found[BALL_ENDS];
    size_t count = 0;
    crease_tree_within(
        tree, ends->items[i].place, TOGETHER * survey->spacing, BALL_ENDS, found, &count);
    for (size_t k = 0; k < count && k < BALL_ENDS; k++) {
        if (found[k] == i || !belong_together(survey, &ends->items[i], &ends->items[found[k]]))
            continue;
        const size_t a = root_of(ends, i), b = root_of(ends, found[k]);
        ends->items[a > b ? a : b].root = a < b ? a : b;
    }
}

static crease_status unite(crease_context *context, const crease_survey *survey, struct ends *ends)
{
    crease_tree *tree = NULL;
    double *const places = crease_allocate(context, ends->count, 3 * sizeof *places);
    crease_status status = CREASE_ERROR_NO_MEMORY;
    if (places) {
        for (size_t i = 0; i < ends->count; i++)
            memcpy(places + 3 * i, ends->items[i].place, sizeof ends->items[i].place);
        status = crease_tree_create(context, places, ends->count, &tree);
    }
    for (size_t i = 0; i < ends->count && status == CREASE_OK; i++)
        unite_with_near(survey, tree, ends, i);
    for (size_t i = 0; i < ends->count; i++)
        ends->items[i].root = root_of(ends, i);
    crease_tree_free(tree);
    free(places);
    return status;
}

/* -------------------------------------------------------------------------------- corners -- */

static void add_region(crease_junction *junction, uint32_t region)
{
    for (size_t i = 0; i < junction->region_count; i++)
        if (junction->regions[i] == region)
            return;
    if (junction->region_count < CREASE_MOST_CORNER_REGIONS)
        junction->regions[junction->region_count++] = region;
}

static void add_end(crease_junction *junction, const struct end *end)
{
    for (int c = 0; c < 3; c++)
        junction->place[c] += end->place[c];
    for (int i = 0; i < 2; i++)
        add_region(junction, end->chain->regions[i]);
    if (end->third >= 0)
        add_region(junction, (uint32_t)end->third);
    junction->valence++;
}

/* From the sum of its ends to the place where the models meet, or else to their mean. */
static void place_corner(const crease_survey *survey, crease_junction *junction)
{
    for (int c = 0; c < 3; c++)
        junction->place[c] /= junction->valence;
    double place[3] = {junction->place[0], junction->place[1], junction->place[2]};
    if (junction->region_count >= 3 &&
        meet(survey, junction->regions, junction->region_count, MEETING_REACH, place))
        memcpy(junction->place, place, sizeof place);
}

/* Last point of a chain, going back from its end, that has the corner ahead. */
static size_t last_before(const crease_chain *chain, const double corner[3], double s)
{
    const double *const p = chain->points;
    size_t last = chain->count - 1;
    double nearest = INFINITY, range = 0.0;
    for (size_t i = chain->count; i-- > 0 && range < CUT_RANGE * s;) {
        const double away = crease_vector_distance(p + 3 * i, corner);
        last = away < nearest ? i : last;
        nearest = fmin(nearest, away);
        range += i ? crease_vector_distance(p + 3 * i, p + 3 * i - 3) : 0.0;
    }
    for (; last > 0; last--) {
        double ahead[3], forward[3];
        for (size_t c = 0; c < 3; c++) {
            ahead[c] = corner[c] - p[3 * last + c];
            forward[c] = p[3 * last + c] - p[3 * last - 3 + c];
        }
        crease_vector_normalise(forward);
        if (crease_vector_dot(ahead, forward) > AHEAD * s)
            break;
        if (crease_vector_distance(p + 3 * last - 3, corner) > BESIDE * s)
            return last - 1;
    }
    return last;
}

static void end_at(const struct end *end, const crease_junction *junction, size_t corner, double s)
{
    crease_chain *const chain = end->chain;
    if (!end->which)
        crease_chain_reverse(chain);
    chain->count = last_before(chain, junction->place, s) + 1;
    chain->corners[1] = (int32_t)corner;
    if (!end->which)
        crease_chain_reverse(chain);
}

/* Empties short chains with both ends at one corner: what two regions that meet only in the corner
 * make of it. The two ends of a chain follow each other. */
static void swallow(const crease_survey *survey, struct ends *ends)
{
    for (size_t i = 1; i < ends->count; i++) {
        crease_chain *const chain = ends->items[i].chain;
        if (chain == ends->items[i - 1].chain && ends->items[i].root == ends->items[i - 1].root &&
            crease_chain_length(chain) < SHORT_CHAIN * survey->spacing)
            chain->count = 0;
    }
}

static void drop_empty(crease_chains *chains)
{
    size_t kept = 0;
    for (size_t i = 0; i < chains->count; i++) {
        if (chains->items[i].count > 0)
            chains->items[kept++] = chains->items[i];
        else
            crease_chain_clear(&chains->items[i]);
    }
    chains->count = kept;
}

/* An end that stays alone, and that no third region ends, makes no corner. */
static crease_status make_corners(
    crease_context *context, const crease_survey *survey, struct ends *ends, crease_junctions *out)
{
    crease_junction *const made = crease_allocate(context, ends->count, sizeof *made);
    if (!made)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < ends->count; i++)
        if (ends->items[i].chain->count > 0)
            add_end(&made[ends->items[i].root], &ends->items[i]);
    for (size_t i = 0; i < ends->count; i++) {
        if (made[i].valence == 0 || (made[i].valence == 1 && made[i].region_count < 3))
            continue;
        place_corner(survey, &made[i]);
        ends->items[i].corner = out->count;
        made[out->count++] = made[i];
    }
    out->items = made;
    for (size_t i = 0; i < ends->count; i++) {
        const size_t corner = ends->items[ends->items[i].root].corner;
        if (corner != SIZE_MAX && ends->items[i].chain->count > 0)
            end_at(&ends->items[i], &made[corner], corner, survey->spacing);
    }
    return CREASE_OK;
}

crease_status crease_junctions_find(crease_context *context, const crease_survey *survey,
    crease_chains *chains, crease_junctions *out)
{
    struct ends ends = {.count = 0};
    *out = (crease_junctions){.count = 0};
    crease_status status = list_ends(context, survey, chains, &ends);
    if (status == CREASE_OK)
        status = unite(context, survey, &ends);
    if (status == CREASE_OK) {
        swallow(survey, &ends);
        status = make_corners(context, survey, &ends, out);
        drop_empty(chains);
    }
    free(ends.items);
    return status;
}

void crease_junctions_clear(crease_junctions *junctions)
{
    free(junctions->items);
    *junctions = (crease_junctions){.count = 0};
}
