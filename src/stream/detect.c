/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* From file to file: regions and creases of a sample; the cloud cut into parts; every part scored
 * and labelled; all written in the order of the input. */
#include "base/memory.h"
#include "cloud/cloud.h"
#include "crease/crease_stream.h"
#include "crease/network.h"
#include "stream/labelled.h"
#include "stream/overview.h"
#include "stream/part.h"
#include "stream/results.h"
#include "stream/sample.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    LEAST_MEMORY = 8000000,
    MOST_PARTS = 1 << 13,
    KEPT = 90 /* bytes for each point of the sample, to label others by it */
};

/* Points of others around a part are first thought to be this share of its own. */
static const double around = 0.2;

typedef struct work {
    crease_context *context;
    crease_rows *rows;
    const crease_stream_options *options;
    const char *scratch;
    size_t at_once; /* rows that are read together */
    size_t most;    /* points of a part that memory holds, those around it included */
    int k;          /* nearest points that a part must hold of each of its own */
    crease_overview overview;
    crease_parts parts;
    crease_results results;
    crease_scoring_counts *counts;
    double threshold;
    bool fits; /* all parts so far */
    crease_stream_summary *summary;
} work;

crease_stream_options crease_stream_options_default(void)
{
    return (crease_stream_options){.detect = crease_detect_options_default(),
        .regions = crease_regions_options_default(),
        .read = crease_read_options_default(),
        .memory = (size_t)1 << 30};
}

static crease_status draw(
    crease_context *context, void *user, size_t most, crease_cloud **sample, size_t *total)
{
    const work *const run = user;
    return crease_sample_take(context, run->rows, run->at_once, most, sample, total);
}

/* ------------------------------------------------------------------------------------ parts -- */

static crease_scoring scoring_of(const work *run, const crease_held *held)
{
    return (crease_scoring){.tree = held->tree,
        .piece = held->piece,
        .options = run->options->detect,
        .variance = held->variance};
}

static crease_status keep(
    work *run, size_t part, const crease_held *held, const crease_found *found)
{
    crease_result *const results =
        crease_allocate(run->context, run->parts.items[part].count, sizeof *results);
    size_t count = 0;
    if (!results)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < held->piece.count; i++)
        if (held->own[i]) {
            results[count++] = (crease_result){.number = held->numbers[i],
                .variance = (float)held->variance[i],
                .region = found->regions[i],
                .feature = found->features[i]};
            run->summary->features += found->features[i];
            run->summary->outliers += found->regions[i] < 0;
        }
    const crease_status status = crease_results_add(run->context, &run->results, results, count);
    free(results);
    return status;
}

static crease_status label_part(work *run, size_t part, crease_held *held)
{
    const crease_scoring scoring = scoring_of(run, held);
    crease_found found;
    crease_status status = crease_found_create(run->context, held->piece.count, &found);
    if (status == CREASE_OK)
        status =
            crease_label(run->context, &run->overview.labelling, &held->piece, held->tree, &found);
    if (status == CREASE_OK && run->options->by_score)
        status = crease_scoring_mark(
            run->context, &scoring, run->parts.count, run->threshold, found.features);
    if (status == CREASE_OK)
        status = keep(run, part, held, &found);
    crease_found_free(&found);
    return status;
}

/* Features by score are held against the scores around them: these are all known later. */
static crease_status score_part(work *run, size_t part, crease_held *held)
{
    const crease_scoring scoring = scoring_of(run, held);
    const crease_status status = crease_scoring_compute(run->context, &scoring, run->counts);
    if (status != CREASE_OK)
        return status;
    return run->options->by_score ? crease_held_store(run->context, &run->parts, part, held)
                                  : label_part(run, part, held);
}

static crease_status each_part(
    work *run, crease_status (*body)(work *run, size_t part, crease_held *held))
{
    crease_status status = CREASE_OK;
    for (size_t p = 0; p < run->parts.part_count && status == CREASE_OK && run->fits; p++) {
        crease_held held = {0};
        if (run->parts.items[p].count == 0)
            continue;
        status =
            crease_held_load(run->context, &run->parts, p, run->k, run->most, &held, &run->fits);
        if (status == CREASE_OK && run->fits)
            status = body(run, p, &held);
        crease_held_free(&held);
    }
    return status;
}

static crease_status compute(work *run)
{
    const crease_detect_options *const options = &run->options->detect;
    const size_t count = run->parts.count;
    memset(run->counts, 0, sizeof *run->counts);
    run->fits = true;
    run->summary->features = run->summary->outliers = 0;
    crease_labelling_begin(&run->overview.labelling);
    run->k = run->options->by_score ? crease_scoring_reach(count, options) : options->neighbours;
    crease_status status = each_part(run, score_part);
    if (status == CREASE_OK && run->fits)
        status = crease_scoring_decide(run->context, run->counts, options, &run->threshold);
    return status == CREASE_OK && run->fits && run->options->by_score ? each_part(run, label_part)
                                                                      : status;
}

/* Once more with twice the parts while some part and what is around it do not fit. */
static crease_status attempt(work *run)
{
    const size_t rows = run->summary->count;
    size_t parts = (size_t)((1 + around) * (double)rows / (double)run->most) + 1;
    crease_status status = crease_scoring_check(run->context, rows, &run->options->detect);
    for (run->fits = false; !run->fits && status == CREASE_OK; parts *= 2) {
        if (parts > MOST_PARTS ||
            (parts > 1 && rows / parts < (size_t)run->options->detect.neighbours))
            return crease_fail(run->context, CREASE_ERROR_NO_MEMORY,
                "memory: the limit of %zu bytes does not hold a part of the cloud and its "
                "neighbours; give more",
                run->options->memory);
        crease_parts_free(&run->parts);
        crease_results_free(&run->results);
        run->summary->parts = parts;
        status = crease_results_create(run->context, run->scratch, parts, &run->results);
        if (status == CREASE_OK)
            status = crease_parts_create(
                run->context, run->rows, run->at_once, parts, run->scratch, &run->parts);
        if (status == CREASE_OK)
            status = compute(run);
    }
    memcpy(run->summary->lowest, run->parts.low, sizeof run->parts.low);
    memcpy(run->summary->highest, run->parts.high, sizeof run->parts.high);
    return status;
}

/* ---------------------------------------------------------------------------------- output -- */

static crease_status write_all(work *run, crease_labelled *labelled)
{
    const size_t rows = crease_rows_count(run->rows);
    crease_status status = CREASE_OK;
    for (size_t at = 0, number = 0;
         at < rows && status == CREASE_OK && !crease_output_failed(labelled->output);
         at += run->at_once) {
        const size_t left = rows - at;
        crease_cloud *cloud = NULL;
        status = crease_rows_read(
            run->context, run->rows, at, left < run->at_once ? left : run->at_once, &cloud);
        if (status == CREASE_OK)
            status = crease_results_next(
                run->context, &run->results, number, cloud->count, labelled->results);
        if (status == CREASE_OK)
            status = crease_labelled_add(run->context, labelled, cloud);
        number += cloud ? cloud->count : 0;
        crease_cloud_free(cloud);
        crease_progress(run->context, (double)at / (double)rows);
    }
    return status;
}

static crease_status write_output(work *run, const char *path)
{
    crease_context *const context = run->context;
    const crease_labelled like = {.path = path,
        .count = run->parts.count,
        .normal_type = run->parts.wide_normals ? CREASE_TYPE_FLOAT64 : CREASE_TYPE_FLOAT32,
        .at_once = run->at_once};
    crease_labelled labelled;
    crease_stage(context, "writing");
    crease_status status = crease_labelled_create(context, &like, &labelled);
    if (status == CREASE_OK)
        status = crease_output_open(context, path, &labelled.output);
    if (status == CREASE_OK)
        status = crease_output_close(context, labelled.output, write_all(run, &labelled));
    crease_labelled_free(&labelled);
    return status;
}

/* ----------------------------------------------------------------------------------- whole -- */

static void folder_of(const char *path, char *folder, size_t size)
{
    const char *const slash = strrchr(path, '/');
    if (slash)
        snprintf(folder, size, "%.*s", slash == path ? 1 : (int)(slash - path), path);
    else
        snprintf(folder, size, ".");
}

crease_status crease_stream_check(
    crease_context *context, const crease_stream_options *options, const char *output)
{
    static const char *const extensions[] = {"ply"};
    size_t choice = 0;
    if (options->memory < LEAST_MEMORY)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "memory: a limit of %zu bytes; give %d or more", options->memory, (int)LEAST_MEMORY);
    return crease_output_choose(context, output, extensions, 1, &choice);
}

static crease_status detect(work *run, const char *output)
{
    const size_t memory = run->options->memory - CREASE_STREAM_FIXED;
    run->at_once = crease_overview_at_once(crease_rows_size(run->rows), memory);
    crease_status status = crease_overview_find(run->context, run->options,
        crease_overview_most(crease_rows_count(run->rows), run->options->memory), draw, run,
        &run->overview);
    if (status != CREASE_OK)
        return status;
    run->summary->count = run->overview.total;
    run->summary->sampled = run->overview.sampled;
    run->summary->spacing = run->overview.labelling.spacing;
    run->most = (memory - KEPT * run->summary->sampled) / CREASE_PART_POINT;
    status = attempt(run);
    if (status == CREASE_OK)
        status = write_output(run, output);
    if (status == CREASE_OK)
        crease_labelling_settle(
            &run->overview.labelling, run->overview.regions, run->overview.network);
    return status;
}

crease_status crease_detect_stream(crease_context *context, const char *input,
    const crease_stream_options *options, const char *output, crease_stream_summary *summary,
    crease_regions **regions, crease_network **network)
{
    const crease_stream_options chosen = options ? *options : crease_stream_options_default();
    char folder[4096];
    *summary = (crease_stream_summary){0};
    *regions = NULL;
    *network = NULL;
    folder_of(output, folder, sizeof folder);
    work run = {.context = context,
        .options = &chosen,
        .scratch = chosen.scratch ? chosen.scratch : folder,
        .parts = {.file = -1},
        .results = {.file = -1},
        .summary = summary};
    crease_status status = crease_stream_check(context, &chosen, output);
    if (status == CREASE_OK)
        status = crease_rows_open(context, input, &chosen.read, &run.rows);
    if (status == CREASE_OK) {
        run.counts = crease_allocate(context, 1, sizeof *run.counts);
        status = run.counts ? detect(&run, output) : CREASE_ERROR_NO_MEMORY;
    }
    crease_results_free(&run.results);
    crease_parts_free(&run.parts);
    crease_rows_close(run.rows);
    free(run.counts);
    if (status == CREASE_OK)
        crease_overview_release(&run.overview, regions, network);
    crease_overview_free(&run.overview);
    return status;
}

crease_status crease_stream_need(crease_context *context, const char *input,
    const crease_read_options *options, size_t *count, size_t *bytes)
{
    const crease_read_options chosen = options ? *options : crease_read_options_default();
    crease_rows *rows = NULL;
    const crease_status status = crease_rows_open(context, input, &chosen, &rows);
    if (status == CREASE_OK) {
        *count = crease_rows_count(rows);
        *bytes = *count * (CREASE_STREAM_HELD + crease_rows_size(rows));
    }
    crease_rows_close(rows);
    return status;
}

crease_status crease_cloud_read_sample(crease_context *context, const char *input,
    const crease_read_options *options, size_t most, crease_cloud **out, size_t *total)
{
    const crease_read_options chosen = options ? *options : crease_read_options_default();
    crease_rows *rows = NULL;
    *out = NULL;
    crease_status status = crease_rows_open(context, input, &chosen, &rows);
    if (status == CREASE_OK)
        status = crease_sample_take(context, rows,
            crease_overview_at_once(crease_rows_size(rows), LEAST_MEMORY), most, out, total);
    crease_rows_close(rows);
    return status;
}
