/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The other ranks' side of a file that every rank reads its own share of: they read it, sort it
 * along the Morton curve among themselves, score their points while rank 0 finds the regions of the
 * sample, label them, bring what they found back into the order of the file, and send it as it is
 * to be written. */
#include "base/memory.h"
#include "cloud/cloud.h"
#include "mpi/orders.h"
#include "mpi/share.h"
#include "mpi/stages.h"
#include "stream/labelled.h"
#include "write/output.h"

#include <stdlib.h>
#include <string.h>

enum { PIECE = 1 << 16 }; /* bytes that go at a time */

typedef struct helping {
    const crease_mpi *mpi;
    crease_mpi crew;
    crease_mpi_orders orders;
    crease_rows *rows;
    crease_mpi_intake intake;
    crease_mpi_share share;
    crease_tree *tree; /* of the share's points */
    double *variance;
    crease_scoring_counts *counts;
    double threshold;
    crease_regions *regions; /* of the sample, as far as labelling needs them */
    crease_network *network;
    crease_labelling labelling;
    crease_found found;
    crease_result *results; /* of the own rows, in their order */
    crease_output *output;
} helping;

/* ------------------------------------------------------------------------------------ reading --
 */

static crease_status open_rows(helping *run)
{
    const crease_mpi *const mpi = run->mpi;
    return crease_mpi_agree(mpi,
        crease_mpi_rows_open(
            mpi, run->orders.input, &run->orders.read, run->orders.rows, &run->rows));
}

static crease_status take_in(helping *run)
{
    const crease_mpi *const mpi = run->mpi;
    crease_status status = crease_mpi_tell(mpi, &run->orders, sizeof run->orders);
    if (status == CREASE_OK)
        status = open_rows(run);
    return status == CREASE_OK
        ? crease_mpi_intake_read(mpi, run->rows, run->orders.at_once, &run->intake)
        : status;
}

/* ------------------------------------------------------------------------------------ scoring --
 */

static crease_scoring scoring_of(const helping *run)
{
    return (crease_scoring){.tree = run->tree,
        .piece = run->share.piece,
        .options = run->orders.detect,
        .variance = run->variance};
}

static crease_status prepare(helping *run)
{
    crease_context *const context = run->mpi->context;
    const crease_piece *const piece = &run->share.piece;
    run->variance = crease_allocate(context, piece->count, sizeof *run->variance);
    run->counts = crease_allocate(context, 1, sizeof *run->counts);
    return run->variance && run->counts
        ? crease_tree_create(context, piece->points, piece->count, &run->tree)
        : CREASE_ERROR_NO_MEMORY;
}

static crease_status complete(helping *run)
{
    const crease_detect_options *const options = &run->orders.detect;
    const size_t total = crease_mpi_intake_total(run->mpi, &run->intake);
    const int reach =
        run->orders.by_score ? crease_scoring_reach(total, options) : options->neighbours;
    crease_status status = crease_mpi_parcels_sort(
        &run->crew, run->intake.low, run->intake.high, &run->intake.parcels);
    if (status == CREASE_OK)
        status = crease_mpi_share_create(&run->crew, &run->intake.parcels, reach, &run->share);
    return status == CREASE_OK ? crease_mpi_agree(&run->crew, prepare(run)) : status;
}

static crease_status score(helping *run)
{
    const crease_mpi *const crew = &run->crew;
    crease_context *const context = crew->context;
    crease_status status = complete(run);
    const crease_scoring scoring = scoring_of(run);
    if (status == CREASE_OK)
        status = crease_mpi_agree(crew, crease_scoring_compute(context, &scoring, run->counts));
    if (status == CREASE_OK)
        status =
            crease_mpi_add(crew, (uint64_t *)run->counts, sizeof *run->counts / sizeof(uint64_t));
    if (status == CREASE_OK) /* the same on all ranks */
        status = crease_scoring_decide(context, run->counts, &run->orders.detect, &run->threshold);
    return status == CREASE_OK && run->orders.by_score
        ? crease_mpi_share_exchange(crew, &run->share, run->variance, sizeof *run->variance)
        : status;
}

/* ----------------------------------------------------------------------------------- labelling --
 */

static crease_status learn_labelling(helping *run, crease_status status)
{
    const crease_mpi *const mpi = run->mpi;
    uint64_t size = 0;
    char *bytes = NULL;
    status = crease_mpi_agree(mpi, status);
    if (status == CREASE_OK)
        status = crease_mpi_tell(mpi, &size, sizeof size);
    if (status == CREASE_OK) {
        bytes = crease_allocate(mpi->context, size, 1);
        status = crease_mpi_agree(mpi, bytes ? CREASE_OK : CREASE_ERROR_NO_MEMORY);
    }
    if (status == CREASE_OK)
        status = crease_mpi_tell(mpi, bytes, size);
    if (status == CREASE_OK) /* what fails here is told with the labels */
        status = crease_labelling_unpack(
            mpi->context, bytes, &run->regions, &run->network, &run->labelling);
    else
        run->crew.communicator = MPI_COMM_NULL; /* all know of it */
    free(bytes);
    return status;
}

static crease_status label(helping *run)
{
    crease_context *const context = run->mpi->context;
    const crease_piece *const piece = &run->share.piece;
    const crease_scoring scoring = scoring_of(run);
    crease_status status = crease_found_create(context, piece->count, &run->found);
    if (status == CREASE_OK)
        status = crease_label(context, &run->labelling, piece, run->tree, &run->found);
    return status == CREASE_OK && run->orders.by_score
        ? crease_scoring_mark(context, &scoring, crease_mpi_intake_total(run->mpi, &run->intake),
              run->threshold, run->found.features)
        : status;
}

static crease_status count(helping *run)
{
    const size_t regions = run->regions->region_count;
    uint64_t counts[2] = {0, 0};
    for (size_t i = 0; i < run->share.piece.count; i++)
        if (run->share.own[i]) {
            counts[0] += run->found.features[i];
            counts[1] += run->found.regions[i] < 0;
        }
    crease_status status = crease_mpi_add(run->mpi, counts, 2);
    if (status == CREASE_OK)
        status = crease_mpi_add(run->mpi, run->labelling.sizes, regions);
    return status == CREASE_OK ? crease_mpi_add(run->mpi, run->labelling.squares, regions) : status;
}

/* ----------------------------------------------------------------------------------- returning --
 */

/* The rank of the crew that has read a point. */
static int reader_of(const helping *run, uint32_t number)
{
    int low = 0, high = run->crew.size - 1;
    while (low < high) {
        const int middle = low + (high - low) / 2;
        if (run->intake.first[middle + 2] <= number) /* rank 0 of all has read none */
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Own points stand in the order of their numbers, and so do those who have read them. */
static void list_results(const helping *run, crease_mpi_counts *counts, crease_result *out)
{
    const crease_mpi_share *const share = &run->share;
    size_t written = 0;
    for (size_t i = 0; i < share->piece.count; i++) {
        if (!share->own[i])
            continue;
        if (out)
            out[written++] = (crease_result){.number = share->numbers[i],
                .variance = (float)run->variance[i],
                .region = run->found.regions[i],
                .feature = run->found.features[i]};
        else
            counts->give[reader_of(run, share->numbers[i])]++;
    }
}

static crease_status order_results(helping *run, const crease_result *taken, size_t count)
{
    const uint64_t first = run->intake.first[run->mpi->rank];
    run->results = crease_allocate(run->mpi->context, count, sizeof *run->results);
    if (!run->results)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < count; i++)
        run->results[taken[i].number - first] = taken[i];
    return CREASE_OK;
}

static crease_status exchange(helping *run, crease_mpi_counts *counts)
{
    const crease_mpi *const crew = &run->crew;
    list_results(run, counts, NULL);
    crease_status status = crease_mpi_counts_settle(crew, counts);
    if (status != CREASE_OK)
        return status;
    crease_result *const given = crease_allocate(crew->context, counts->given, sizeof *given);
    crease_result *const taken = crease_allocate(crew->context, counts->taken, sizeof *taken);
    status = crease_mpi_agree(crew, given && taken ? CREASE_OK : CREASE_ERROR_NO_MEMORY);
    if (status == CREASE_OK) {
        list_results(run, counts, given);
        status = crease_mpi_exchange(crew, counts, given, taken, sizeof *given);
    }
    free(given);
    if (status == CREASE_OK)
        status = crease_mpi_agree(crew, order_results(run, taken, counts->taken));
    free(taken);
    return status;
}

static crease_status return_results(helping *run)
{
    crease_mpi_counts counts = {0};
    crease_status status =
        crease_mpi_agree(&run->crew, crease_mpi_counts_create(&run->crew, &counts));
    if (status == CREASE_OK)
        status = exchange(run, &counts);
    crease_mpi_counts_free(&counts);
    return status;
}

/* ------------------------------------------------------------------------------------- sending --
 */

static bool send_piece(void *user, const void *bytes, size_t size)
{
    const crease_mpi *const mpi = user;
    crease_status status = CREASE_OK;
    for (size_t at = 0; at < size && status == CREASE_OK; at += PIECE) {
        const uint64_t some = size - at < PIECE ? size - at : PIECE;
        status = crease_mpi_send(mpi, 0, &some, 1, sizeof some);
        if (status == CREASE_OK)
            status = crease_mpi_send(mpi, 0, (const char *)bytes + at, some, 1);
    }
    return status == CREASE_OK;
}

static crease_status write_rows(helping *run, crease_labelled *labelled)
{
    const crease_mpi_intake *const intake = &run->intake;
    crease_status status = CREASE_OK;
    size_t done = 0;
    for (size_t at = intake->begin; at < intake->end && status == CREASE_OK;
         at += intake->at_once) {
        const size_t left = intake->end - at;
        crease_cloud *cloud = NULL;
        status = crease_rows_read(run->mpi->context, run->rows, at,
            left < intake->at_once ? left : intake->at_once, &cloud);
        if (status == CREASE_OK) {
            memcpy(
                labelled->results, run->results + done, cloud->count * sizeof *labelled->results);
            status = crease_labelled_add(run->mpi->context, labelled, cloud);
            done += cloud->count;
        }
        crease_cloud_free(cloud);
    }
    return status;
}

/* The first one sends the header, too. */
static crease_status send_rows(helping *run)
{
    const crease_mpi *const mpi = run->mpi;
    const uint64_t end = 0;
    const crease_labelled like = {.path = run->orders.output,
        .count = mpi->rank == 1 ? crease_mpi_intake_total(mpi, &run->intake) : 0,
        .normal_type = run->intake.wide_normals ? CREASE_TYPE_FLOAT64 : CREASE_TYPE_FLOAT32,
        .at_once = run->intake.at_once};
    crease_labelled labelled;
    crease_status status = crease_labelled_create(mpi->context, &like, &labelled);
    if (status == CREASE_OK)
        status = crease_output_divert(mpi->context, send_piece, (void *)mpi, &labelled.output);
    if (status == CREASE_OK)
        status = crease_output_close(mpi->context, labelled.output, write_rows(run, &labelled));
    crease_labelled_free(&labelled);
    if (status != CREASE_ERROR_CANCELLED) {
        const crease_status sent = crease_mpi_send(mpi, 0, &end, 1, sizeof end);
        status = sent == CREASE_OK ? crease_mpi_agree(mpi, status) : sent;
    }
    return status;
}

/* --------------------------------------------------------------------------------------- whole --
 */

/* Where all know of a failure they return; while rank 0 finds the regions it does not: it is told
 * when it asks for what became of the scores. */
static crease_status help(helping *run)
{
    crease_status status = take_in(run);
    if (status != CREASE_OK)
        return status;
    status = crease_mpi_intake_sample(run->mpi, &run->intake, run->orders.sample, NULL);
    status = learn_labelling(run, status == CREASE_OK ? score(run) : status);
    if (run->crew.communicator == MPI_COMM_NULL)
        return status;
    status = crease_mpi_agree(run->mpi, status == CREASE_OK ? label(run) : status);
    if (status == CREASE_OK)
        status = count(run);
    if (status == CREASE_OK)
        status = crease_mpi_agree(run->mpi, return_results(run));
    if (status == CREASE_OK)
        status = crease_mpi_agree(run->mpi, CREASE_OK); /* that rank 0 can write */
    return status == CREASE_OK ? send_rows(run) : status;
}

crease_status crease_mpi_stream_stage(const crease_mpi *mpi)
{
    helping run = {.mpi = mpi, .crew = crease_mpi_crew(mpi)};
    const crease_status status = help(&run);
    crease_labelling_free(&run.labelling);
    crease_network_free(run.network);
    crease_regions_free(run.regions);
    crease_found_free(&run.found);
    crease_mpi_share_free(&run.share);
    crease_mpi_intake_free(&run.intake);
    crease_tree_free(run.tree);
    crease_rows_close(run.rows);
    free(run.variance);
    free(run.counts);
    free(run.results);
    return status;
}
