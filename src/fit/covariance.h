/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* How exactly a fit is known: the covariance of its control points, its lines and the turn of its
 * frame, all of which are unknowns.
 *
 * It is the inverse of the penalised equations, times the variance of the points: what is known of
 * the sheet from the points and from its being smooth together.
 * Based on: Wahba. Bayesian confidence intervals for the cross-validated smoothing spline. 1983;
 * Erisman, Tinney. On computing certain elements of the inverse of a sparse matrix. 1975. */
#ifndef CREASE_FIT_COVARIANCE_H
#define CREASE_FIT_COVARIANCE_H

#include "fit/places.h"

typedef struct crease_covariance {
    const crease_draft *draft;
    double variance; /* of the distance of a point of weight one */
    double *inverse; /* of the equations of the control points, the band of their factor */
    crease_places places;
    size_t free;                                           /* places that are determined */
    size_t place[CREASE_MOST_PLACES];                      /* their numbers */
    double inner[CREASE_MOST_PLACES * CREASE_MOST_PLACES]; /* inverse of their equations */
} crease_covariance;

/* Of a draft that is fitted by elimination in a band, which must stay as it is. turn: the frame was
 * found by the fit. Free it also on failure. Errors: NO_MEMORY, CANCELLED. */
crease_status crease_covariance_create(
    crease_context *context, crease_draft *draft, bool turn, crease_covariance *out);
void crease_covariance_free(crease_covariance *covariance);
/* Standard error of each line's position across itself, direction 0 first; 0 where the points do
 * not determine it. */
void crease_covariance_lines(
    const crease_covariance *covariance, double errors[2 * CREASE_MOST_LINES]);
/* Standard error of the sheet at the foot of each of the points that the samples were taken from,
 * along its normal; the samples must be all of them. Threaded. Errors: CANCELLED. */
crease_status crease_covariance_points(
    crease_context *context, const crease_covariance *covariance, double *errors);

#endif
