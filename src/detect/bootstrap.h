/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The bootstrap: resamples drawn with replacement, and mean and variance of a statistic over them
 * (eq. 3 and 4 of the paper).
 *
 * Based on: Efron. Bootstrap methods: another look at the jackknife. 1979. */
#ifndef CREASE_DETECT_BOOTSTRAP_H
#define CREASE_DETECT_BOOTSTRAP_H

#include <stddef.h>
#include <stdint.h>

/* 32-bit random numbers that resamples of a sample of size k (1..256) are made of: a multiple of
 * four, at most CREASE_MOST_WORDS. */
enum { CREASE_MOST_WORDS = 128 };
size_t crease_bootstrap_words(int k);

/* The numbers of count resamples, from resample `first` of a stream on. */
void crease_bootstrap_draw(
    uint64_t seed, uint64_t stream, uint64_t first, size_t count, int k, uint32_t *words);

/* One resample: k members, each 0..k-1, in the order drawn. */
void crease_bootstrap_members(const uint32_t *words, int k, uint8_t *members);

/* Eq. 3: the mean of a statistic of `components` numbers over count resamples. values[c][b] is
 * component c of resample b. */
void crease_bootstrap_mean(
    const double *const *values, size_t components, size_t count, double *mean);

/* Eq. 4: 1 / (count - 1) times the sum of squared deviations from the mean, summed over the
 * components: the trace of the covariance. count > 1. */
double crease_bootstrap_variance(
    const double *const *values, size_t components, size_t count, const double *mean);

#endif
