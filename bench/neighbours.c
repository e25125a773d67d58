/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* usage: bench-neighbours [MOST_POINTS [LEAST_POINTS]]
 * The K nearest neighbours of all points, sorting and making the tree included, beside nanoflann.
 */
#include "bench.h"
#include "peer.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void print(const char *who, size_t count, bool sorted, int k, int threads, bench_clock start)
{
    const bench_clock end = bench_now();
    printf("{\"bench\": \"neighbours\", \"who\": \"%s\", \"points\": %zu, \"order\": \"%s\", "
           "\"k\": %d, \"threads\": %d, \"cpu_s\": %.3f, \"wall_s\": %.3f}\n",
        who, count, sorted ? "morton" : "random", k, threads, end.cpu - start.cpu,
        end.wall - start.wall);
    fflush(stdout);
}

static void measure(const double *points, size_t count, bool sorted, int k, int threads)
{
    crease_context *context = bench_context(threads);
    crease_cloud *cloud = bench_cloud(context, points, count);
    crease_neighbours *neighbours = NULL;
    const bench_clock start = bench_now();
    if (cloud && crease_neighbours_find(context, cloud, k, &neighbours) == CREASE_OK)
        print("crease", count, sorted, k, threads, start);
    crease_neighbours_free(neighbours);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

#ifdef CREASE_HAVE_NANOFLANN
static void measure_peer(const double *points, size_t count, bool sorted, int k)
{
    uint32_t *indices = malloc(count * (size_t)k * sizeof *indices);
    const bench_clock start = bench_now();
    if (indices) {
        peer_nanoflann(points, count, (size_t)k, indices);
        print("nanoflann", count, sorted, k, 1, start);
    }
    free(indices);
}
#endif

static void measure_all(size_t count, bool sorted)
{
    crease_context *context = bench_context(2);
    double *points = bench_points(context, count, sorted);
    for (int k = 16; k <= 32 && points; k *= 2) {
        measure(points, count, sorted, k, 1);
        measure(points, count, sorted, k, 2);
#ifdef CREASE_HAVE_NANOFLANN
        measure_peer(points, count, sorted, k);
#endif
    }
    free(points);
    crease_context_free(context);
}

int main(int count, char **arguments)
{
    const size_t most = count > 1 ? strtoul(arguments[1], NULL, 10) : 1000000;
    const size_t least = count > 2 ? strtoul(arguments[2], NULL, 10) : 100000;
    for (size_t points = least; points <= most; points *= 10) {
        measure_all(points, true);
        measure_all(points, false);
    }
    return 0;
}
