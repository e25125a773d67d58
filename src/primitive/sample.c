/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "primitive/sample.h"

#include "base/vector.h"

#include <math.h>

void crease_sample_mean(const crease_sample *sample, double mean[3])
{
    mean[0] = mean[1] = mean[2] = 0.0;
    for (size_t i = 0; i < sample->count; i++)
        for (size_t c = 0; c < 3; c++)
            mean[c] += sample->points[3 * i + c];
    for (int c = 0; c < 3; c++)
        mean[c] /= (double)sample->count;
}

void crease_sample_from(const crease_sample *sample, size_t i, const double place[3], double out[3])
{
    for (size_t c = 0; c < 3; c++)
        out[c] = sample->points[3 * i + c] - place[c];
}

double crease_sample_reach(const crease_sample *sample, const double place[3])
{
    double reach = 0.0;
    for (size_t i = 0; i < sample->count; i++)
        reach = fmax(reach, crease_vector_distance(sample->points + 3 * i, place));
    return reach;
}
