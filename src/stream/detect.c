/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* From file to file: regions and creases of a sample; the cloud cut into parts; every part scored
 * and labelled; all written in the order of the input. */
#include "base/memory.h"
#include "cloud/cloud.h"
#include "crease/crease_stream.h"
#include "crease/network.h"
#include "stream/labelling.h"
#include "stream/part.h"
#include "stream/results.h"
#include "stream/sample.h"
#include "write/cloud.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    LEAST_MEMORY = 8000000,
    FIXED = 4 << 20,
    MOST_PARTS = 1 << 13,
    MOST_AT_ONCE = 1 << 16,
    LEAST_AT_ONCE = 1 << 8,
    IN_MEMORY = 500, /* bytes for each point of a cloud that is held, to find its regions */
    KEPT = 90,       /* bytes for each point of the sample, to label others by it */
    LEAST_SAMPLE = 2000
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
    crease_labelling labelling;
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

/* A row takes its bytes twice, as it is read and as a cloud; then what is made of it. */
static size_t rows_at_once(const crease_rows *rows, size_t memory)
{
    const size_t most = memory / 16 / (3 * crease_rows_size(rows) + 200);
    return most < LEAST_AT_ONCE ? LEAST_AT_ONCE : most < MOST_AT_ONCE ? most : MOST_AT_ONCE;
}

/* ----------------------------------------------------------------------------------- sample -- */

static crease_status survey_sample(
    work *run, size_t most, crease_regions **regions, crease_network **network)
{
    crease_context *const context = run->context;
    crease_cloud *sample = NULL;
    crease_status status =
        crease_sample_take(context, run->rows, run->at_once, most, &sample, &run->summary->count);
    if (status == CREASE_OK) {
        run->summary->sampled = sample->count;
        status = crease_regions_find(context, sample, &run->options->regions, regions);
    }
    crease_cloud_free(sample);
    if (status == CREASE_OK)
        status = crease_network_find(context, *regions, NULL, network);
    if (status == CREASE_OK)
        crease_regions_slim(*regions);
    return status;
}

/* Of a smaller sample when the regions of this one take more than is thought. */
static crease_status survey(work *run, crease_regions **regions, crease_network **network)
{
    const size_t memory = run->options->memory - FIXED;
    const size_t rows = crease_rows_count(run->rows), fitting = memory / 8 * 7 / IN_MEMORY;
    size_t most = fitting < rows ? fitting : rows;
    crease_status status = survey_sample(run, most, regions, network);
    while (status == CREASE_ERROR_NO_MEMORY && most / 2 >= LEAST_SAMPLE) {
        most /= 2;
        crease_regions_free(*regions);
        *regions = NULL;
        status = survey_sample(run, most, regions, network);
    }
    if (status == CREASE_OK)
        status = crease_labelling_create(
            run->context, *regions, *network, run->summary->count, &run->labelling);
    return status;
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
        status = crease_label(run->context, &run->labelling, &held->piece, held->tree, &found);
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
    crease_labelling_begin(&run->labelling);
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

typedef struct writing {
    work *run;
    crease_output *output;
    crease_type normal_type;
    crease_result *results;
    float *variance;
    uint8_t *features;
    int32_t *regions;
    size_t number;
    bool begun;
} writing;

static crease_status write_rows(writing *to, const crease_cloud *rows, const char *path)
{
    crease_context *const context = to->run->context;
    crease_cloud *cloud = NULL;
    const crease_field fields[] = {{"variance", CREASE_TYPE_FLOAT32, to->variance},
        {"feature", CREASE_TYPE_UINT8, to->features}, {"region", CREASE_TYPE_INT32, to->regions}};
    crease_status status =
        crease_results_next(context, &to->run->results, to->number, rows->count, to->results);
    for (size_t i = 0; i < rows->count && status == CREASE_OK; i++) {
        to->variance[i] = to->results[i].variance;
        to->features[i] = (uint8_t)to->results[i].feature;
        to->regions[i] = to->results[i].region;
    }
    if (status == CREASE_OK)
        status = crease_cloud_with_fields(context, rows, fields, 3, &cloud);
    if (status == CREASE_OK && !to->begun) {
        status = crease_cloud_check_names(context, cloud, path);
        crease_cloud_write_ply_header(to->output, cloud, to->run->parts.count, to->normal_type);
        to->begun = true;
    }
    if (status == CREASE_OK)
        crease_cloud_write_records(to->output, cloud, to->normal_type);
    to->number += rows->count;
    crease_cloud_free(cloud);
    return status;
}

static crease_status write_all(writing *to, const char *path)
{
    work *const run = to->run;
    const size_t rows = crease_rows_count(run->rows);
    crease_status status = CREASE_OK;
    for (size_t at = 0; at < rows && status == CREASE_OK && !crease_output_failed(to->output);
         at += run->at_once) {
        const size_t left = rows - at;
        crease_cloud *cloud = NULL;
        status = crease_rows_read(
            run->context, run->rows, at, left < run->at_once ? left : run->at_once, &cloud);
        if (status == CREASE_OK)
            status = write_rows(to, cloud, path);
        crease_cloud_free(cloud);
        crease_progress(run->context, (double)at / (double)rows);
    }
    return status;
}

static crease_status write_output(work *run, const char *path)
{
    crease_context *const context = run->context;
    writing to = {.run = run,
        .normal_type = run->parts.wide_normals ? CREASE_TYPE_FLOAT64 : CREASE_TYPE_FLOAT32};
    crease_stage(context, "writing");
    to.results = crease_allocate(context, run->at_once, sizeof *to.results);
    to.variance = crease_allocate(context, run->at_once, sizeof *to.variance);
    to.features = crease_allocate(context, run->at_once, sizeof *to.features);
    to.regions = crease_allocate(context, run->at_once, sizeof *to.regions);
    crease_status status =
        to.results && to.variance && to.features && to.regions ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK)
        status = crease_output_open(context, path, &to.output);
    if (status == CREASE_OK)
        status = crease_output_close(context, to.output, write_all(&to, path));
    free(to.results);
    free(to.variance);
    free(to.features);
    free(to.regions);
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

static crease_status check(
    crease_context *context, const crease_stream_options *options, const char *output)
{
    static const char *const extensions[] = {"ply"};
    size_t choice = 0;
    if (options->memory < LEAST_MEMORY)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "memory: a limit of %zu bytes; give %d or more", options->memory, (int)LEAST_MEMORY);
    return crease_output_choose(context, output, extensions, 1, &choice);
}

static crease_status detect(
    work *run, const char *output, crease_regions **regions, crease_network **network)
{
    const size_t memory = run->options->memory - FIXED;
    run->at_once = rows_at_once(run->rows, memory);
    crease_status status = survey(run, regions, network);
    if (status != CREASE_OK)
        return status;
    run->most = (memory - KEPT * run->summary->sampled) / CREASE_PART_POINT;
    run->summary->spacing = run->labelling.spacing;
    status = attempt(run);
    if (status == CREASE_OK)
        status = write_output(run, output);
    if (status == CREASE_OK)
        crease_labelling_settle(&run->labelling, *regions, *network);
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
    crease_status status = check(context, &chosen, output);
    if (status == CREASE_OK)
        status = crease_rows_open(context, input, &chosen.read, &run.rows);
    if (status == CREASE_OK) {
        run.counts = crease_allocate(context, 1, sizeof *run.counts);
        status = run.counts ? detect(&run, output, regions, network) : CREASE_ERROR_NO_MEMORY;
    }
    crease_labelling_free(&run.labelling);
    crease_results_free(&run.results);
    crease_parts_free(&run.parts);
    crease_rows_close(run.rows);
    free(run.counts);
    if (status != CREASE_OK) {
        crease_network_free(*network);
        crease_regions_free(*regions);
        *network = NULL;
        *regions = NULL;
    }
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
        *bytes = *count * (IN_MEMORY + crease_rows_size(rows));
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
        status =
            crease_sample_take(context, rows, rows_at_once(rows, LEAST_MEMORY), most, out, total);
    crease_rows_close(rows);
    return status;
}
