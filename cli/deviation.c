/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "deviation.h"

#include <math.h>
#include <stdlib.h>

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

deviation_summary deviation_summarise(const double *deviations, size_t count)
{
    deviation_summary summary = {0};
    double *size = calloc(count ? count : 1, sizeof *size);
    double square = 0, sum = 0;
    if (!size || !count) {
        free(size);
        return summary;
    }
    for (size_t i = 0; i < count; i++) {
        size[i] = fabs(deviations[i]);
        sum += deviations[i];
        square += deviations[i] * deviations[i];
    }
    qsort(size, count, sizeof *size, ascending);
    summary.mean = sum / (double)count;
    summary.rms = sqrt(square / (double)count);
    summary.p95 = size[(count - 1) * 95 / 100];
    summary.most = size[count - 1];
    free(size);
    return summary;
}

void deviation_describe(cJSON *object, deviation_summary summary)
{
    cJSON_AddNumberToObject(object, "mean", summary.mean);
    cJSON_AddNumberToObject(object, "rms", summary.rms);
    cJSON_AddNumberToObject(object, "p95", summary.p95);
    cJSON_AddNumberToObject(object, "max", summary.most);
}
