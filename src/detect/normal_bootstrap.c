/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The statistic S of eq. 3 and 4: the unit normal of a resample by principal components, turned to
 * the side of the neighbourhood's own normal, because a normal has no sign of its own. A resample
 * of fewer than three different points, or of points on a line, has no normal and is drawn again:
 * otherwise perfect data would show noise. */
#include "detect/bootstrap.h"
#include "detect/scores.h"

#include <string.h>

enum { MOST_ATTEMPTS = 64 };

/* A variance below is rounding: the neighbours lie in a plane as exactly as doubles can tell. */
static const double rounding = 1e-20;

typedef struct resampling {
    const crease_neighbourhood *neighbourhood;
    uint64_t seed, stream;
    crease_resamples *resamples;
    const double *normal;
    uint64_t attempt;
} resampling;

/* The normals of some of the pending resamples, at most CREASE_BATCH. */
static void solve(const resampling *run, const uint32_t *pending, size_t count,
    crease_matrices *matrices, crease_directions *normals)
{
    uint32_t words[CREASE_BATCH * CREASE_MOST_WORDS];
    const int k = run->neighbourhood->k;
    const uint64_t first = run->attempt * run->resamples->room;
    if (pending[count - 1] - pending[0] == count - 1)
        crease_bootstrap_draw(run->seed, run->stream, first + pending[0], count, k, words);
    else
        for (size_t i = 0; i < count; i++)
            crease_bootstrap_draw(run->seed, run->stream, first + pending[i], 1, k,
                words + i * crease_bootstrap_words(k));
    crease_neighbourhood_resample(run->neighbourhood, words, count, matrices);
    crease_eigen_smallest(matrices, count, normals);
}

static void store(const resampling *run, const crease_directions *normals, size_t lane, uint32_t b)
{
    const double *const n = run->normal;
    const double x = normals->x[lane], y = normals->y[lane], z = normals->z[lane];
    const double sign = x * n[0] + y * n[1] + z * n[2] < 0 ? -1 : 1;
    run->resamples->values[0][b] = sign * x;
    run->resamples->values[1][b] = sign * y;
    run->resamples->values[2][b] = sign * z;
}

/* One attempt at all pending resamples; returns how many still have no normal. */
static size_t attempt(const resampling *run, size_t count, crease_matrices *matrices)
{
    uint32_t *const pending = run->resamples->pending;
    crease_directions normals;
    size_t left = 0;
    for (size_t begin = 0; begin < count; begin += CREASE_BATCH) {
        const size_t size = count - begin < CREASE_BATCH ? count - begin : CREASE_BATCH;
        solve(run, pending + begin, size, matrices, &normals);
        for (size_t i = 0; i < size; i++) {
            const uint32_t b = pending[begin + i];
            if (normals.spread[i] > CREASE_LINE_SPREAD)
                store(run, &normals, i, b);
            else
                pending[left++] = b;
        }
    }
    return left;
}

/* True when every resample has its normal. */
static bool resample(resampling *run, crease_matrices *matrices)
{
    size_t left = run->resamples->room;
    for (size_t b = 0; b < left; b++)
        run->resamples->pending[b] = (uint32_t)b;
    for (run->attempt = 0; run->attempt < MOST_ATTEMPTS && left > 0; run->attempt++)
        left = attempt(run, left, matrices);
    return left == 0;
}

bool crease_normal_bootstrap_compute(const crease_neighbourhood *neighbourhood,
    const crease_principal *principal, uint64_t seed, uint64_t stream, crease_resamples *resamples,
    crease_normal_bootstrap *out)
{
    crease_matrices matrices;
    memset(&matrices, 0, sizeof matrices);
    *out = (crease_normal_bootstrap){0};
    resampling run = {neighbourhood, seed, stream, resamples, principal->normal, 0};
    if (!resample(&run, &matrices))
        return false;
    const double *const values[3] = {
        resamples->values[0], resamples->values[1], resamples->values[2]};
    crease_bootstrap_mean(values, 3, resamples->room, out->mean);
    const double variance = crease_bootstrap_variance(values, 3, resamples->room, out->mean);
    out->variance = variance < rounding ? 0 : variance;
    return true;
}
