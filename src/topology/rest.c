/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/rest.h"

#include "base/memory.h"
#include "base/vector.h"

#include <math.h>
#include <stdlib.h>

/* In spacings. */
static const double WINDOW = 4.0; /* beside the border that is looked at */
static const double SLACK = 1.0;  /* that the border may be off */
static const double FAR = 1.5;    /* where points of one region may end from there */
static const double REACH = 1.2;  /* and those of two regions from each other */

static const double FULL = 0.25; /* of the points that a region has beside its border, at least */
static const double BARE = 0.1;  /* as many as on the other side, at most */
static const double ASIDE = 0.7; /* cosine between borders in different directions */
static const size_t LEAST = 5;   /* points beside a border */
static const size_t TRIM = 40;   /* one of so many points may be off */

struct crease_rests {
    const crease_graph *graph;
    size_t *first;     /* of each region in ... */
    uint32_t *members; /* ... the points, by region */
};

crease_status crease_rests_create(const crease_graph *graph, crease_rests **out)
{
    const crease_regions *const r = graph->survey->regions;
    crease_rests *const rests = *out = crease_allocate(graph->context, 1, sizeof *rests);
    if (!rests)
        return CREASE_ERROR_NO_MEMORY;
    rests->graph = graph;
    rests->first = crease_allocate(graph->context, r->region_count + 2, sizeof *rests->first);
    rests->members = crease_allocate(graph->context, r->count, sizeof *rests->members);
    if (!rests->first || !rests->members)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < r->count; i++)
        if (r->labels[i] >= 0)
            rests->first[r->labels[i] + 2]++;
    for (size_t i = 2; i < r->region_count + 2; i++)
        rests->first[i] += rests->first[i - 1];
    for (size_t i = 0; i < r->count; i++)
        if (r->labels[i] >= 0)
            rests->members[rests->first[r->labels[i] + 1]++] = (uint32_t)i;
    return CREASE_OK;
}

void crease_rests_free(crease_rests *rests)
{
    if (!rests)
        return;
    free(rests->first);
    free(rests->members);
    free(rests);
}

/* Keeps the least of numbers, ascending. */
static void keep(double *least, size_t *kept, size_t most, double value)
{
    size_t i = *kept < most ? (*kept)++ : most;
    if (i == most) {
        if (value >= least[most - 1])
            return;
        i = most - 1;
    }
    for (; i > 0 && least[i - 1] > value; i--)
        least[i] = least[i - 1];
    least[i] = value;
}

/* What the points of a region say of a border. */
struct answer {
    enum { NOTHING, ENDS, GOES_ON } verdict;
    double end;    /* where they end */
    size_t points; /* beside it */
};

static struct answer ask(
    const crease_rests *rests, const crease_rest_side *side, const double normal[3], double at)
{
    enum { MOST_KEPT = 16 };
    const crease_regions *const r = rests->graph->survey->regions;
    const double s = rests->graph->survey->spacing;
    const double expected = FULL * (side->high - side->low) * (WINDOW - SLACK) / s;
    double first[2][MOST_KEPT];
    size_t kept[2] = {0, 0}, beside[2] = {0, 0};
    for (size_t m = rests->first[side->region]; m < rests->first[side->region + 1]; m++) {
        const double *const p = r->points + 3 * (size_t)rests->members[m];
        const double along = crease_vector_dot(p, side->along);
        const double away = crease_vector_dot(p, normal) - at;
        if (along < side->low || along > side->high || fabs(away) > WINDOW * s)
            continue;
        for (int k = 0; k < 2; k++) {
            const double ahead = k ? -away : away;
            beside[k] += ahead > SLACK * s;
            if (ahead > -FAR * s)
                keep(first[k], &kept[k], MOST_KEPT, ahead);
        }
    }
    const int which = beside[1] > beside[0];
    const size_t most = beside[which], least = beside[1 - which];
    if ((double)least > expected && least >= LEAST)
        return (struct answer){.verdict = GOES_ON};
    if ((double)most < expected || most < LEAST || (double)least > BARE * (double)most)
        return (struct answer){.verdict = NOTHING};
    const size_t trimmed = most / TRIM < kept[which] ? most / TRIM : kept[which] - 1;
    const double end = first[which][trimmed];
    if (fabs(end) > FAR * s)
        return (struct answer){.verdict = NOTHING};
    return (struct answer){ENDS, which ? at - end : at + end, most};
}

/* The stretches that end within reach of a place, if there are some in different directions. */
static double length_at(
    const crease_rest_side *sides, int count, const struct answer *answers, double place, double s)
{
    double sum = 0.0;
    bool aside = false;
    for (int i = 0; i < count; i++) {
        if (answers[i].verdict != ENDS || fabs(answers[i].end - place) > REACH * s)
            continue;
        sum += sides[i].high - sides[i].low;
        for (int k = 0; k < i; k++)
            aside = aside ||
                (answers[k].verdict == ENDS && fabs(answers[k].end - place) <= REACH * s &&
                    fabs(crease_vector_dot(sides[i].along, sides[k].along)) < ASIDE);
    }
    return aside ? sum : 0.0;
}

double crease_rests_end(const crease_rests *rests, const crease_rest_side *sides, int count,
    const double normal[3], double *at)
{
    const crease_regions *const r = rests->graph->survey->regions;
    struct answer answers[CREASE_MOST_RESTS];
    size_t most = 0;
    double place = *at;
    for (int i = 0; i < count; i++) {
        answers[i] = (struct answer){.verdict = NOTHING};
        if (r->models[sides[i].region].type == CREASE_REGION_PLANE)
            answers[i] = ask(rests, &sides[i], normal, *at);
        if (answers[i].verdict == GOES_ON)
            return 0.0;
        if (answers[i].verdict == ENDS && answers[i].points > most) {
            most = answers[i].points;
            place = answers[i].end;
        }
    }
    *at = place;
    return length_at(sides, count, answers, place, rests->graph->survey->spacing);
}
