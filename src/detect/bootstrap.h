/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The bootstrap: resamples drawn with replacement, and mean and variance of a statistic over them
 * (eq. 3 and 4 of the paper).
 *
 * Based on: Efron. Bootstrap methods: another look at the jackknife. 1979. */
#ifndef CREASE_DETECT_BOOTSTRAP_H
#define CREASE_DETECT_BOOTSTRAP_H

#include "base/simd.h"

#include <stddef.h>
#include <stdint.h>

/* Draws got from one random number: the high word of number x k is a draw, the low word is as good
 * as a fresh number while few bits are used up. A member's probability is off by less than 2^-12.
 */
static inline int crease_bootstrap_draws_per_word(int k)
{
    return k <= 32 ? 4 : 2;
}

/* 32-bit random numbers that resamples of a sample of size k (1..256) are made of: a multiple of
 * four, at most CREASE_MOST_WORDS. */
enum { CREASE_MOST_WORDS = 128 };
static inline size_t crease_bootstrap_words(int k)
{
    const int draws = 4 * crease_bootstrap_draws_per_word(k);
    return 4 * (size_t)((k + draws - 1) / draws);
}

/* The numbers of count resamples, from resample `first` of a stream on. */
void crease_bootstrap_draw(
    uint64_t seed, uint64_t stream, uint64_t first, size_t count, int k, uint32_t *words);

/* One resample: k members, each 0..k-1, in the order drawn. */
CREASE_INLINE void crease_bootstrap_members(const uint32_t *words, int k, uint8_t *members)
{
    const int draws = crease_bootstrap_draws_per_word(k);
    for (int begin = 0; begin < k; begin += draws) {
        const int end = begin + draws < k ? begin + draws : k;
        uint32_t rest = *words++;
        for (int i = begin; i < end; i++) {
            const uint64_t product = rest * (uint64_t)k;
            members[i] = (uint8_t)(product >> 32);
            rest = (uint32_t)product;
        }
    }
}

/* Eq. 3: the mean of a statistic of `components` numbers over count resamples. values[c][b] is
 * component c of resample b. */
void crease_bootstrap_mean(
    const double *const *values, size_t components, size_t count, double *mean);

/* Eq. 4: 1 / (count - 1) times the sum of squared deviations from the mean, summed over the
 * components: the trace of the covariance. count > 1. */
double crease_bootstrap_variance(
    const double *const *values, size_t components, size_t count, const double *mean);

#endif
