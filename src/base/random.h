/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Random numbers as a pure function of (seed, stream, draw): no state, so that the same numbers
 * come out for any order of work and any number of threads.
 *
 * Based on: Salmon, Moraes, Dror, Shaw. Parallel random numbers: as easy as 1, 2, 3. 2011
 * (Philox4x32-10). */
#ifndef CREASE_BASE_RANDOM_H
#define CREASE_BASE_RANDOM_H

#include <stddef.h>
#include <stdint.h>

/* Four independent 32-bit numbers for block number `block` of a stream. */
void crease_random_block(uint64_t seed, uint64_t stream, uint64_t block, uint32_t out[4]);
/* Blocks first .. first + count - 1 of a stream, one after the other: 4 x count numbers. */
void crease_random_blocks(
    uint64_t seed, uint64_t stream, uint64_t first, size_t count, uint32_t *out);
/* Uniform in [0, 1). */
double crease_random_uniform(uint64_t seed, uint64_t stream, uint64_t draw);
/* Uniform in 0..n-1, n > 0; bias below n / 2^32. */
uint32_t crease_random_below(uint64_t seed, uint64_t stream, uint64_t draw, uint32_t n);
/* Standard normal. Based on: Box, Muller. A note on the generation of random normal deviates. 1958.
 */
double crease_random_normal(uint64_t seed, uint64_t stream, uint64_t draw);

#endif
