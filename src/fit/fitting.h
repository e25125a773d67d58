/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* From points to a fitted draft: the choices, on at most CREASE_MOST_EXPLORED of them, and the fit
 * of all. */
#ifndef CREASE_FIT_FITTING_H
#define CREASE_FIT_FITTING_H

#include "averaging/orient.h"
#include "fit/closest.h"
#include "fit/explore.h"

typedef struct crease_fitting {
    const crease_sheet_options *options;
    crease_bounds bounds;
    bool large; /* the net asked for is too large to choose with; it is fitted at the end */
    bool exact; /* frame and lines are those of a sheet that goes through all points */
    size_t count;
    const double *points; /* not owned */
    double epsilon;       /* relative rounding of the coordinates */
    double *keep;         /* 0 for points that stand alone, else 1 */
    double spacing;
    crease_oriented oriented;
    crease_draft draft;
    double errors[2 * CREASE_MOST_LINES]; /* standard errors of the lines */
} crease_fitting;

/* Says what is wrong with the options, and warns of a net that has no room for a crease. Errors:
 * ARGUMENT, TOO_FEW_POINTS. */
crease_status crease_fitting_check(
    crease_context *context, const crease_sheet_options *options, size_t count);
/* Finds the frame to begin with and the points that stand alone. The options, which must be good,
 * and the cloud must outlive the fitting; free it also on failure. Errors: DEGENERATE, NO_MEMORY,
 * CANCELLED. */
crease_status crease_fitting_create(crease_context *context, const crease_cloud *cloud,
    const crease_sheet_options *options, crease_fitting *out);
void crease_fitting_free(crease_fitting *fitting);
/* Turns the frame so that lines can follow a direction in which a crease is known to run, unless
 * they can already. */
void crease_fitting_follow(
    crease_fitting *fitting, const double point[3], const double direction[3]);
/* Looks for a sheet of few control points that goes through all points, see fit/exact.h, where the
 * options leave the frame free. If there is one, there is nothing to choose but how to fill gaps.
 */
crease_status crease_fitting_find_exact(crease_context *context, crease_fitting *fitting);
/* Chooses frame, lines, knots and smoothing, on some of the points. */
crease_status crease_fitting_choose(crease_context *context, crease_fitting *fitting);
/* Fits all points, with the lines moved to where they fit best. The samples, empty before, are all
 * points then, those of the draft. */
crease_status crease_fitting_settle(
    crease_context *context, crease_fitting *fitting, crease_samples *samples);
/* Standard errors of the lines, and at all points where errors is not NULL. */
crease_status crease_fitting_tell_errors(
    crease_context *context, crease_fitting *fitting, double *errors);
/* Gives the draft's layout the knots of the large net that was asked for. Lines for which it has no
 * room are lost. */
void crease_fitting_lay_out_large(crease_fitting *fitting);
/* Fits the large net that was asked for, beginning with the feet and distances of the smaller one
 * that has been fitted. */
crease_status crease_fitting_enlarge(crease_context *context, crease_fitting *fitting);

/* The sheet of the draft, without points. Errors: NO_MEMORY. */
crease_status crease_fitting_sheet(
    crease_context *context, const crease_fitting *fitting, crease_sheet **out);
/* Whether the draft goes through its points but for rounding. */
bool crease_fitting_is_exact(const crease_fitting *fitting);
/* Gives a sheet its points, with their feet on it. closest: made of its height, or NULL. Errors:
 * NO_MEMORY, CANCELLED. */
crease_status crease_fitting_project(crease_context *context, const crease_closest *closest,
    const double *points, size_t count, crease_sheet *sheet);

#endif
