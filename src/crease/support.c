/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "crease/support.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "base/vector.h"
#include "crease/intersect.h"
#include "space/nearest.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    LINKED_NEIGHBOURS = 8,
    LEAST_LINKS = 4,
    LEAST_SEEDS = 3,
    LEAST_SUPPORT = 4, /* seeds that a chain must be the first to reach */
    LEAST_POINTS = 3,
    BALL_POINTS = 256,
    GRAIN = 256
};

/* Lengths in spacings. */
static const double STEP = 0.5;
static const double SEED_REACH = 2.5;    /* and two sigma */
static const double BLUR_REACH = 3.0;    /* more where the scanner has rounded the edges */
static const double SEED_DISTANCE = 0.6; /* a seed this near supports the chain */
static const double SEED_CLAIM = 1.0;    /* a chain uses up the seeds within */
static const double LONGEST_GAP = 4.0;
static const double LONGEST_REPEAT = 6.0;   /* along a chain that is there already */
static const double CLOSING_LENGTH = 3.0;   /* no ring is shorter */
static const double CLOSING_DISTANCE = 0.3; /* a ring comes back to within */
static const double SHORTEST_PART = 3.0;    /* of a chain that is sharp in parts */
static const double SIDE_RADIUS = 4.0;      /* around a place, to see on which sides points lie */

/* Two neighbouring points of different regions, the lower region first. */
struct link {
    uint32_t regions[2];
    uint32_t points[2];
};

/* The middle of a link, moved onto both models. */
struct seed {
    double place[3], tangent[3];
    double gap; /* spacing of the points around it */
    bool valid, used;
    bool passed; /* by a chain that was taken */
};

/* The seeds of one pair of regions. */
struct bed {
    const crease_model *models[2];
    uint32_t regions[2];
    struct seed *seeds;
    size_t count;
    double *places;
    crease_tree *tree; /* of the places */
    uint32_t *found;   /* count: what a query of the tree finds */
};

/* ---------------------------------------------------------------------------------- links -- */

/* True when the j-th neighbour of a point belongs to another region; sets the link. */
static bool link_of(const crease_regions *regions, size_t point, int j, struct link *out)
{
    const uint32_t other = crease_neighbours_of(regions->neighbours, point)[j];
    const int32_t mine = regions->labels[point], theirs = regions->labels[other];
    if (mine < 0 || theirs < 0 || mine == theirs)
        return false;
    const int swap = theirs < mine;
    out->regions[swap] = (uint32_t)mine;
    out->regions[1 - swap] = (uint32_t)theirs;
    out->points[swap] = (uint32_t)point;
    out->points[1 - swap] = other;
    return true;
}

static int compare_links(const void *left, const void *right)
{
    const struct link *const a = left;
    const struct link *const b = right;
    const uint32_t x[4] = {a->regions[0], a->regions[1], a->points[0], a->points[1]};
    const uint32_t y[4] = {b->regions[0], b->regions[1], b->points[0], b->points[1]};
    for (int i = 0; i < 4; i++)
        if (x[i] != y[i])
            return x[i] < y[i] ? -1 : 1;
    return 0;
}

/* All links, those of a pair of regions together. */
static crease_status find_links(
    crease_context *context, const crease_regions *regions, struct link **out, size_t *count)
{
    const int k = crease_neighbours_k(regions->neighbours);
    const int last = k - 1 < LINKED_NEIGHBOURS ? k - 1 : LINKED_NEIGHBOURS;
    struct link *links = NULL;
    for (int pass = 0; pass < 2; pass++) {
        size_t found = 0;
        for (size_t i = 0; i < regions->count; i++)
            for (int j = 1; j <= last; j++) {
                struct link next;
                if (!link_of(regions, i, j, &next))
                    continue;
                if (links)
                    links[found] = next;
                found++;
            }
        *count = found;
        if (!links && !(links = crease_allocate(context, found, sizeof *links)))
            return CREASE_ERROR_NO_MEMORY;
    }
    qsort(links, *count, sizeof *links, compare_links);
    *out = links;
    return CREASE_OK;
}

/* ---------------------------------------------------------------------------------- seeds -- */

struct sowing {
    const crease_survey *survey;
    const struct link *links;
    struct seed *seeds;
};

static void sow(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const struct sowing *const run = user;
    const crease_regions *const regions = run->survey->regions;
    const double blur = regions->rounded ? BLUR_REACH : 0.0;
    const double reach = (SEED_REACH + blur) * run->survey->spacing + 2.0 * run->survey->sigma;
    for (size_t i = begin; i < end; i++) {
        const struct link *const from = &run->links[i];
        struct seed *const to = &run->seeds[i];
        const crease_model *const models[2] = {
            &regions->models[from->regions[0]], &regions->models[from->regions[1]]};
        const double *const a = regions->points + 3 * (size_t)from->points[0];
        const double *const b = regions->points + 3 * (size_t)from->points[1];
        for (int c = 0; c < 3; c++)
            to->place[c] = 0.5 * (a[c] + b[c]);
        to->gap = (double)regions->noise->local_spacing[from->points[0]];
        to->valid = crease_intersection_project(models, reach, to->place, to->tangent);
    }
}

/* ------------------------------------------------------------------------------- marching -- */

double crease_support_bend(const crease_survey *survey, const uint32_t regions[2],
    const double place[3], const double tangent[3])
{
    const crease_regions *const all = survey->regions;
    uint32_t found[BALL_POINTS];
    size_t count = 0;
    double inward[2][3], lean[2] = {0.0, 0.0};
    for (int side = 0; side < 2; side++) {
        double gradient[3];
        crease_model_distance(&all->models[regions[side]], place, gradient);
        crease_vector_cross(gradient, tangent, inward[side]);
    }
    crease_tree_within(
        survey->tree, place, SIDE_RADIUS * survey->spacing, BALL_POINTS, found, &count);
    for (size_t i = 0; i < count && i < BALL_POINTS; i++)
        for (int side = 0; side < 2; side++) {
            if (all->labels[found[i]] != (int32_t)regions[side])
                continue;
            const double *const p = all->points + 3 * (size_t)found[i];
            const double d[3] = {p[0] - place[0], p[1] - place[1], p[2] - place[2]};
            lean[side] += crease_vector_dot(d, inward[side]);
        }
    const double cosine = crease_vector_dot(inward[0], inward[1]) * (lean[0] < 0.0 ? -1.0 : 1.0) *
        (lean[1] < 0.0 ? -1.0 : 1.0);
    return acos(-1.0) - acos(fmax(-1.0, fmin(1.0, cosine)));
}

static const struct seed *nearest_seed(
    const struct bed *bed, const double place[3], double *distance)
{
    uint32_t position = 0;
    double squared = 0.0;
    crease_tree_nearest_place(bed->tree, place, CREASE_NO_POSITION, 1, &position, &squared);
    *distance = sqrt(squared);
    return &bed->seeds[bed->tree->index[position]];
}

/* A walk along an intersection. Points of the chain up to the last one that ... */
struct walk {
    double unsupported, repeated; /* lengths */
    double gap;                   /* of the last seed beside */
    size_t supported;             /* ... a seed is beside */
    size_t fresh;                 /* ... and that no other chain has passed */
};

/* Whether to go on after a step to the chain's last point: chains that cross pass each other, one
 * that comes upon another along the same line ends there. */
static bool goes_on(const crease_survey *survey, const struct bed *bed, const crease_chain *chain,
    double length, struct walk *walk)
{
    const double s = survey->spacing;
    double away = 0.0;
    const struct seed *const near =
        nearest_seed(bed, chain->points + 3 * (chain->count - 1), &away);
    const bool beside = away < SEED_DISTANCE * s;
    walk->unsupported = beside ? 0.0 : walk->unsupported + length;
    walk->supported = beside ? chain->count : walk->supported;
    walk->gap = beside ? near->gap : walk->gap;
    if (beside && !near->passed) {
        walk->repeated = 0.0;
        walk->fresh = chain->count;
    } else {
        walk->repeated += beside ? length : 0.0;
    }
    if (walk->repeated > LONGEST_REPEAT * s)
        walk->supported = walk->fresh;
    return walk->repeated <= LONGEST_REPEAT * s &&
        walk->unsupported <= LONGEST_GAP * fmax(s, fmax(walk->gap, near->gap));
}

/* Walks forwards (1) or backwards (-1) while seeds support it, and adds the points. Closes the
 * chain when it comes back to the seed. */
static crease_status go(crease_context *context, const crease_survey *survey, const struct bed *bed,
    const struct seed *start, double way, crease_chain *chain)
{
    const double s = survey->spacing;
    double place[3], tangent[3], total = 0.0;
    struct walk walk = {.gap = start->gap, .supported = chain->count, .fresh = chain->count};
    memcpy(place, start->place, sizeof place);
    for (int c = 0; c < 3; c++)
        tangent[c] = way * start->tangent[c];
    for (size_t left = 100 * (bed->count + 1); left > 0; left--) {
        const double before[3] = {place[0], place[1], place[2]};
        if (!crease_intersection_step(bed->models, STEP * s, place, tangent))
            break;
        const double length = crease_vector_distance(before, place);
        total += length;
        if (total > CLOSING_LENGTH * s &&
            crease_vector_distance(place, start->place) < CLOSING_DISTANCE * s) {
            chain->closed = true;
            return CREASE_OK;
        }
        const double bend = crease_support_bend(survey, bed->regions, place, tangent);
        const crease_status status = crease_chain_append(context, chain, place, bend);
        if (status != CREASE_OK)
            return status;
        if (!goes_on(survey, bed, chain, length, &walk))
            break;
    }
    chain->count = walk.supported;
    return CREASE_OK;
}

/* Marks the seeds along a chain as used, and as passed when the chain is taken; returns how many
 * were not used before. */
static size_t claim(const struct bed *bed, const crease_chain *chain, double radius, bool taken)
{
    size_t fresh = 0;
    for (size_t i = 0; i < chain->count; i++) {
        size_t found = 0;
        crease_tree_within(
            bed->tree, chain->points + 3 * i, radius, bed->count, bed->found, &found);
        for (size_t k = 0; k < found; k++) {
            fresh += !bed->seeds[bed->found[k]].used;
            bed->seeds[bed->found[k]].used = true;
            bed->seeds[bed->found[k]].passed |= taken;
        }
    }
    return fresh;
}

/* ------------------------------------------------------------------------- sharp stretches -- */

/* The points begin .. end - 1, counted on around a closed chain, as a chain of their own. */
static crease_status take_part(crease_context *context, const crease_chain *chain, size_t begin,
    size_t end, double shortest, crease_chains *chains)
{
    crease_chain part = crease_chain_between(chain->regions[0], chain->regions[1]);
    crease_status status = CREASE_OK;
    for (size_t i = begin; i < end && status == CREASE_OK; i++) {
        const size_t k = i % chain->count;
        status = crease_chain_append(context, &part, chain->points + 3 * k, chain->bends[k]);
    }
    if (status == CREASE_OK && crease_chain_length(&part) > shortest)
        status = crease_chains_take(context, chains, &part);
    crease_chain_clear(&part);
    return status;
}

/* Takes the stretches of a chain that bend enough; a closed one is opened where it does not. */
static crease_status take_sharp(crease_context *context, const crease_survey *survey,
    crease_chain *chain, crease_chains *chains)
{
    const double least = survey->least_bend;
    size_t blunt = chain->count;
    for (size_t i = 0; i < chain->count; i++)
        blunt = chain->bends[i] < least ? i : blunt;
    if (blunt == chain->count)
        return crease_chains_take(context, chains, chain);
    const size_t first = chain->closed ? blunt : 0;
    crease_status status = CREASE_OK;
    for (size_t i = first; i < first + chain->count && status == CREASE_OK;) {
        size_t end = i;
        while (end < first + chain->count && chain->bends[end % chain->count] >= least)
            end++;
        if (end > i)
            status = take_part(context, chain, i, end, SHORTEST_PART * survey->spacing, chains);
        i = end + 1;
    }
    return status;
}

/* ---------------------------------------------------------------------------------- pairs -- */

static crease_status trace_from(crease_context *context, const crease_survey *survey,
    const struct bed *bed, struct seed *start, crease_chains *chains)
{
    crease_chain chain = crease_chain_between(bed->regions[0], bed->regions[1]);
    const double bend = crease_support_bend(survey, bed->regions, start->place, start->tangent);
    crease_status status = crease_chain_append(context, &chain, start->place, bend);
    if (status == CREASE_OK)
        status = go(context, survey, bed, start, 1.0, &chain);
    if (status == CREASE_OK && !chain.closed) {
        crease_chain_reverse(&chain);
        status = go(context, survey, bed, start, -1.0, &chain);
    }
    if (status == CREASE_OK) {
        start->used = true;
        const double radius = SEED_CLAIM * survey->spacing;
        const size_t support = 1 + claim(bed, &chain, radius, false);
        if (support >= LEAST_SUPPORT && chain.count >= LEAST_POINTS) {
            claim(bed, &chain, radius, true);
            status = take_sharp(context, survey, &chain, chains);
        }
    }
    crease_chain_clear(&chain);
    return status;
}

static crease_status trace_pair(
    crease_context *context, const crease_survey *survey, struct bed *bed, crease_chains *chains)
{
    crease_status status = crease_tree_create(context, bed->places, bed->count, &bed->tree);
    for (size_t i = 0; i < bed->count && status == CREASE_OK; i++)
        if (!bed->seeds[i].used)
            status = trace_from(context, survey, bed, &bed->seeds[i], chains);
    crease_tree_free(bed->tree);
    return status;
}

/* Moves the valid seeds to the front and their places into an array; returns their number. */
static size_t keep_valid(struct seed *seeds, size_t count, double *places)
{
    size_t kept = 0;
    for (size_t i = 0; i < count; i++)
        if (seeds[i].valid) {
            memcpy(places + 3 * kept, seeds[i].place, sizeof seeds[i].place);
            seeds[kept++] = seeds[i];
        }
    return kept;
}

/* places and found have room for as many as there are links. */
static crease_status trace_pairs(crease_context *context, const struct sowing *run, size_t count,
    double *places, uint32_t *found, crease_chains *chains)
{
    const crease_model *const models = run->survey->regions->models;
    crease_status status = CREASE_OK;
    for (size_t begin = 0, end = 0; begin < count && status == CREASE_OK; begin = end) {
        const struct link *const first = &run->links[begin];
        while (end < count &&
            memcmp(first->regions, run->links[end].regions, sizeof first->regions) == 0)
            end++;
        struct bed bed = {.models = {&models[first->regions[0]], &models[first->regions[1]]},
            .regions = {first->regions[0], first->regions[1]},
            .seeds = run->seeds + begin,
            .places = places,
            .found = found};
        bed.count = keep_valid(bed.seeds, end - begin, places);
        if (end - begin >= LEAST_LINKS && bed.count >= LEAST_SEEDS)
            status = trace_pair(context, run->survey, &bed, chains);
    }
    return status;
}

crease_status crease_support_trace(
    crease_context *context, const crease_survey *survey, crease_chains *chains)
{
    struct link *links = NULL;
    size_t count = 0;
    crease_status status = find_links(context, survey->regions, &links, &count);
    if (status != CREASE_OK)
        return status;
    struct seed *const seeds = crease_allocate(context, count, sizeof *seeds);
    double *const places = crease_allocate(context, count, 3 * sizeof *places);
    uint32_t *const found = crease_allocate(context, count, sizeof *found);
    struct sowing run = {survey, links, seeds};
    status = CREASE_ERROR_NO_MEMORY;
    if (seeds && places && found)
        status = crease_parallel_for(context, count, GRAIN, sow, &run);
    if (status == CREASE_OK)
        status = trace_pairs(context, &run, count, places, found, chains);
    free(links);
    free(seeds);
    free(places);
    free(found);
    return status;
}
