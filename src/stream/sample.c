/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "stream/sample.h"

#include "base/memory.h"
#include "base/random.h"
#include "cloud/cloud.h"

#include <stdlib.h>
#include <string.h>

enum { STREAM = 0x5a3 }; /* of random numbers */

typedef struct sampling {
    crease_context *context;
    size_t rows, most;
    size_t layer; /* of the rows, `most` in all: one point is taken from each */
    size_t next;  /* number of the point that is taken next */
    crease_cloud *sample;
} sampling;

size_t crease_sample_number(const crease_context *context, size_t rows, size_t most, size_t layer)
{
    const size_t begin = rows * layer / most, end = rows * (layer + 1) / most; /* below 2^64 */
    return begin +
        crease_random_below(crease_context_seed(context), STREAM, layer, (uint32_t)(end - begin));
}

static void choose_next(sampling *run)
{
    run->next = crease_sample_number(run->context, run->rows, run->most, run->layer);
}

static void take(sampling *run, const crease_cloud *cloud, size_t number)
{
    crease_cloud *const sample = run->sample;
    sample->coordinate_type = cloud->coordinate_type;
    while (run->layer < run->most && run->next < number + cloud->count) {
        memcpy(sample->points + 3 * sample->count++, cloud->points + 3 * (run->next - number),
            3 * sizeof(double));
        if (++run->layer < run->most)
            choose_next(run);
    }
}

static crease_status take_all(sampling *run, crease_rows *rows, size_t at_once, size_t *total)
{
    crease_status status = CREASE_OK;
    *total = 0;
    for (size_t at = 0; at < run->rows && status == CREASE_OK; at += at_once) {
        const size_t left = run->rows - at;
        crease_cloud *cloud = NULL;
        status = crease_rows_read(run->context, rows, at, left < at_once ? left : at_once, &cloud);
        if (status == CREASE_OK) {
            take(run, cloud, *total);
            *total += cloud->count;
        }
        crease_cloud_free(cloud);
        crease_progress(run->context, (double)at / (double)run->rows);
        if (status == CREASE_OK && crease_cancelled(run->context))
            status = crease_fail_cancelled(run->context);
    }
    return status;
}

crease_status crease_sample_take(crease_context *context, crease_rows *rows, size_t at_once,
    size_t most, crease_cloud **out, size_t *total)
{
    const size_t count = crease_rows_count(rows);
    sampling run = {.context = context, .rows = count, .most = most < count ? most : count};
    *out = NULL;
    crease_stage(context, "reading");
    run.sample = crease_allocate(context, 1, sizeof *run.sample);
    if (!run.sample)
        return CREASE_ERROR_NO_MEMORY;
    run.sample->points = crease_allocate(context, run.most, 3 * sizeof *run.sample->points);
    crease_status status = run.sample->points ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK && run.most > 0)
        choose_next(&run);
    if (status == CREASE_OK)
        status = take_all(&run, rows, at_once, total);
    if (status == CREASE_OK)
        *out = run.sample;
    else
        crease_cloud_free(run.sample);
    return status;
}
