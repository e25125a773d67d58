/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Based on: Tomasi, Manduchi. Bilateral filtering for gray and color images. 1998.
 * Based on: Jones, Durand, Zwicker. Normal improvement for point rendering. 2004 (of normals). */
#include "noise/bilateral.h"

#include "base/parallel.h"
#include "base/vector.h"

#include <math.h>

enum { GRAIN = 1024, MOST = 25 }; /* neighbours averaged: the windows of the normals themselves */

typedef struct smoothing {
    const crease_bilateral *filter;
    const double *from;
    double *to;
} smoothing;

static void smooth_point(const smoothing *run, size_t point)
{
    const crease_bilateral *const filter = run->filter;
    const int found = crease_neighbours_k(filter->neighbours), k = found < MOST ? found : MOST;
    const uint32_t *const near = crease_neighbours_of(filter->neighbours, point);
    const double *const own = run->from + 3 * point, *const at = filter->points + 3 * point;
    const double reach =
        1.05 * crease_vector_distance(at, filter->points + 3 * (size_t)near[k - 1]);
    double sum[3] = {own[0], own[1], own[2]};
    for (int j = 0; j < k && reach > 0; j++) {
        const size_t other = near[j];
        const double *const n = run->from + 3 * other;
        const double cosine = crease_vector_dot(n, own);
        const double far = crease_vector_distance(at, filter->points + 3 * other) / reach;
        const double agree = (fabs(cosine) - filter->least_cosine) / (1 - filter->least_cosine);
        if (other == point || agree <= 0)
            continue;
        const double weight = (1 - far * far) * agree * agree;
        for (int c = 0; c < 3; c++)
            sum[c] += copysign(weight, cosine) * n[c];
    }
    crease_vector_normalise(sum);
    for (int c = 0; c < 3; c++)
        run->to[3 * point + (size_t)c] = sum[c];
}

static void smooth(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    for (size_t i = begin; i < end; i++)
        smooth_point(user, i);
}

crease_status crease_bilateral_smooth(
    crease_context *context, const crease_bilateral *filter, const double *from, double *to)
{
    smoothing run = {filter, from, to};
    return crease_parallel_for(
        context, crease_neighbours_count(filter->neighbours), GRAIN, smooth, &run);
}
