/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A sheet of a file that all ranks but 0 read their shares of, batch about. Rank 0 has the sample,
 * the normal equations and the sheet; the others find the feet and weights of the points on the
 * sheet so far, and their distances from the last one. What they find goes into the equations batch
 * after batch in the order of the file, so that every sum has one order for any number of ranks. */
#define _XOPEN_SOURCE 700 /* realpath */

#include "stream/fit.h"
#include "base/memory.h"
#include "cloud/cloud.h"
#include "mpi/stages.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDEN, ADD, MEASURE };
/* In place of how many points a batch has: it could not be read, or worked on. */
#define FAILED UINT64_MAX

/* What rank 0 tells the others. */
typedef struct orders {
    int64_t pass;
    crease_read_options read;
    uint64_t rows, at_once, state; /* state: bytes that the sheet so far takes */
    char input[4096];
} orders;

typedef struct helping {
    const crease_mpi *mpi;
    orders given;
    crease_rows *rows;
    crease_sheet_sum *sum;
    double low[3], high[3]; /* of the own points */
    double *numbers;        /* of a batch */
} helping;

static size_t batches_of(const orders *given)
{
    return (given->rows + given->at_once - 1) / given->at_once;
}

static int rank_of(const crease_mpi *mpi, size_t batch)
{
    return 1 + (int)(batch % ((size_t)mpi->size - 1));
}

static size_t numbers_of(const orders *given)
{
    return given->pass == ADD ? CREASE_OBSERVED : given->pass == MEASURE ? 1 : 0;
}

/* Rank 0's state of the sheet for all. */
static crease_status tell_state(const crease_mpi *mpi, char *bytes, size_t size)
{
    const crease_status status = crease_mpi_agree(mpi, bytes ? CREASE_OK : CREASE_ERROR_NO_MEMORY);
    return status == CREASE_OK ? crease_mpi_tell(mpi, bytes, size) : status;
}

/* The rectangles and boxes of all ranks together. */
static crease_status enclose(
    const crease_mpi *mpi, crease_sheet_sum *sum, double low[3], double high[3])
{
    double below[3] = {sum->all.low[0], sum->all.low[1], 0.0};
    double above[3] = {sum->all.high[0], sum->all.high[1], 0.0};
    crease_status status = crease_mpi_enclose(mpi, below, above);
    if (status == CREASE_OK)
        status = crease_mpi_enclose(mpi, low, high);
    for (int d = 0; d < 2; d++) {
        sum->all.low[d] = below[d];
        sum->all.high[d] = above[d];
    }
    return status;
}

/* ------------------------------------------------------------------------------ the other ranks --
 */

static crease_status work_on(helping *run, const crease_cloud *batch)
{
    crease_context *const context = run->mpi->context;
    if (run->given.pass == ADD)
        return crease_sheet_sum_observe(
            context, run->sum, batch->points, batch->count, run->numbers);
    if (run->given.pass == MEASURE)
        return crease_sheet_sum_distances(
            context, run->sum, batch->points, batch->count, run->numbers);
    crease_fit_enclose(batch, run->low, run->high);
    return crease_sheet_sum_widen(context, run->sum, batch->points, batch->count);
}

/* A failed batch is sent, too, as one that has failed: rank 0 waits for it. */
static crease_status send_batch(
    const helping *run, crease_status status, size_t count, size_t numbers)
{
    const uint64_t told = status == CREASE_OK ? count : FAILED;
    const crease_status sent = crease_mpi_send(run->mpi, 0, &told, 1, sizeof told);
    if (sent != CREASE_OK || status != CREASE_OK)
        return sent != CREASE_OK ? sent : status;
    return crease_mpi_send(run->mpi, 0, run->numbers, count * numbers, sizeof *run->numbers);
}

static crease_status do_batch(helping *run, size_t batch, crease_status status)
{
    const orders *const given = &run->given;
    const size_t at = batch * given->at_once, left = given->rows - at;
    const size_t numbers = numbers_of(given);
    crease_cloud *cloud = NULL;
    if (status == CREASE_OK)
        status = crease_rows_read(run->mpi->context, run->rows, at,
            left < given->at_once ? left : given->at_once, &cloud);
    if (status == CREASE_OK)
        status = work_on(run, cloud);
    if (status != CREASE_ERROR_CANCELLED && numbers)
        status = send_batch(run, status, cloud ? cloud->count : 0, numbers);
    crease_cloud_free(cloud);
    return status;
}

static crease_status open_rows(helping *run)
{
    const crease_mpi *const mpi = run->mpi;
    const size_t room = numbers_of(&run->given) * run->given.at_once;
    run->numbers = crease_allocate(mpi->context, room, sizeof *run->numbers);
    const crease_status status = run->numbers ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    return crease_mpi_agree(mpi,
        status == CREASE_OK ? crease_mpi_rows_open(mpi, run->given.input, &run->given.read,
                                  run->given.rows, &run->rows)
                            : status);
}

static crease_status learn(helping *run)
{
    const crease_mpi *const mpi = run->mpi;
    crease_status status = crease_mpi_tell(mpi, &run->given, sizeof run->given);
    if (status != CREASE_OK)
        return status;
    char *const bytes = crease_allocate(mpi->context, run->given.state, 1);
    status = tell_state(mpi, bytes, run->given.state);
    if (status == CREASE_OK)
        status = crease_mpi_agree(mpi, crease_sheet_sum_unpack(mpi->context, bytes, &run->sum));
    free(bytes);
    return status == CREASE_OK ? open_rows(run) : status;
}

static crease_status help(helping *run)
{
    const crease_mpi *const mpi = run->mpi;
    crease_status status = learn(run);
    if (status != CREASE_OK)
        return status;
    for (size_t b = 0; b < batches_of(&run->given) && status != CREASE_ERROR_CANCELLED; b++)
        if (rank_of(mpi, b) == mpi->rank)
            status = do_batch(run, b, status);
    if (status == CREASE_ERROR_CANCELLED)
        return status;
    status = crease_mpi_agree(mpi, status);
    return status == CREASE_OK && run->given.pass == WIDEN
        ? enclose(mpi, run->sum, run->low, run->high)
        : status;
}

crease_status crease_mpi_fit_stage(const crease_mpi *mpi)
{
    helping run = {.mpi = mpi,
        .low = {INFINITY, INFINITY, INFINITY},
        .high = {-INFINITY, -INFINITY, -INFINITY}};
    const crease_status status = help(&run);
    crease_sheet_sum_free(run.sum);
    crease_rows_close(run.rows);
    free(run.numbers);
    return status;
}

/* --------------------------------------------------------------------------------------- rank 0 --
 */

typedef struct leading {
    crease_mpi *mpi;
    orders given;
    double *numbers; /* of a batch */
} leading;

static crease_status begin(void *user, size_t rows, size_t at_once)
{
    leading *const run = user;
    run->given.rows = rows;
    run->given.at_once = at_once;
    run->numbers =
        crease_allocate(run->mpi->context, at_once, CREASE_OBSERVED * sizeof *run->numbers);
    return run->numbers ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
}

static crease_status ask(leading *run, const crease_sheet_sum *sum, int64_t pass)
{
    crease_mpi *const mpi = run->mpi;
    crease_mpi_request request = {
        .stage = CREASE_MPI_FIT, .seed = crease_context_seed(mpi->context)};
    char *bytes = NULL;
    size_t size = 0;
    crease_status status = crease_sheet_sum_pack(mpi->context, sum, &bytes, &size);
    if (status != CREASE_OK)
        return status;
    run->given.pass = pass;
    run->given.state = size;
    status = crease_mpi_tell(mpi, &request, sizeof request);
    if (status == CREASE_OK)
        status = crease_mpi_tell(mpi, &run->given, sizeof run->given);
    if (status == CREASE_OK)
        status = tell_state(mpi, bytes, size);
    free(bytes);
    for (int agreed = 0; agreed < 2 && status == CREASE_OK; agreed++) /* unpacked; opened */
        status = crease_mpi_agree(mpi, CREASE_OK);
    return status;
}

/* Batches after one that has failed are received, and left at that. */
static crease_status receive(leading *run, crease_sheet_sum *sum, crease_fit_told *take, void *user)
{
    crease_mpi *const mpi = run->mpi;
    const size_t numbers = numbers_of(&run->given), batches = batches_of(&run->given);
    crease_status status = CREASE_OK, received = CREASE_OK;
    bool failed = false;
    for (size_t b = 0; b < batches && received == CREASE_OK; b++) {
        uint64_t count = 0;
        const int from = rank_of(mpi, b);
        received = crease_mpi_receive(mpi, from, &count, 1, sizeof count);
        failed = failed || count == FAILED;
        if (received == CREASE_OK && count != FAILED)
            received =
                crease_mpi_receive(mpi, from, run->numbers, count * numbers, sizeof *run->numbers);
        if (received != CREASE_OK || failed || status != CREASE_OK)
            continue;
        if (take)
            take(user, run->numbers, count);
        else
            status = crease_sheet_sum_take(mpi->context, sum, run->numbers, count);
        crease_progress(mpi->context, (double)b / (double)batches);
    }
    return received == CREASE_OK ? crease_mpi_agree(mpi, status) : received;
}

static crease_status widen(void *user, crease_sheet_sum *sum, crease_fit_stream_summary *summary)
{
    leading *const run = user;
    crease_stage(run->mpi->context, "reading");
    crease_status status = ask(run, sum, WIDEN);
    if (status == CREASE_OK)
        status = crease_mpi_agree(run->mpi, CREASE_OK);
    return status == CREASE_OK ? enclose(run->mpi, sum, summary->lowest, summary->highest) : status;
}

static crease_status add(void *user, crease_sheet_sum *sum)
{
    leading *const run = user;
    crease_stage(run->mpi->context, "adding points");
    crease_status status = crease_sheet_sum_begin(run->mpi->context, sum);
    if (status == CREASE_OK)
        status = ask(run, sum, ADD);
    return status == CREASE_OK ? receive(run, sum, NULL, NULL) : status;
}

static crease_status measure(void *user, crease_sheet_sum *sum, crease_fit_told *take, void *taking)
{
    leading *const run = user;
    crease_stage(run->mpi->context, "measuring");
    const crease_status status = ask(run, sum, MEASURE);
    return status == CREASE_OK ? receive(run, sum, take, taking) : status;
}

crease_status crease_mpi_sheet_fit_stream(crease_mpi *mpi, const char *input,
    const crease_fit_stream_options *options, crease_fit_stream_summary *summary,
    crease_cloud **sample, crease_sheet **out)
{
    leading run = {.mpi = mpi};
    const crease_fit_hands hands = {
        .user = &run, .begin = begin, .widen = widen, .add = add, .measure = measure};
    char *const path = realpath(input, NULL);
    run.given.read = options ? options->read : crease_read_options_default();
    strncpy(run.given.input, path ? path : input, sizeof run.given.input - 1);
    free(path);
    const crease_status status = crease_sheet_fit_stream_by(
        mpi->context, input, options, mpi->size > 1 ? &hands : NULL, summary, sample, out);
    free(run.numbers);
    return status;
}
