/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "detect/bootstrap.h"

#include "base/random.h"

/* Draws got from one number: the high word of number x k is a draw, the low word is as good as a
 * fresh number while few bits are used up. A member's probability is off by less than 2^-12. */
static int draws_per_word(int k)
{
    return k <= 32 ? 4 : 2;
}

size_t crease_bootstrap_words(int k)
{
    const int draws = 4 * draws_per_word(k);
    return 4 * (size_t)((k + draws - 1) / draws);
}

void crease_bootstrap_draw(
    uint64_t seed, uint64_t stream, uint64_t first, size_t count, int k, uint32_t *words)
{
    const size_t blocks = crease_bootstrap_words(k) / 4;
    crease_random_blocks(seed, stream, first * blocks, count * blocks, words);
}

void crease_bootstrap_members(const uint32_t *words, int k, uint8_t *members)
{
    const int draws = draws_per_word(k);
    uint64_t rest = 0;
    for (int i = 0; i < k; i++) {
        rest = (i % draws == 0 ? *words++ : (uint32_t)rest) * (uint64_t)k;
        members[i] = (uint8_t)(rest >> 32);
    }
}

void crease_bootstrap_mean(
    const double *const *values, size_t components, size_t count, double *mean)
{
    for (size_t c = 0; c < components; c++) {
        double sum = 0;
        for (size_t b = 0; b < count; b++)
            sum += values[c][b];
        mean[c] = sum / (double)count;
    }
}

double crease_bootstrap_variance(
    const double *const *values, size_t components, size_t count, const double *mean)
{
    double total = 0;
    for (size_t c = 0; c < components; c++) {
        double sum = 0;
        for (size_t b = 0; b < count; b++)
            sum += (values[c][b] - mean[c]) * (values[c][b] - mean[c]);
        total += sum;
    }
    return total / (double)(count - 1);
}
