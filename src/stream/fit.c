/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A sheet of the points of a file: from a sample, the size of its rectangle, the sum over all
 * points in one round or two, and their distances. */
#include "stream/fit.h"
#include "base/memory.h"
#include "cloud/cloud.h"
#include "stream/sample.h"

#include <math.h>
#include <stdlib.h>

enum {
    LEAST_MEMORY = 8000000,
    FOR_POINT = 400,    /* bytes, of those that are worked on together */
    FOR_SAMPLED = 1000, /* bytes for a point of the sample */
    FOR_UNKNOWN = 1100, /* bytes for a control point of a bicubic net */
    MOST_SAMPLED = 200000,
    LEAST_SAMPLED = 2000,
    MOST_AT_ONCE = 1 << 20,
    LEAST_AT_ONCE = 1 << 12,
    BINS = 8192,
    BINS_OF_A_FACTOR_OF_2 = 128
};

typedef struct work {
    crease_context *context;
    crease_rows *rows;
    size_t at_once;
    crease_sheet_sum *sum;
    crease_fit_hands hands; /* who goes through the points */
    double *distances;
    size_t *bins; /* of the logarithms of the distances */
    crease_fit_stream_summary *summary;
} work;

crease_fit_stream_options crease_fit_stream_options_default(void)
{
    return (crease_fit_stream_options){.sheet = crease_sheet_options_default(),
        .read = crease_read_options_default(),
        .memory = (size_t)1 << 30};
}

void crease_fit_enclose(const crease_cloud *batch, double low[3], double high[3])
{
    for (size_t i = 0; i < batch->count; i++)
        for (size_t c = 0; c < 3; c++) {
            low[c] = fmin(low[c], batch->points[3 * i + c]);
            high[c] = fmax(high[c], batch->points[3 * i + c]);
        }
}

static crease_status each_batch(
    work *run, const char *stage, crease_status (*body)(work *run, const crease_cloud *batch))
{
    const size_t count = crease_rows_count(run->rows);
    crease_status status = CREASE_OK;
    crease_stage(run->context, stage);
    for (size_t at = 0; at < count && status == CREASE_OK; at += run->at_once) {
        const size_t left = count - at;
        crease_cloud *batch = NULL;
        status = crease_rows_read(
            run->context, run->rows, at, left < run->at_once ? left : run->at_once, &batch);
        if (status == CREASE_OK)
            status = body(run, batch);
        crease_cloud_free(batch);
        crease_progress(run->context, (double)at / (double)count);
        if (status == CREASE_OK && crease_cancelled(run->context))
            status = crease_fail_cancelled(run->context);
    }
    return status;
}

/* ------------------------------------------------------------------------------- by this process
 * --
 */

static crease_status widen(work *run, const crease_cloud *batch)
{
    crease_fit_stream_summary *const s = run->summary;
    crease_fit_enclose(batch, s->lowest, s->highest);
    return crease_sheet_sum_widen(run->context, run->sum, batch->points, batch->count);
}

static crease_status widen_all(void *user, crease_sheet_sum *sum, crease_fit_stream_summary *s)
{
    (void)sum, (void)s;
    return each_batch(user, "reading", widen);
}

static crease_status add(work *run, const crease_cloud *batch)
{
    return crease_sheet_sum_add(run->context, run->sum, batch->points, batch->count);
}

static crease_status add_all(void *user, crease_sheet_sum *sum)
{
    (void)sum;
    return each_batch(user, "adding points", add);
}

static void tell(work *run, const double *distances, size_t count);

static crease_status measure(work *run, const crease_cloud *batch)
{
    const crease_status status = crease_sheet_sum_distances(
        run->context, run->sum, batch->points, batch->count, run->distances);
    if (status == CREASE_OK)
        tell(run, run->distances, batch->count);
    return status;
}

static crease_status measure_all(
    void *user, crease_sheet_sum *sum, crease_fit_told *take, void *taking)
{
    (void)sum, (void)take, (void)taking;
    work *const run = user;
    run->distances = crease_allocate(run->context, run->at_once, sizeof *run->distances);
    return run->distances ? each_batch(run, "measuring", measure) : CREASE_ERROR_NO_MEMORY;
}

/* ------------------------------------------------------------------------------------- distances
 * --
 */

/* Bins are for 1e-19 to 1; what is less or more is in the first or last. */
static size_t bin_of(double distance, double size)
{
    const double bin = BINS + BINS_OF_A_FACTOR_OF_2 * log2(distance / size);
    return bin > 0.0 ? (bin < BINS - 1 ? (size_t)bin : BINS - 1) : 0;
}

static double size_of(const crease_fit_stream_summary *s)
{
    return hypot(hypot(s->highest[0] - s->lowest[0], s->highest[1] - s->lowest[1]),
        s->highest[2] - s->lowest[2]);
}

static void tell(work *run, const double *distances, size_t count)
{
    crease_fit_stream_summary *const s = run->summary;
    const double size = size_of(s);
    for (size_t i = 0; i < count; i++) {
        const double distance = fabs(distances[i]);
        s->mean += distances[i];
        s->rms += distance * distance;
        s->most = fmax(s->most, distance);
        run->bins[bin_of(distance, size)]++;
    }
}

static void take_distances(void *user, const double *distances, size_t count)
{
    tell(user, distances, count);
}

/* The distance that 95 % of the points have at most: the upper end of its bin. */
static double quantile(const work *run)
{
    const crease_fit_stream_summary *const s = run->summary;
    size_t below = 0, bin = 0;
    while (bin + 1 < BINS && (double)(below += run->bins[bin]) < 0.95 * (double)s->count)
        bin++;
    const double end = size_of(s) * exp2(((double)bin + 1.0 - BINS) / BINS_OF_A_FACTOR_OF_2);
    return fmin(end, s->most);
}

static crease_status summarise(work *run)
{
    crease_fit_stream_summary *const s = run->summary;
    run->bins = crease_allocate(run->context, BINS, sizeof *run->bins);
    crease_status status = run->bins
        ? run->hands.measure(run->hands.user, run->sum, take_distances, run)
        : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK) {
        s->mean /= (double)s->count;
        s->rms = sqrt(s->rms / (double)s->count);
        s->p95 = quantile(run);
    }
    return status;
}

static crease_status solve(work *run, crease_sheet **out)
{
    crease_status status = CREASE_OK;
    do {
        crease_sheet_free(*out);
        *out = NULL;
        status = run->hands.add(run->hands.user, run->sum);
        if (status == CREASE_OK)
            status = crease_sheet_sum_solve(run->context, run->sum, out);
    } while (status == CREASE_OK && crease_sheet_sum_wants_more(run->sum));
    return status;
}

/* What the limit leaves beside the net, in bytes. */
static crease_status budget(
    crease_context *context, const crease_fit_stream_options *o, size_t *left)
{
    const double order = o->sheet.order / 4.0;
    const double net =
        (double)o->sheet.net[0] * (double)o->sheet.net[1] * FOR_UNKNOWN * order * order;
    const double need = net + (double)LEAST_SAMPLED * FOR_SAMPLED + LEAST_AT_ONCE * FOR_POINT;
    if (o->memory < LEAST_MEMORY || need > (double)o->memory)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "memory: a net of %zu x %zu control points takes about %.3g MB; the limit leaves %.3g; "
            "give more, or ask for a smaller net",
            o->sheet.net[0], o->sheet.net[1], fmax(need, LEAST_MEMORY) / 1e6,
            (double)o->memory / 1e6);
    *left = o->memory - (size_t)net;
    return CREASE_OK;
}

static size_t within(size_t value, size_t least, size_t most)
{
    return value < least ? least : value > most ? most : value;
}

static crease_status fit(work *run, const crease_fit_stream_options *o, size_t left,
    crease_cloud **sample, crease_sheet **out)
{
    crease_context *const context = run->context;
    const size_t sampled = within(left / 4 / FOR_SAMPLED, LEAST_SAMPLED, MOST_SAMPLED);
    run->at_once = within(
        left / 2 / (FOR_POINT + 3 * crease_rows_size(run->rows)), LEAST_AT_ONCE, MOST_AT_ONCE);
    crease_status status =
        crease_sample_take(context, run->rows, run->at_once, sampled, sample, &run->summary->count);
    if (status != CREASE_OK)
        return status;
    run->summary->sampled = crease_cloud_count(*sample);
    status = crease_sheet_sum_create(context, *sample, &o->sheet, &run->sum);
    if (status == CREASE_OK && run->hands.begin)
        status = run->hands.begin(run->hands.user, crease_rows_count(run->rows), run->at_once);
    if (status == CREASE_OK)
        status = run->hands.widen(run->hands.user, run->sum, run->summary);
    if (status == CREASE_OK)
        status = solve(run, out);
    return status == CREASE_OK ? summarise(run) : status;
}

crease_status crease_sheet_fit_stream(crease_context *context, const char *input,
    const crease_fit_stream_options *options, crease_fit_stream_summary *summary,
    crease_cloud **sample, crease_sheet **out)
{
    return crease_sheet_fit_stream_by(context, input, options, NULL, summary, sample, out);
}

crease_status crease_sheet_fit_stream_by(crease_context *context, const char *input,
    const crease_fit_stream_options *options, const crease_fit_hands *hands,
    crease_fit_stream_summary *summary, crease_cloud **sample, crease_sheet **out)
{
    const crease_fit_stream_options chosen =
        options ? *options : crease_fit_stream_options_default();
    *summary = (crease_fit_stream_summary){
        .lowest = {INFINITY, INFINITY, INFINITY}, .highest = {-INFINITY, -INFINITY, -INFINITY}};
    *sample = NULL;
    *out = NULL;
    size_t left = 0;
    work run = {.context = context, .summary = summary};
    run.hands = hands
        ? *hands
        : (crease_fit_hands){
              .user = &run, .widen = widen_all, .add = add_all, .measure = measure_all};
    crease_status status = budget(context, &chosen, &left);
    if (status == CREASE_OK)
        status = crease_rows_open(context, input, &chosen.read, &run.rows);
    if (status == CREASE_OK)
        status = fit(&run, &chosen, left, sample, out);
    free(run.distances);
    free(run.bins);
    crease_sheet_sum_free(run.sum);
    crease_rows_close(run.rows);
    if (status != CREASE_OK) {
        crease_cloud_free(*sample);
        crease_sheet_free(*out);
        *sample = NULL;
        *out = NULL;
    }
    return status;
}
