/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "deviation.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

enum { BITS = 8, VALUES = 1 << BITS };

/* The bits of a size: sizes are in their order. */
static uint64_t bits_of(double deviation)
{
    const double size = fabs(deviation);
    uint64_t bits;
    memcpy(&bits, &size, sizeof bits);
    return bits;
}

/* The size that would be number `rank` of them in order: its bits, from the highest on. */
static double size_in_order(const double *deviations, size_t count, size_t rank)
{
    uint64_t found = 0, known = 0; /* known: mask of the bits that are */
    for (int shift = 64 - BITS; shift >= 0; shift -= BITS) {
        size_t counts[VALUES] = {0}, value = 0;
        for (size_t i = 0; i < count; i++) {
            const uint64_t bits = bits_of(deviations[i]);
            if ((bits & known) == found)
                counts[bits >> shift & (VALUES - 1)]++;
        }
        while (rank >= counts[value])
            rank -= counts[value++];
        found |= (uint64_t)value << shift;
        known |= (uint64_t)(VALUES - 1) << shift;
    }
    double size;
    memcpy(&size, &found, sizeof size);
    return size;
}

deviation_summary deviation_summarise(const double *deviations, size_t count)
{
    deviation_summary summary = {0};
    double square = 0, sum = 0;
    if (!count)
        return summary;
    for (size_t i = 0; i < count; i++) {
        summary.most = fmax(summary.most, fabs(deviations[i]));
        sum += deviations[i];
        square += deviations[i] * deviations[i];
    }
    summary.mean = sum / (double)count;
    summary.rms = sqrt(square / (double)count);
    summary.p95 = size_in_order(deviations, count, (count - 1) * 95 / 100);
    return summary;
}

void deviation_describe(cJSON *object, deviation_summary summary)
{
    cJSON_AddNumberToObject(object, "mean", summary.mean);
    cJSON_AddNumberToObject(object, "rms", summary.rms);
    cJSON_AddNumberToObject(object, "p95", summary.p95);
    cJSON_AddNumberToObject(object, "max", summary.most);
}
