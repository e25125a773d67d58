/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "fit/explore.h"

#include "fit/lines.h"

#include <math.h>

enum { ROUNDS = 3 };
/* Lines that are refined one at a time, before the others are looked at; these are the strongest.
 */
enum { FIRST_LINES = 2 };

bool crease_explore_keep_net(crease_layout *layout, const crease_bounds *bounds)
{
    for (int d = 0; d < 2; d++) {
        crease_layout_axis *const axis = &layout->axis[d];
        if (bounds->net[d] == 0)
            continue;
        axis->smooth = 0;
        const size_t least = crease_layout_count(layout, d);
        if (bounds->net[d] < least)
            return false;
        axis->smooth = bounds->net[d] - least;
    }
    return true;
}

static size_t unknowns(const crease_layout *layout)
{
    return crease_layout_count(layout, 0) * crease_layout_count(layout, 1);
}

crease_status crease_explore_try(crease_context *context, crease_draft *draft,
    const crease_layout *layout, double margin, bool *taken)
{
    *taken = false;
    crease_draft trial = crease_draft_variant(draft, layout, &draft->frame);
    const crease_status status = crease_draft_fit(context, &trial, ROUNDS, CREASE_CHOICE_ALL);
    if (status == CREASE_OK && trial.score < draft->score - margin &&
        (crease_draft_bounded(&trial) || !crease_draft_bounded(draft))) {
        crease_draft_free(draft);
        *draft = trial;
        *taken = true;
        return CREASE_OK;
    }
    crease_draft_free(&trial);
    return status == CREASE_ERROR_NUMERIC ? CREASE_OK : status;
}

static crease_status try_candidate(crease_context *context, crease_draft *draft,
    const crease_bounds *bounds, const crease_candidate *candidate, bool *taken)
{
    *taken = false;
    crease_layout layout = draft->layout;
    const crease_layout_axis *const axis = &layout.axis[candidate->direction];
    bool fits = axis->line_count + (size_t)candidate->count <= bounds->creases;
    for (int i = 0; i < candidate->count && fits; i++)
        fits = crease_layout_add(
            &layout, candidate->direction, candidate->at[i], draft->samples->spacing);
    if (!fits || !crease_explore_keep_net(&layout, bounds) ||
        unknowns(&layout) > CREASE_EXPLORED_UNKNOWNS)
        return CREASE_OK;
    return crease_explore_try(context, draft, &layout, CREASE_EXPLORE_MARGIN, taken);
}

/* More simple knots along the directions in the mask; false when that is not allowed. */
static bool finer(const crease_draft *draft, const crease_bounds *bounds, int mask, size_t factor,
    crease_layout *out)
{
    *out = draft->layout;
    for (int d = 0; d < 2; d++)
        if (mask & 1 << d) {
            if (bounds->net[d])
                return false;
            out->axis[d].smooth = factor * (out->axis[d].smooth + 1) - 1;
        }
    return unknowns(out) <= CREASE_EXPLORED_UNKNOWNS &&
        ((double)unknowns(out) <= draft->samples->used || unknowns(out) <= 256);
}

crease_status crease_explore_grow(
    crease_context *context, crease_draft *draft, const crease_bounds *bounds, bool *grown)
{
    const struct {
        int mask;
        size_t factor;
    } tries[] = {{1, 2}, {2, 2}, {3, 2}, {1, 4}, {2, 4}, {3, 4}};
    *grown = false;
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < sizeof tries / sizeof tries[0] && !*grown && status == CREASE_OK; i++) {
        crease_layout layout;
        if (finer(draft, bounds, tries[i].mask, tries[i].factor, &layout))
            status = crease_explore_try(context, draft, &layout, CREASE_EXPLORE_MARGIN, grown);
    }
    return status;
}

static double root_mean_square(const crease_samples *samples)
{
    double sum = 0.0;
    for (size_t i = 0; i < samples->count; i++)
        sum += samples->prior[i] * samples->residual[i] * samples->residual[i];
    return sqrt(sum / samples->used);
}

static crease_status grow_to_tolerance(
    crease_context *context, crease_draft *draft, const crease_bounds *bounds)
{
    crease_status status = crease_samples_measure(context, draft->samples, &draft->height);
    bool taken = true;
    while (status == CREASE_OK && taken && root_mean_square(draft->samples) > bounds->tolerance) {
        crease_layout layout;
        taken = false;
        for (int mask = 3; mask > 0 && !taken && status == CREASE_OK; mask--)
            if (finer(draft, bounds, mask, 2, &layout))
                status = crease_explore_try(context, draft, &layout, -INFINITY, &taken);
    }
    return status;
}

/* A line less and some simple knots more, when that does about as well. */
static crease_status try_without(crease_context *context, crease_draft *draft,
    const crease_bounds *bounds, int direction, size_t line, size_t more, bool *taken)
{
    crease_layout layout = draft->layout;
    crease_layout_remove(&layout, direction, line);
    layout.axis[direction].smooth += more;
    crease_explore_keep_net(&layout, bounds);
    return crease_explore_try(context, draft, &layout, -CREASE_EXPLORE_MARGIN, taken);
}

crease_status crease_explore_drop_lines(
    crease_context *context, crease_draft *draft, const crease_bounds *bounds, size_t tries)
{
    static const size_t instead[] = {0, 1, 3, 8};
    crease_status status = CREASE_OK;
    for (int d = 0; d < 2; d++)
        for (size_t l = draft->layout.axis[d].line_count; l-- > 0;) {
            bool taken = false;
            for (size_t i = 0; i < tries && !taken && status == CREASE_OK; i++)
                status = try_without(context, draft, bounds, d, l, instead[i], &taken);
        }
    return status;
}

static crease_status grow(crease_context *context, crease_draft *draft, const crease_bounds *bounds)
{
    crease_status status = CREASE_OK;
    bool grown = true;
    while (grown && status == CREASE_OK && !(bounds->tolerance > 0.0))
        status = crease_explore_grow(context, draft, bounds, &grown);
    return status;
}

/* With a crease that is known the net may be refined at once: other lines that only stand in for
 * simple knots are not taken, nor do they turn the frame. */
static crease_status grow_about(
    crease_context *context, crease_draft *draft, const crease_bounds *bounds, bool turn)
{
    const crease_status status = grow(context, draft, bounds);
    return status == CREASE_OK ? crease_lines_refine(context, draft, 12, turn) : status;
}

crease_status crease_explore(crease_context *context, crease_draft *draft,
    const crease_bounds *bounds, const crease_candidate *candidates, size_t count, bool turn)
{
    int refined = 0;
    for (int d = 0; d < 2; d++)
        if (bounds->net[d] == 0)
            draft->layout.axis[d].smooth = bounds->least[d];
    crease_status status = crease_draft_fit(context, draft, ROUNDS, CREASE_CHOICE_ALL);
    for (size_t i = 0; i < count && status == CREASE_OK; i++) {
        bool taken;
        status = try_candidate(context, draft, bounds, &candidates[i], &taken);
        if (taken && refined++ < FIRST_LINES && status == CREASE_OK)
            status = crease_lines_refine(context, draft, 12, turn);
        if (taken && isinf(candidates[i].gain) && status == CREASE_OK)
            status = grow_about(context, draft, bounds, turn);
    }
    if (status == CREASE_OK)
        status = crease_lines_refine(context, draft, 12, turn);
    if (status == CREASE_OK)
        status = crease_explore_drop_lines(context, draft, bounds, 1);
    if (status == CREASE_OK)
        status = grow(context, draft, bounds);
    if (status == CREASE_OK && bounds->tolerance > 0.0)
        status = grow_to_tolerance(context, draft, bounds);
    return status;
}
