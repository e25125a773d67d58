/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A sheet in the making: a frame, a layout of knots, and the height fitted over it. */
#ifndef CREASE_FIT_DRAFT_H
#define CREASE_FIT_DRAFT_H

#include "net/system.h"

/* The weights of the bending term that are tried, from next to nothing to planes between creases.
 */
enum { CREASE_LAMBDAS = 9 };

/* Which bending weights a fit tries. */
typedef enum crease_choice {
    CREASE_CHOICE_NONE, /* the one last taken */
    CREASE_CHOICE_NEAR, /* those near the one last taken */
    CREASE_CHOICE_ALL   /* every one when there are few control points */
} crease_choice;

typedef struct crease_draft {
    crease_samples *samples; /* not owned */
    crease_frame frame;
    crease_layout layout;
    crease_height height;
    crease_system system;
    double fixed_lambda; /* negative: the best of those tried */
    int lambda;          /* number of the one taken */
    bool orthogonal;     /* minimise true distances, not vertical ones */
    bool redescending;   /* forget outliers */
    double stiffness;    /* weight of the bending, in absolute numbers, to try first; else 0 */
    bool begun;          /* the samples have feet and distances to begin the next fit with */
    bool warm;           /* the points are many: fits begin from what is known */
    double observed; /* points that the equations are of, when the samples are but some; else 0 */
    double mean;     /* mean distance of the points */
    double freedom;  /* effective number of parameters */
    double score;    /* to compare drafts: the lower, the better */
} crease_draft;

/* Puts the samples into the draft's frame, and the ends of the domain around them. */
void crease_draft_place(crease_draft *draft);
/* Fits the height to the samples as placed, robustly, in some rounds (more when the points are
 * few). The bending weight is the one with the lowest score of those tried. An orthogonal fit must
 * not choose: a steep sheet is near to every point.
 *
 * The score is 2 n log(mean distance) + freedom log n: the Bayesian information criterion for
 * errors of Laplace's distribution, which has wide tails.
 * Based on: Schwarz. Estimating the dimension of a model. 1978.
 * Errors: NUMERIC, NO_MEMORY, CANCELLED. */
crease_status crease_draft_fit(
    crease_context *context, crease_draft *draft, int rounds, crease_choice choice);
/* A fit in steps, to points that come in parts: the height and the equations of the layout, without
 * points; begun: the height is then much like the one before. */
crease_status crease_draft_open(crease_context *context, crease_draft *draft);
/* How much a gap resists. scale: standard deviation of the points. */
void crease_draft_hold(crease_draft *draft, double scale);
/* Solves the equations as they are; NONE, or NEAR. Distances and score are those of the samples.
 * Errors: as crease_draft_fit(). */
crease_status crease_draft_solve(
    crease_context *context, crease_draft *draft, crease_choice choice);
/* Places the samples and finds their feet on a height much like the one to come, the draft's own
 * perhaps: the next fit takes its planes and weights from there. Errors: CANCELLED. */
crease_status crease_draft_begin(crease_context *context, crease_draft *draft,
    const crease_height *height, const crease_layout *layout);
/* The bending weight of the fit at hand, in absolute numbers. */
double crease_draft_stiffness(const crease_draft *draft);
/* One round more of the fit at hand. Errors: as crease_draft_fit(). */
crease_status crease_draft_fit_again(crease_context *context, crease_draft *draft);
/* Whether the height stays near the points': within once their range above and below. */
bool crease_draft_bounded(const crease_draft *draft);
/* Frees what the draft owns. */
void crease_draft_free(crease_draft *draft);
/* The draft with another layout and frame, not fitted yet, otherwise alike. */
crease_draft crease_draft_variant(
    const crease_draft *draft, const crease_layout *layout, const crease_frame *frame);

#endif
