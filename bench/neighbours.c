/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* usage: bench-neighbours [MOST_POINTS [LEAST_POINTS]]
 *        bench-neighbours once POINTS K
 * The K nearest neighbours of all points, sorting and making the tree included, beside nanoflann.
 * Each line is the best of as many runs as together search 10^6 points, one at least. The second
 * form is a single run of ours on one thread, points in random order: to count its instructions. */
#include "bench.h"
#include "peer.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What is measured, and the best run so far. */
typedef struct measurement {
    const char *who;
    const double *points;
    size_t count;
    bool sorted;
    int k, threads;
    bench_clock best;
} measurement;

static size_t runs(const measurement *m)
{
    return m->count < 1000000 ? 1000000 / m->count : 1;
}

static void note(measurement *m, bench_clock start)
{
    const bench_clock end = bench_now();
    m->best.cpu = fmin(m->best.cpu, end.cpu - start.cpu);
    m->best.wall = fmin(m->best.wall, end.wall - start.wall);
}

static void print(const measurement *m)
{
    printf("{\"bench\": \"neighbours\", \"who\": \"%s\", \"points\": %zu, \"order\": \"%s\", "
           "\"k\": %d, \"threads\": %d, \"cpu_s\": %.3f, \"wall_s\": %.3f}\n",
        m->who, m->count, m->sorted ? "morton" : "random", m->k, m->threads, m->best.cpu,
        m->best.wall);
    fflush(stdout);
}

static void measure(measurement m)
{
    crease_context *context = bench_context(m.threads);
    crease_cloud *cloud = bench_cloud(context, m.points, m.count);
    m.who = "crease";
    for (size_t run = 0; run < runs(&m) && cloud; run++) {
        crease_neighbours *neighbours = NULL;
        const bench_clock start = bench_now();
        if (crease_neighbours_find(context, cloud, m.k, &neighbours) == CREASE_OK)
            note(&m, start);
        crease_neighbours_free(neighbours);
    }
    print(&m);
    crease_cloud_free(cloud);
    crease_context_free(context);
}

#ifdef CREASE_HAVE_NANOFLANN
static void measure_peer(measurement m)
{
    m.who = "nanoflann";
    for (size_t run = 0; run < runs(&m); run++) {
        uint32_t *indices = malloc(m.count * (size_t)m.k * sizeof *indices);
        const bench_clock start = bench_now();
        if (indices) {
            peer_nanoflann(m.points, m.count, (size_t)m.k, indices);
            note(&m, start);
        }
        free(indices);
    }
    print(&m);
}
#endif

static int once(size_t count, int k)
{
    crease_context *context = bench_context(1);
    double *points = bench_points(context, count, false);
    crease_cloud *cloud = points ? bench_cloud(context, points, count) : NULL;
    crease_neighbours *neighbours = NULL;
    const bool found = cloud && crease_neighbours_find(context, cloud, k, &neighbours) == CREASE_OK;
    crease_neighbours_free(neighbours);
    crease_cloud_free(cloud);
    free(points);
    crease_context_free(context);
    return found ? 0 : 1;
}

static void measure_all(size_t count, bool sorted)
{
    crease_context *context = bench_context(2);
    double *points = bench_points(context, count, sorted);
    for (int k = 16; k <= 32 && points; k *= 2) {
        measurement m = {.points = points, .count = count, .sorted = sorted, .k = k, .threads = 2};
        m.best = (bench_clock){INFINITY, INFINITY};
        measure(m);
        m.threads = 1;
        measure(m);
#ifdef CREASE_HAVE_NANOFLANN
        measure_peer(m);
#endif
    }
    free(points);
    crease_context_free(context);
}

int main(int count, char **arguments)
{
    if (count == 4 && strcmp(arguments[1], "once") == 0)
        return once(strtoul(arguments[2], NULL, 10), atoi(arguments[3]));
    const size_t most = count > 1 ? strtoul(arguments[1], NULL, 10) : 1000000;
    const size_t least = count > 2 ? strtoul(arguments[2], NULL, 10) : 100000;
    for (size_t points = least; points <= most; points *= 10) {
        measure_all(points, true);
        measure_all(points, false);
    }
    return 0;
}
