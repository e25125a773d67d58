/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "detect/bootstrap.h"

#include "base/random.h"

void crease_bootstrap_draw(
    uint64_t seed, uint64_t stream, uint64_t first, size_t count, int k, uint32_t *words)
{
    const size_t blocks = crease_bootstrap_words(k) / 4;
    crease_random_blocks(seed, stream, first * blocks, count * blocks, words);
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
