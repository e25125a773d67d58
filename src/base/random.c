/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "base/random.h"

#include "base/simd.h"

#include <math.h>

CREASE_INLINE uint32_t multiply(uint32_t a, uint32_t b, uint32_t *high)
{
    const uint64_t product = (uint64_t)a * b;
    *high = (uint32_t)(product >> 32);
    return (uint32_t)product;
}

CREASE_INLINE void make_block(uint64_t seed, uint64_t stream, uint64_t block, uint32_t *out)
{
    uint32_t c0 = (uint32_t)block, c1 = (uint32_t)(block >> 32);
    uint32_t c2 = (uint32_t)stream, c3 = (uint32_t)(stream >> 32);
    uint32_t k0 = (uint32_t)seed, k1 = (uint32_t)(seed >> 32);
    for (int round = 0; round < 10; round++) {
        uint32_t high0, high1;
        const uint32_t low0 = multiply(0xD2511F53u, c0, &high0);
        const uint32_t low1 = multiply(0xCD9E8D57u, c2, &high1);
        const uint32_t n0 = high1 ^ c1 ^ k0, n2 = high0 ^ c3 ^ k1;
        c0 = n0, c1 = low1, c2 = n2, c3 = low0;
        k0 += 0x9E3779B9u, k1 += 0xBB67AE85u;
    }
    out[0] = c0, out[1] = c1, out[2] = c2, out[3] = c3;
}

void crease_random_block(uint64_t seed, uint64_t stream, uint64_t block, uint32_t out[4])
{
    make_block(seed, stream, block, out);
}

CREASE_VECTORISED void crease_random_blocks(
    uint64_t seed, uint64_t stream, uint64_t first, size_t count, uint32_t *out)
{
    for (size_t i = 0; i < count; i++)
        make_block(seed, stream, first + i, out + 4 * i);
}

static uint32_t word(uint64_t seed, uint64_t stream, uint64_t draw)
{
    uint32_t block[4];
    crease_random_block(seed, stream, draw / 4, block);
    return block[draw % 4];
}

static double unit(uint32_t high, uint32_t low)
{
    const uint64_t bits = (uint64_t)high << 21 ^ (uint64_t)low >> 11;
    return (double)bits * 0x1p-53;
}

double crease_random_uniform(uint64_t seed, uint64_t stream, uint64_t draw)
{
    uint32_t block[4];
    crease_random_block(seed, stream, draw / 2, block);
    return draw % 2 ? unit(block[2], block[3]) : unit(block[0], block[1]);
}

uint32_t crease_random_below(uint64_t seed, uint64_t stream, uint64_t draw, uint32_t n)
{
    return (uint32_t)((uint64_t)word(seed, stream, draw) * n >> 32);
}

double crease_random_normal(uint64_t seed, uint64_t stream, uint64_t draw)
{
    const double tau = 6.283185307179586;
    uint32_t block[4];
    crease_random_block(seed, stream, draw, block);
    const double radius = sqrt(-2.0 * log(1.0 - unit(block[0], block[1])));
    return radius * cos(tau * unit(block[2], block[3]));
}
