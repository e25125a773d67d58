/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "detect/standardise.h"

#include <math.h>

static double mean(const double *values, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += values[i];
    return sum / (double)count;
}

static double deviation(const double *values, size_t count, double centre)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += (values[i] - centre) * (values[i] - centre);
    return count > 1 ? sqrt(sum / (double)(count - 1)) : 0;
}

static double lowest(const double *values, size_t count)
{
    double low = INFINITY;
    for (size_t i = 0; i < count; i++)
        low = values[i] < low ? values[i] : low;
    return low;
}

static bool all_equal(const double *values, size_t count)
{
    for (size_t i = 1; i < count; i++)
        if (values[i] != values[0])
            return false;
    return true;
}

void crease_standardise(const double *values, size_t count, bool positive, double *out)
{
    const bool equal = all_equal(values, count);
    const double centre = equal ? 0 : mean(values, count);
    const double scale = equal ? 0 : deviation(values, count, centre);
    const double zero = positive ? lowest(values, count) : centre;
    for (size_t i = 0; i < count; i++)
        out[i] = scale > 0 ? (values[i] - zero) / scale : 0;
}
