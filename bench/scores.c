/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* usage: bench-scores [MOST_POINTS]
 * Scores and decision by every detector with the defaults, and the memory they add to the cloud's
 * own: measured by the first detector; the others need no more, and the peak does not show them. */
#include "bench.h"

#include <stdio.h>
#include <stdlib.h>

static void measure(const crease_cloud *cloud, crease_detector detector, int threads)
{
    static const char *const names[] = {"bootstrap", "jackknife", "variation", "gauss-map"};
    crease_context *context = bench_context(threads);
    crease_detect_options options = crease_detect_options_default();
    crease_scores *scores = NULL;
    const size_t count = crease_cloud_count(cloud);
    const double memory = bench_memory();
    const bench_clock start = bench_now();
    options.detector = detector;
    if (crease_scores_compute(context, cloud, &options, &scores) == CREASE_OK) {
        const bench_clock end = bench_now();
        printf("{\"bench\": \"scores\", \"who\": \"%s\", \"points\": %zu, \"threads\": %d, "
               "\"cpu_s\": %.3f, \"wall_s\": %.3f, \"bytes_per_point\": %.1f}\n",
            names[detector], count, threads, end.cpu - start.cpu, end.wall - start.wall,
            (bench_memory() - memory) / (double)count);
        fflush(stdout);
    }
    crease_scores_free(scores);
    crease_context_free(context);
}

static void measure_all(const crease_cloud *cloud)
{
    for (int threads = 2; threads >= 1; threads--)
        for (int detector = 0; detector <= CREASE_DETECTOR_GAUSS_MAP; detector++)
            measure(cloud, (crease_detector)detector, threads);
}

int main(int count, char **arguments)
{
    const size_t most = count > 1 ? strtoul(arguments[1], NULL, 10) : 1000000;
    crease_context *context = bench_context(2);
    for (size_t points = 100000; points <= most; points *= 10) {
        double *coordinates = bench_points(context, points, false);
        crease_cloud *cloud = coordinates ? bench_cloud(context, coordinates, points) : NULL;
        if (cloud)
            measure_all(cloud);
        crease_cloud_free(cloud);
        free(coordinates);
    }
    crease_context_free(context);
    return 0;
}
