/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Rank 0's side of a file that every rank reads its own share of: it finds the regions and creases
 * of the sample while the others score their points, tells them what it found, and writes what they
 * send. */
#define _XOPEN_SOURCE 700 /* realpath */

#include "base/memory.h"
#include "cloud/cloud.h"
#include "mpi/orders.h"
#include "mpi/stages.h"
#include "stream/sample.h"
#include "write/output.h"

#include <stdlib.h>
#include <string.h>

enum { PIECE = 1 << 16 }; /* bytes that come at a time */

typedef struct leading {
    crease_mpi *mpi;
    crease_rows *rows;
    const crease_stream_options *options;
    const char *output;
    crease_mpi_orders orders;
    crease_mpi_intake intake;
    crease_overview overview;
    crease_stream_summary *summary;
    bool drawn; /* the sample that the others have sent is used up */
} leading;

static size_t at_once(const leading *run)
{
    return crease_overview_at_once(
        crease_rows_size(run->rows), run->options->memory - CREASE_STREAM_FIXED);
}

/* Whether the other ranks hold all points at once, and the sample leaves some out. */
static bool can_share(const leading *run)
{
    const size_t rows = crease_rows_count(run->rows), others = (size_t)run->mpi->size - 1;
    const size_t memory = run->options->memory - CREASE_STREAM_FIXED;
    const size_t sample = crease_overview_most(rows, run->options->memory);
    const size_t neighbours = (size_t)run->options->detect.neighbours;
    return others > 0 && sample < rows && rows / others > neighbours &&
        (rows / others + 1) * CREASE_MPI_STREAM_POINT <= memory;
}

static crease_status give_orders(leading *run, const char *input)
{
    crease_mpi *const mpi = run->mpi;
    crease_mpi_orders *const orders = &run->orders;
    crease_mpi_request request = {
        .stage = CREASE_MPI_STREAM, .seed = crease_context_seed(mpi->context)};
    char *const path = realpath(input, NULL);
    *orders = (crease_mpi_orders){.detect = run->options->detect,
        .read = run->options->read,
        .by_score = run->options->by_score,
        .rows = crease_rows_count(run->rows),
        .at_once = at_once(run),
        .sample = crease_overview_most(crease_rows_count(run->rows), run->options->memory)};
    strncpy(orders->input, path ? path : input, sizeof orders->input - 1);
    strncpy(orders->output, run->output, sizeof orders->output - 1);
    free(path);
    crease_status status = crease_mpi_tell(mpi, &request, sizeof request);
    if (status == CREASE_OK)
        status = crease_mpi_tell(mpi, orders, sizeof *orders);
    return status == CREASE_OK ? crease_mpi_agree(mpi, CREASE_OK) : status;
}

/* ----------------------------------------------------------------------------------- overview --
 */

/* First what the others send; should its regions take too much memory, a smaller one is read. */
static crease_status draw(
    crease_context *context, void *user, size_t most, crease_cloud **sample, size_t *total)
{
    leading *const run = user;
    *total = crease_mpi_intake_total(run->mpi, &run->intake);
    if (run->drawn)
        return crease_sample_take(context, run->rows, run->orders.at_once, most, sample, total);
    run->drawn = true;
    return crease_mpi_intake_sample(run->mpi, &run->intake, most, sample);
}

static crease_status tell_labelling(leading *run, crease_status status)
{
    crease_mpi *const mpi = run->mpi;
    char *bytes = NULL;
    size_t size = 0;
    if (status == CREASE_OK)
        status = crease_labelling_pack(mpi->context, &run->overview.labelling, &bytes, &size);
    status = crease_mpi_agree(mpi, status);
    uint64_t told = size;
    if (status == CREASE_OK)
        status = crease_mpi_tell(mpi, &told, sizeof told);
    if (status == CREASE_OK)
        status = crease_mpi_agree(mpi, CREASE_OK); /* whether all have room */
    if (status == CREASE_OK)
        status = crease_mpi_tell(mpi, bytes, size);
    free(bytes);
    return status;
}

/* Once the sample is drawn the others wait for what becomes of it, whatever that is. */
static crease_status survey(leading *run)
{
    crease_mpi *const mpi = run->mpi;
    crease_status status =
        crease_mpi_intake_read(mpi, run->rows, run->orders.at_once, &run->intake);
    if (status != CREASE_OK)
        return status;
    status = crease_overview_find(
        mpi->context, run->options, run->orders.sample, draw, run, &run->overview);
    return tell_labelling(run, status);
}

/* ---------------------------------------------------------------------------------- collecting --
 */

static crease_status count(leading *run)
{
    crease_labelling *const labelling = &run->overview.labelling;
    const size_t regions = run->overview.regions->region_count;
    uint64_t counts[2] = {0, 0};
    crease_labelling_begin(labelling);
    crease_status status = crease_mpi_agree(run->mpi, CREASE_OK); /* that all have labelled */
    if (status == CREASE_OK)
        status = crease_mpi_add(run->mpi, counts, 2);
    if (status == CREASE_OK)
        status = crease_mpi_add(run->mpi, labelling->sizes, regions);
    if (status == CREASE_OK)
        status = crease_mpi_add(run->mpi, labelling->squares, regions);
    run->summary->features = counts[0];
    run->summary->outliers = counts[1];
    return status == CREASE_OK ? crease_mpi_agree(run->mpi, CREASE_OK) : status;
}

/* Rank after rank, in the order of the file; each ends with nothing. */
static crease_status receive(leading *run, crease_output *output, char *piece)
{
    crease_mpi *const mpi = run->mpi;
    crease_status status = CREASE_OK;
    for (int r = 1; r < mpi->size && status == CREASE_OK; r++) {
        uint64_t size = 1;
        while (size > 0 && status == CREASE_OK) {
            status = crease_mpi_receive(mpi, r, &size, 1, sizeof size);
            if (status == CREASE_OK && size > 0)
                status = crease_mpi_receive(mpi, r, piece, size, 1);
            if (status == CREASE_OK && size > 0)
                crease_output_bytes(output, piece, size);
        }
        crease_progress(mpi->context, (double)r / mpi->size);
    }
    return status == CREASE_OK ? crease_mpi_agree(mpi, CREASE_OK) : status;
}

static crease_status write_output(leading *run)
{
    crease_mpi *const mpi = run->mpi;
    crease_output *output = NULL;
    char *const piece = crease_allocate(mpi->context, PIECE, 1);
    crease_stage(mpi->context, "writing");
    crease_status status = piece ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK)
        status = crease_output_open(mpi->context, run->output, &output);
    status = crease_mpi_agree(mpi, status);
    if (status == CREASE_OK)
        status = receive(run, output, piece);
    free(piece);
    return crease_output_close(mpi->context, output, status);
}

/* -------------------------------------------------------------------------------------- whole --
 */

static void summarise(leading *run)
{
    crease_stream_summary *const summary = run->summary;
    const size_t features = summary->features, outliers = summary->outliers;
    *summary = (crease_stream_summary){.count = run->overview.total,
        .sampled = run->overview.sampled,
        .parts = (size_t)run->mpi->size - 1,
        .features = features,
        .outliers = outliers,
        .spacing = run->overview.labelling.spacing};
    memcpy(summary->lowest, run->intake.low, sizeof run->intake.low);
    memcpy(summary->highest, run->intake.high, sizeof run->intake.high);
    crease_labelling_settle(&run->overview.labelling, run->overview.regions, run->overview.network);
}

static crease_status lead(
    leading *run, const char *input, crease_regions **regions, crease_network **network)
{
    crease_status status = give_orders(run, input);
    if (status == CREASE_OK)
        status = survey(run);
    if (status == CREASE_OK)
        status = count(run);
    if (status == CREASE_OK)
        status = write_output(run);
    if (status == CREASE_OK) {
        summarise(run);
        crease_overview_release(&run->overview, regions, network);
    }
    crease_overview_free(&run->overview);
    crease_mpi_intake_free(&run->intake);
    return status;
}

crease_status crease_mpi_detect_stream(crease_mpi *mpi, const char *input,
    const crease_stream_options *options, const char *output, crease_stream_summary *summary,
    crease_regions **regions, crease_network **network)
{
    const crease_stream_options chosen = options ? *options : crease_stream_options_default();
    leading run = {.mpi = mpi, .options = &chosen, .output = output, .summary = summary};
    *summary = (crease_stream_summary){0};
    *regions = NULL;
    *network = NULL;
    crease_status status = crease_stream_check(mpi->context, &chosen, output);
    if (status == CREASE_OK)
        status = crease_rows_open(mpi->context, input, &chosen.read, &run.rows);
    if (status == CREASE_OK)
        status = crease_scoring_check(mpi->context, crease_rows_count(run.rows), &chosen.detect);
    const bool shared = status == CREASE_OK && can_share(&run);
    if (shared)
        status = lead(&run, input, regions, network);
    crease_rows_close(run.rows);
    return shared || status != CREASE_OK
        ? status
        : crease_detect_stream(mpi->context, input, &chosen, output, summary, regions, network);
}
