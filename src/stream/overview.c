/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "stream/overview.h"

#include "cloud/cloud.h"

enum { MOST_AT_ONCE = 1 << 16, LEAST_AT_ONCE = 1 << 8, LEAST_SAMPLE = 2000 };

/* A row takes its bytes twice, as it is read and as a cloud; then what is made of it. */
size_t crease_overview_at_once(size_t row_size, size_t memory)
{
    const size_t most = memory / 16 / (3 * row_size + 200);
    return most < LEAST_AT_ONCE ? LEAST_AT_ONCE : most < MOST_AT_ONCE ? most : MOST_AT_ONCE;
}

size_t crease_overview_most(size_t rows, size_t memory)
{
    const size_t fitting = (memory - CREASE_STREAM_FIXED) / 8 * 7 / CREASE_STREAM_HELD;
    return fitting < rows ? fitting : rows;
}

static void forget(crease_overview *overview)
{
    crease_network_free(overview->network);
    crease_regions_free(overview->regions);
    overview->network = NULL;
    overview->regions = NULL;
}

static crease_status find(crease_context *context, const crease_stream_options *options,
    size_t most, crease_overview_draw *draw, void *user, crease_overview *out)
{
    crease_cloud *sample = NULL;
    crease_status status = draw(context, user, most, &sample, &out->total);
    if (status == CREASE_OK) {
        out->sampled = sample->count;
        status = crease_regions_find(context, sample, &options->regions, &out->regions);
    }
    crease_cloud_free(sample);
    if (status == CREASE_OK)
        status = crease_network_find(context, out->regions, NULL, &out->network);
    if (status == CREASE_OK)
        crease_regions_slim(out->regions);
    else
        forget(out);
    return status;
}

crease_status crease_overview_find(crease_context *context, const crease_stream_options *options,
    size_t most, crease_overview_draw *draw, void *user, crease_overview *out)
{
    *out = (crease_overview){0};
    crease_status status = find(context, options, most, draw, user, out);
    while (status == CREASE_ERROR_NO_MEMORY && most / 2 >= LEAST_SAMPLE) {
        most /= 2;
        status = find(context, options, most, draw, user, out);
    }
    if (status == CREASE_OK)
        status = crease_labelling_create(
            context, out->regions, out->network, out->total, &out->labelling);
    if (status != CREASE_OK)
        forget(out);
    return status;
}

void crease_overview_release(
    crease_overview *overview, crease_regions **regions, crease_network **network)
{
    *regions = overview->regions;
    *network = overview->network;
    overview->regions = NULL;
    overview->network = NULL;
}

void crease_overview_free(crease_overview *overview)
{
    crease_labelling_free(&overview->labelling);
    forget(overview);
}
