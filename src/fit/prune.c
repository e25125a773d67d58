/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "fit/prune.h"

#include "fit/lines.h"
#include "fit/sharpness.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ROUNDS = 3 };

static const double PAIR = 2.0;  /* spacings: lines that are nearer are a step */
static const double REACH = 4.0; /* spacings from a line, where a bend shows that has no line */
static const double CAP = 4.0;   /* standard deviations that a point's distance counts, at most */
/* Standard errors by which points may be further from a sheet without a line, to either side. */
static const double ALIKE = 1.0;

/* Half as many spans along each direction, as long as that does about as well. */
static crease_status thin_out(
    crease_context *context, crease_draft *draft, const crease_bounds *bounds)
{
    crease_status status = CREASE_OK;
    for (int d = 0; d < 2; d++) {
        bool taken = bounds->net[d] == 0 && !(bounds->tolerance > 0.0);
        while (
            taken && draft->layout.axis[d].smooth > 2 * bounds->least[d] && status == CREASE_OK) {
            crease_layout layout = draft->layout;
            layout.axis[d].smooth = (layout.axis[d].smooth - 1) / 2;
            status = crease_explore_try(context, draft, &layout, -CREASE_EXPLORE_MARGIN, &taken);
        }
    }
    return status;
}

/* ----------------------------------------------------------------------------------- rivals -- */

/* A line, or two that are a step. */
typedef struct group {
    int direction;
    size_t first, count;
    double worth; /* by how much the score is higher without it */
} group;

static size_t find_groups(const crease_draft *draft, group *groups)
{
    size_t count = 0;
    for (int d = 0; d < 2; d++) {
        const crease_layout_axis *const axis = &draft->layout.axis[d];
        for (size_t l = 0; l < axis->line_count; l++)
            if (l > 0 && axis->lines[l] - axis->lines[l - 1] < PAIR * draft->samples->spacing)
                groups[count - 1].count++;
            else
                groups[count++] = (group){.direction = d, .first = l, .count = 1};
    }
    return count;
}

static void take_out(crease_layout *layout, const group *one)
{
    for (size_t l = one->first + one->count; l-- > one->first;)
        crease_layout_remove(layout, one->direction, l);
}

/* What each group is worth, the worthiest first. */
static crease_status weigh_groups(crease_context *context, const crease_draft *draft,
    const crease_bounds *bounds, group *groups, size_t count)
{
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < count && status == CREASE_OK; i++) {
        crease_layout layout = draft->layout;
        take_out(&layout, &groups[i]);
        crease_explore_keep_net(&layout, bounds);
        crease_draft without = crease_draft_variant(draft, &layout, &draft->frame);
        status = crease_draft_fit(context, &without, ROUNDS, CREASE_CHOICE_NEAR);
        group one = groups[i];
        one.worth = status == CREASE_OK ? without.score - draft->score : INFINITY;
        crease_draft_free(&without);
        status = status == CREASE_ERROR_NUMERIC ? CREASE_OK : status;
        size_t place = i;
        for (; place > 0 && groups[place - 1].worth < one.worth; place--)
            groups[place] = groups[place - 1];
        groups[place] = one;
    }
    return status;
}

static int by_place(const void *a, const void *b)
{
    const group *const x = a, *const y = b;
    return x->direction != y->direction ? x->direction - y->direction
                                        : (x->first > y->first) - (x->first < y->first);
}

/* The draft's layout without these groups, which get sorted. */
static crease_layout layout_without(
    const crease_draft *draft, const crease_bounds *bounds, group *groups, size_t count)
{
    crease_layout layout = draft->layout;
    qsort(groups, count, sizeof *groups, by_place);
    for (size_t i = count; i-- > 0;)
        take_out(&layout, &groups[i]);
    crease_explore_keep_net(&layout, bounds);
    return layout;
}

/* Grows a draft as long as it pays and it may yet do better than the other one, if any: not when it
 * has more freedom and leaves more. */
static crease_status grow_against(crease_context *context, crease_draft *draft,
    const crease_bounds *bounds, const crease_draft *other)
{
    crease_status status = CREASE_OK;
    bool grown = true;
    while (grown && status == CREASE_OK &&
        !(other && draft->freedom > other->freedom && draft->mean > other->mean))
        status = crease_explore_grow(context, draft, bounds, &grown);
    return status;
}

/* Takes the rival, or frees it. */
static void decide(crease_draft *draft, crease_draft *rival, bool wanted, bool *taken)
{
    *taken = wanted && (crease_draft_bounded(rival) || !crease_draft_bounded(draft));
    crease_draft_free(*taken ? draft : rival);
    if (*taken)
        *draft = *rival;
}

/* One line in the middle of a step, moved to where it fits best. */
static crease_status merge_step(crease_context *context, crease_draft *draft,
    const crease_bounds *bounds, const group *step, bool turn)
{
    crease_layout layout = draft->layout;
    double *const lines = layout.axis[step->direction].lines + step->first;
    lines[0] = 0.5 * (lines[0] + lines[1]);
    crease_layout_remove(&layout, step->direction, step->first + 1);
    crease_explore_keep_net(&layout, bounds);
    crease_draft merged = crease_draft_variant(draft, &layout, &draft->frame);
    crease_status status = crease_draft_fit(context, &merged, ROUNDS, CREASE_CHOICE_NEAR);
    if (status == CREASE_OK)
        status = crease_lines_refine(context, &merged, 12, turn);
    bool taken;
    decide(draft, &merged,
        status == CREASE_OK && merged.score < draft->score + CREASE_EXPLORE_MARGIN, &taken);
    return status == CREASE_ERROR_NUMERIC ? CREASE_OK : status;
}

/* Bends that were taken for steps. */
static crease_status merge_steps(
    crease_context *context, crease_draft *draft, const crease_bounds *bounds, bool turn)
{
    group groups[2 * CREASE_MOST_LINES];
    crease_status status = CREASE_OK;
    for (size_t i = find_groups(draft, groups); i-- > 0 && status == CREASE_OK;)
        if (groups[i].count == 2)
            status = merge_step(context, draft, bounds, &groups[i], turn);
    return status;
}

/* The draft without these groups, which get sorted, and with as many simple knots as pay; against:
 * as above. */
static crease_status grow_rival(crease_context *context, const crease_draft *draft,
    const crease_bounds *bounds, group *without, size_t count, const crease_draft *against,
    crease_draft *rival)
{
    const crease_layout layout = layout_without(draft, bounds, without, count);
    *rival = crease_draft_variant(draft, &layout, &draft->frame);
    crease_status status = crease_draft_fit(context, rival, ROUNDS, CREASE_CHOICE_ALL);
    if (status == CREASE_OK)
        status = grow_against(context, rival, bounds, against);
    return status;
}

static bool has_crease(const crease_draft *draft, const group *one)
{
    bool sharp = false;
    for (size_t l = one->first; l < one->first + one->count; l++)
        sharp = sharp || crease_sharpness_is_crease(draft, one->direction, l);
    return sharp;
}

static bool is_near(const crease_layout *layout, const group *one, const double uv[2], double reach)
{
    const double *const lines = layout->axis[one->direction].lines + one->first;
    const double t = uv[one->direction];
    return t > lines[0] - reach && t < lines[one->count - 1] + reach;
}

/* Mean distance of the samples near a group's lines from the draft's height, and its standard
 * error. */
static crease_status measure_near(crease_context *context, const crease_draft *draft,
    const crease_layout *layout, const group *one, double mean[2])
{
    crease_samples *const s = draft->samples;
    const crease_status status = crease_samples_measure(context, s, &draft->height);
    const double cap = CAP * crease_samples_scale(s);
    double n = 0.0, sum = 0.0, squares = 0.0;
    for (size_t i = 0; i < s->count && status == CREASE_OK; i++)
        if (is_near(layout, one, s->uv + 2 * i, REACH * s->spacing)) {
            const double distance = fmin(fabs(s->residual[i]), cap);
            n += s->prior[i];
            sum += s->prior[i] * distance;
            squares += s->prior[i] * distance * distance;
        }
    mean[0] = n > 0.0 ? sum / n : 0.0;
    mean[1] = n > 0.0 ? sqrt(fmax(squares / n - mean[0] * mean[0], 0.0) / n) : 0.0;
    return status;
}

/* Whether the rival leaves as little near each of the groups, whose lines it lacks. */
static crease_status serves(crease_context *context, const crease_draft *draft,
    const crease_draft *rival, const group *groups, size_t count, bool *out)
{
    crease_status status = CREASE_OK;
    *out = true;
    for (size_t i = 0; i < count && *out && status == CREASE_OK; i++) {
        double with[2], without[2];
        status = measure_near(context, draft, &draft->layout, &groups[i], with);
        if (status == CREASE_OK)
            status = measure_near(context, rival, &draft->layout, &groups[i], without);
        *out = without[0] <= with[0] + ALIKE * with[1];
    }
    return status;
}

/* Simple knots in place of lines that are no creases. */
static crease_status leave_creases(
    crease_context *context, crease_draft *draft, const crease_bounds *bounds)
{
    group groups[2 * CREASE_MOST_LINES];
    const size_t all = find_groups(draft, groups);
    size_t count = 0;
    for (size_t i = 0; i < all; i++)
        if (!has_crease(draft, &groups[i]))
            groups[count++] = groups[i];
    if (count == 0)
        return CREASE_OK;
    crease_draft rival;
    bool wanted = false;
    crease_status status = grow_rival(context, draft, bounds, groups, count, NULL, &rival);
    if (status == CREASE_OK)
        status = serves(context, draft, &rival, groups, count, &wanted);
    decide(draft, &rival, status == CREASE_OK && wanted, &wanted);
    return status == CREASE_ERROR_NUMERIC ? CREASE_OK : status;
}

/* A net that has but some of the lines and all the simple knots that it asks for explains the
 * points about as well when the others only stood in for those knots: lines are chosen while the
 * net is still coarse. */
static crease_status challenge(
    crease_context *context, crease_draft *draft, const crease_bounds *bounds)
{
    group groups[2 * CREASE_MOST_LINES], others[2 * CREASE_MOST_LINES];
    const size_t count = find_groups(draft, groups);
    crease_status status = weigh_groups(context, draft, bounds, groups, count);
    bool taken = false;
    for (size_t kept = 0; kept < count && !taken && status == CREASE_OK; kept++) {
        memcpy(others, groups + kept, (count - kept) * sizeof *groups);
        crease_draft rival;
        status = grow_rival(context, draft, bounds, others, count - kept, draft, &rival);
        decide(draft, &rival,
            status == CREASE_OK && rival.score < draft->score + CREASE_EXPLORE_MARGIN, &taken);
        status = status == CREASE_ERROR_NUMERIC ? CREASE_OK : status;
    }
    return status;
}

crease_status crease_prune(
    crease_context *context, crease_draft *draft, const crease_bounds *bounds, bool turn)
{
    crease_draft_place(draft);
    crease_status status = crease_draft_fit(context, draft, ROUNDS, CREASE_CHOICE_NEAR);
    if (status == CREASE_OK)
        status = thin_out(context, draft, bounds);
    /* A simple knot of order 2 is a crease itself. */
    const bool smooth = draft->layout.order > 2;
    if (status == CREASE_OK)
        status = crease_explore_drop_lines(context, draft, bounds, smooth ? 4 : 1);
    if (status == CREASE_OK && smooth && !(bounds->tolerance > 0.0))
        status = challenge(context, draft, bounds);
    if (status == CREASE_OK && smooth && !(bounds->tolerance > 0.0))
        status = leave_creases(context, draft, bounds);
    if (status == CREASE_OK)
        status = merge_steps(context, draft, bounds, turn);
    return status;
}
