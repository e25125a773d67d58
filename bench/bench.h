/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What the benchmarks share: a cloud, clocks, a context. Each measurement is one line of JSON. */
#ifndef CREASE_BENCH_BENCH_H
#define CREASE_BENCH_BENCH_H

#include "crease/crease.h"

typedef struct bench_clock {
    double wall, cpu;
} bench_clock;

/* A bent sheet with a sharp fold and a little noise, over a unit square; count x 3. The points come
 * in random order, or along the Morton curve when sorted. NULL when memory runs out. */
double *bench_points(crease_context *context, size_t count, bool sorted);
crease_cloud *bench_cloud(crease_context *context, const double *points, size_t count);
crease_context *bench_context(int threads);
/* Wall-clock time and processor time of all threads, in seconds. */
bench_clock bench_now(void);
/* Highest memory of the process so far, in bytes. */
double bench_memory(void);

#endif
