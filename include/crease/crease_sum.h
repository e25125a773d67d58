/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/** @file crease_sum.h
 * Sheets of points that come in batches and are not kept: the memory that a fit takes grows with
 * its control points, not with its points. Part of libcrease; the manners are those of crease.h.
 *
 *     crease_sheet_sum_create(context, sample, &options, &sum);
 *     for every batch: crease_sheet_sum_widen(context, sum, points, count);
 *     do {
 *         crease_sheet_free(sheet);
 *         for every batch: crease_sheet_sum_add(context, sum, points, count);
 *         crease_sheet_sum_solve(context, sum, &sheet);
 *     } while (crease_sheet_sum_wants_more(sum));
 *     crease_sheet_sum_free(sum);
 */
#ifndef CREASE_CREASE_SUM_H
#define CREASE_CREASE_SUM_H

#include "crease/crease.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The normal equations of a sheet: a sum over points. */
typedef struct crease_sheet_sum crease_sheet_sum;

/** Begins a sheet with a sample of its points, drawn evenly from all of them; 10 000 to 200 000 are
 * enough. Frame, crease lines, scatter and, unless options prescribe it, the net are those that
 * crease_sheet_fit() would find of the sample for a height field: curved creases and folds are not
 * looked for. The sample is copied; it is not part of the sum. Errors: those of
 * crease_sheet_fit(). */
CREASE_API crease_status crease_sheet_sum_create(crease_context *context,
    const crease_cloud *sample, const crease_sheet_options *options, crease_sheet_sum **out);
CREASE_API void crease_sheet_sum_free(crease_sheet_sum *sum);
/** Extends the rectangle of the sheet to these points, count x 3, those apart that are further than
 * four spacings of the sample from the sample's own rectangle. Optional, and before the first
 * points are added: without it the rectangle is that of the sample. O(count). Errors: ARGUMENT
 * (points have been added), VALUE (a coordinate that is not finite). */
CREASE_API crease_status crease_sheet_sum_widen(
    crease_context *context, crease_sheet_sum *sum, const double *points, size_t count);
/** Adds points, count x 3. Their weights and feet are by the sheet found so far: that of the
 * sample, then the one solved last, and the first points after that begin a new round, from
 * nothing. Outliers, as far as they are some from that sheet, and points beyond its rectangle count
 * next to nothing. Memory: 150 bytes for each of at most 2^20 points at a time, and some 900 for
 * each control point of a large bicubic net. Threaded; the result depends on the batches to
 * rounding only. Errors: VALUE (a coordinate that is not finite), NO_MEMORY, CANCELLED. */
CREASE_API crease_status crease_sheet_sum_add(
    crease_context *context, crease_sheet_sum *sum, const double *points, size_t count);
/** Number of points added in this round. */
CREASE_API size_t crease_sheet_sum_count(const crease_sheet_sum *sum);
/** The least-squares sheet of the points added. The smoothing, when it is not prescribed, is chosen
 * by the score that crease_sheet_fit() uses, distances being those of the sample. The points of the
 * sheet, with parameters and deviations, are those of the sample, too; for others see
 * crease_sheet_sum_distances(). Errors: ARGUMENT (no points), NUMERIC, NO_MEMORY, CANCELLED. */
CREASE_API crease_status crease_sheet_sum_solve(
    crease_context *context, crease_sheet_sum *sum, crease_sheet **out);
/** Whether the sheet solved last is another one than the feet and weights were taken from, so that
 * a further round with the same points would bring more. */
CREASE_API bool crease_sheet_sum_wants_more(const crease_sheet_sum *sum);
/** Distances of points, count x 3, from the sheet solved last, signed as those of
 * crease_surface_project(): count numbers. A microsecond each. Threaded. Errors: ARGUMENT (nothing
 * is solved), VALUE, NO_MEMORY, CANCELLED. */
CREASE_API crease_status crease_sheet_sum_distances(crease_context *context,
    const crease_sheet_sum *sum, const double *points, size_t count, double *distances);

#ifdef __cplusplus
}
#endif

#endif
