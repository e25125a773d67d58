/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Labels: every point takes the region, among its own and its neighbours', that is cheapest by its
 * distance from the region's model and by the links to neighbours of other regions: iterated
 * conditional modes.
 *
 * Half of the points, drawn anew each time, decide at once from the labels as they are, then the
 * other half: the result does not depend on threads, and two neighbours that would swap for ever do
 * not both move in every round.
 *
 * Based on: Besag. On the statistical analysis of dirty pictures. 1986. */
#include "segment/segmentation.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { GRAIN = 4096, STILL = 5000 };

typedef struct relabelling {
    crease_segmentation *seg;
    int32_t *next;
    uint64_t round;
    unsigned half;
    size_t *changed; /* by chunk */
} relabelling;

/* One of two halves, by a hash of point and round.
 * Based on: Steele, Lea, Flood. Fast splittable pseudorandom number generators. 2014. */
static unsigned half_of(size_t point, uint64_t round)
{
    uint64_t z = (uint64_t)point + round * 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (unsigned)(z >> 63);
}

/* Labels around a point and how many neighbours have them. */
typedef struct ballot {
    int count;
    int32_t labels[CREASE_LINKS];
    int links[CREASE_LINKS];
    bool mixed; /* the point's own label is missing or not the only one */
} ballot;

static ballot count_votes(const crease_segmentation *seg, size_t point)
{
    const uint32_t *const near = crease_segmentation_near(seg, point);
    const int32_t own = seg->labels[point];
    ballot votes = {.mixed = own < 0};
    for (int j = 1; j <= seg->links; j++) {
        const int32_t label = seg->labels[near[j]];
        if (label < 0)
            continue;
        int at = 0;
        while (at < votes.count && votes.labels[at] != label)
            at++;
        if (at == votes.count) {
            votes.labels[votes.count] = label;
            votes.links[votes.count++] = 0;
        }
        votes.links[at]++;
        votes.mixed |= label != own;
    }
    return votes;
}

/* The own label stays unless another one is truly cheaper. */
static int32_t cheapest(const crease_segmentation *seg, size_t point, const ballot *votes)
{
    const int32_t own = seg->labels[point];
    int32_t best = own;
    double least = own < 0 ? INFINITY : crease_segmentation_price(seg, &seg->models[own], point);
    for (int i = 0; i < votes->count; i++)
        if (votes->labels[i] == own)
            least -= CREASE_LINK_PRICE * votes->links[i];
    for (int i = 0; i < votes->count; i++) {
        if (votes->labels[i] == own)
            continue;
        const double price = crease_segmentation_price(seg, &seg->models[votes->labels[i]], point) -
            CREASE_LINK_PRICE * votes->links[i];
        if (price < least - 1e-9) {
            least = price;
            best = votes->labels[i];
        }
    }
    return best;
}

static void decide(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const relabelling *run = user;
    size_t changed = 0;
    for (size_t i = begin; i < end; i++) {
        const int32_t own = run->seg->labels[i];
        run->next[i] = own;
        if (half_of(i, run->round) != run->half)
            continue;
        const ballot votes = count_votes(run->seg, i);
        if (!votes.mixed || votes.count == 0)
            continue;
        run->next[i] = cheapest(run->seg, i, &votes);
        changed += run->next[i] != own;
    }
    run->changed[begin / GRAIN] = changed;
}

static crease_status relabel_half(relabelling *run, size_t *changed)
{
    crease_segmentation *const seg = run->seg;
    const crease_status status = crease_segmentation_parallel(seg, seg->count, GRAIN, decide, run);
    if (status != CREASE_OK)
        return status;
    memcpy(seg->labels, run->next, seg->count * sizeof *seg->labels);
    for (size_t chunk = 0; chunk * GRAIN < seg->count; chunk++)
        *changed += run->changed[chunk];
    return CREASE_OK;
}

crease_status crease_relabel(crease_segmentation *seg, int rounds, size_t *changed)
{
    relabelling run = {.seg = seg};
    *changed = 0;
    run.next = crease_allocate(seg->context, seg->count, sizeof *run.next);
    run.changed = crease_allocate(seg->context, seg->count / GRAIN + 1, sizeof *run.changed);
    crease_status status = run.next && run.changed ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    for (; run.round < (uint64_t)rounds && status == CREASE_OK; run.round++) {
        size_t now = 0;
        for (run.half = 0; run.half < 2 && status == CREASE_OK; run.half++)
            status = relabel_half(&run, &now);
        *changed += now;
        if (now <= seg->count / STILL)
            break;
    }
    free(run.next);
    free(run.changed);
    return status == CREASE_OK ? crease_segmentation_list(seg) : status;
}
