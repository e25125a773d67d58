/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "fit/lines.h"

#include "fit/places.h"

#include <lapacke.h>
#include <math.h>
#include <string.h>

enum { MOST = CREASE_MOST_PLACES, HALVINGS = 5 };

static const double WORTH = 0.01;  /* log likelihood */
static const double EXACT = 1e-10; /* mean distance in spacings at which there is nothing to gain */

static bool solve(const crease_places *e, double *step)
{
    double matrix[MOST * MOST], right[MOST];
    size_t place[MOST];
    memset(step, 0, MOST * sizeof *step);
    const lapack_int n = (lapack_int)crease_places_pack(e, matrix, place);
    for (lapack_int a = 0; a < n; a++)
        right[a] = e->right[place[a]];
    if (n == 0 || LAPACKE_dposv_work(LAPACK_COL_MAJOR, 'L', n, 1, matrix, n, right, n) != 0)
        return false;
    for (lapack_int a = 0; a < n; a++)
        step[place[a]] = right[a];
    return true;
}

static double limit(double value, double most)
{
    return fmin(fmax(value, -most), most);
}

/* The draft with a share of the step; false when lines would collide. */
static bool moved(
    const crease_draft *draft, const double *step, double share, bool turn, crease_draft *out)
{
    crease_layout layout = draft->layout;
    crease_frame frame = draft->frame;
    const double spacing = draft->samples->spacing, most = 3.0 * spacing;
    size_t column = 0;
    for (int d = 0; d < 2; d++) {
        layout.axis[d].line_count = 0;
        for (size_t l = 0; l < draft->layout.axis[d].line_count; l++)
            if (!crease_layout_add(&layout, d,
                    draft->layout.axis[d].lines[l] + share * limit(step[column++], most), spacing))
                return false;
    }
    if (turn)
        crease_frame_turn(&frame, share * limit(step[column], 0.05));
    *out = crease_draft_variant(draft, &layout, &frame);
    return true;
}

/* Fits a draft, one much like it being at hand. */
static crease_status fit_like(
    crease_context *context, const crease_draft *like, crease_draft *draft, crease_choice choice)
{
    if (like->warm) {
        const crease_status status =
            crease_draft_begin(context, draft, &like->height, &like->layout);
        return status == CREASE_OK ? crease_draft_fit(context, draft, 1, choice) : status;
    }
    crease_draft_place(draft);
    return crease_draft_fit(context, draft, draft->orthogonal ? 4 : 3, choice);
}

/* Takes the largest of 1, 1/2, 1/4 .. of the step that brings a gain worth a trial; else the draft
 * stays. */
static crease_status walk(
    crease_context *context, crease_draft *draft, const double *step, bool turn, bool *gained)
{
    const double least = draft->mean * exp(-WORTH / draft->samples->used);
    const bool bounded = crease_draft_bounded(draft);
    double share = 1.0;
    *gained = false;
    for (int i = 0; i < HALVINGS; i++, share *= 0.5) {
        crease_draft trial;
        if (!moved(draft, step, share, turn, &trial))
            continue;
        const crease_status status = fit_like(context, draft, &trial, CREASE_CHOICE_NONE);
        if (status == CREASE_OK && trial.mean < least &&
            (!bounded || crease_draft_bounded(&trial))) {
            crease_draft_free(draft);
            *draft = trial;
            *gained = true;
            return CREASE_OK;
        }
        crease_draft_free(&trial);
        if (status != CREASE_OK && status != CREASE_ERROR_NUMERIC)
            return status;
    }
    return CREASE_OK;
}

crease_status crease_lines_refine(
    crease_context *context, crease_draft *draft, int steps, bool turn)
{
    if (draft->layout.axis[0].line_count + draft->layout.axis[1].line_count == 0)
        return CREASE_OK;
    const double exact = fmax(4.0 * draft->samples->rounding, EXACT * draft->samples->spacing);
    crease_status status = CREASE_OK;
    bool gained = true, tried = false; /* tried: the samples are those of a trial */
    for (int i = 0; i < steps && gained && draft->mean > exact && status == CREASE_OK; i++) {
        crease_places places;
        double step[MOST];
        gained = false;
        status = crease_places_sum(context, draft, turn, &places);
        const bool known = status == CREASE_OK && solve(&places, step);
        crease_places_free(&places);
        if (known) {
            status = walk(context, draft, step, turn, &gained);
            tried = !gained;
        }
    }
    if (status == CREASE_OK && (tried || !draft->warm))
        status = fit_like(
            context, draft, draft, draft->orthogonal ? CREASE_CHOICE_NONE : CREASE_CHOICE_NEAR);
    return status;
}
