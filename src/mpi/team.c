/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "mpi/team.h"

#include "base/memory.h"

#include <limits.h>
#include <sched.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* Tests before a wait begins to sleep in between, and how long it then sleeps: short enough for
 * large messages, which move only while someone tests. */
enum { EAGER_TESTS = 2000, NANOSECONDS = 100000 };
enum { TAG = 1, PER_MESSAGE = 1 << 24 };

/* What must be alike on all machines, as text. */
static void describe_build(char text[64])
{
    const uint32_t order = 1;
    memset(text, 0, 64);
    snprintf(text, 64, "%s %zu %zu %d", crease_version(), sizeof(crease_detect_options),
        sizeof(size_t), *(const unsigned char *)&order);
}

static crease_status check_builds(crease_mpi *mpi)
{
    char own[64], first[64];
    describe_build(own);
    memcpy(first, own, sizeof first);
    crease_status status = crease_mpi_tell(mpi, first, sizeof first);
    if (status == CREASE_OK && memcmp(own, first, sizeof own) != 0)
        status = crease_fail(mpi->context, CREASE_ERROR_UNSUPPORTED,
            "rank %d: runs another build (%s) than rank 0 (%s); install the same one everywhere",
            mpi->rank, own, first);
    return crease_mpi_agree(mpi, status);
}

crease_status crease_mpi_create(crease_context *context, MPI_Comm communicator, crease_mpi **out)
{
    *out = NULL;
    crease_mpi *mpi = crease_allocate(context, 1, sizeof *mpi);
    if (!mpi)
        return CREASE_ERROR_NO_MEMORY;
    mpi->context = context;
    MPI_Comm_dup(communicator, &mpi->communicator);
    MPI_Comm_rank(mpi->communicator, &mpi->rank);
    MPI_Comm_size(mpi->communicator, &mpi->size);
    mpi->crew = MPI_COMM_NULL;
    const crease_status status = check_builds(mpi);
    if (status == CREASE_OK) {
        MPI_Comm_split(mpi->communicator, mpi->rank > 0 ? 0 : MPI_UNDEFINED, mpi->rank, &mpi->crew);
        *out = mpi;
        return status;
    }
    MPI_Comm_free(&mpi->communicator);
    free(mpi);
    return status;
}

int crease_mpi_rank(const crease_mpi *mpi)
{
    return mpi->rank;
}

int crease_mpi_size(const crease_mpi *mpi)
{
    return mpi->size;
}

/* --------------------------------------------------------------------------------- talking -- */

crease_status crease_mpi_wait(const crease_mpi *mpi, MPI_Request *request)
{
    const struct timespec nap = {.tv_nsec = NANOSECONDS};
    int done = 0;
    for (long tests = 0;; tests++) {
        MPI_Test(request, &done, MPI_STATUS_IGNORE);
        if (done)
            return CREASE_OK;
        if (crease_cancelled(mpi->context))
            return crease_fail_cancelled(mpi->context);
        if (tests < EAGER_TESTS)
            sched_yield();
        else
            nanosleep(&nap, NULL);
    }
}

static crease_status sum(
    const crease_mpi *mpi, void *numbers, int count, MPI_Datatype type, MPI_Op operation)
{
    MPI_Request request;
    MPI_Iallreduce(MPI_IN_PLACE, numbers, count, type, operation, mpi->communicator, &request);
    return crease_mpi_wait(mpi, &request);
}

static crease_status tell_from(const crease_mpi *mpi, int root, void *bytes, size_t size)
{
    MPI_Request request;
    MPI_Ibcast(bytes, (int)size, MPI_BYTE, root, mpi->communicator, &request);
    return crease_mpi_wait(mpi, &request);
}

crease_status crease_mpi_tell(const crease_mpi *mpi, void *bytes, size_t size)
{
    crease_status status = CREASE_OK;
    for (size_t at = 0; at < size && status == CREASE_OK; at += PER_MESSAGE)
        status = tell_from(
            mpi, 0, (char *)bytes + at, size - at < PER_MESSAGE ? size - at : PER_MESSAGE);
    return status;
}

crease_status crease_mpi_add(const crease_mpi *mpi, uint64_t *numbers, size_t count)
{
    return sum(mpi, numbers, (int)count, MPI_UINT64_T, MPI_SUM);
}

crease_status crease_mpi_enclose(const crease_mpi *mpi, double low[3], double high[3])
{
    const crease_status status = sum(mpi, low, 3, MPI_DOUBLE, MPI_MIN);
    return status == CREASE_OK ? sum(mpi, high, 3, MPI_DOUBLE, MPI_MAX) : status;
}

/* What failed on one rank only is told with its number. */
static void describe_failure(const crease_mpi *mpi, crease_status status, char text[600])
{
    const char *const said = crease_context_message(mpi->context);
    const char *const sentence = *said ? said : crease_status_sentence(status);
    if (status == CREASE_ERROR_NO_MEMORY && mpi->size > 1)
        snprintf(text, 600, "rank %d: %s", mpi->rank, sentence);
    else
        snprintf(text, 600, "%s", sentence);
}

crease_status crease_mpi_agree(const crease_mpi *mpi, crease_status status)
{
    struct {
        int32_t status;
        char text[600];
    } failure = {.status = (int32_t)status};
    int first = status == CREASE_OK ? mpi->size : mpi->rank;
    crease_status told = sum(mpi, &first, 1, MPI_INT, MPI_MIN);
    if (told != CREASE_OK || first == mpi->size)
        return told;
    if (first == mpi->rank)
        describe_failure(mpi, status, failure.text);
    told = tell_from(mpi, first, &failure, sizeof failure);
    return told != CREASE_OK
        ? told
        : crease_fail(mpi->context, (crease_status)failure.status, "%s", failure.text);
}

/* --------------------------------------------------------------------------------- two ranks -- */

static MPI_Datatype type_of(size_t size)
{
    MPI_Datatype type;
    MPI_Type_contiguous((int)size, MPI_BYTE, &type);
    MPI_Type_commit(&type);
    return type;
}

crease_status crease_mpi_send(
    const crease_mpi *mpi, int to, const void *items, size_t count, size_t size)
{
    MPI_Datatype type = type_of(size);
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < count && status == CREASE_OK; i += PER_MESSAGE) {
        const int some = (int)(count - i < PER_MESSAGE ? count - i : PER_MESSAGE);
        MPI_Request request;
        MPI_Isend((const char *)items + i * size, some, type, to, TAG, mpi->communicator, &request);
        status = crease_mpi_wait(mpi, &request);
    }
    MPI_Type_free(&type);
    return status;
}

crease_status crease_mpi_receive(
    const crease_mpi *mpi, int from, void *items, size_t count, size_t size)
{
    MPI_Datatype type = type_of(size);
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < count && status == CREASE_OK; i += PER_MESSAGE) {
        const int some = (int)(count - i < PER_MESSAGE ? count - i : PER_MESSAGE);
        MPI_Request request;
        MPI_Irecv((char *)items + i * size, some, type, from, TAG, mpi->communicator, &request);
        status = crease_mpi_wait(mpi, &request);
    }
    MPI_Type_free(&type);
    return status;
}

/* --------------------------------------------------------------------------------- all to all --
 */

crease_status crease_mpi_counts_create(const crease_mpi *mpi, crease_mpi_counts *out)
{
    const size_t ranks = (size_t)mpi->size;
    *out = (crease_mpi_counts){0};
    int *const all = crease_allocate(mpi->context, 4 * ranks, sizeof *all);
    if (!all)
        return CREASE_ERROR_NO_MEMORY;
    out->give = all;
    out->give_at = all + ranks;
    out->take = all + 2 * ranks;
    out->take_at = all + 3 * ranks;
    return CREASE_OK;
}

void crease_mpi_counts_free(crease_mpi_counts *counts)
{
    free(counts->give);
    *counts = (crease_mpi_counts){0};
}

static size_t place(const int *counts, int *at, int ranks)
{
    size_t all = 0;
    for (int r = 0; r < ranks; r++) {
        at[r] = (int)all;
        all += (size_t)counts[r];
    }
    return all;
}

crease_status crease_mpi_counts_settle(const crease_mpi *mpi, crease_mpi_counts *counts)
{
    MPI_Request request;
    MPI_Ialltoall(counts->give, 1, MPI_INT, counts->take, 1, MPI_INT, mpi->communicator, &request);
    crease_status status = crease_mpi_wait(mpi, &request);
    if (status != CREASE_OK)
        return status;
    counts->given = place(counts->give, counts->give_at, mpi->size);
    counts->taken = place(counts->take, counts->take_at, mpi->size);
    if (counts->given > INT_MAX || counts->taken > INT_MAX)
        status = crease_fail(mpi->context, CREASE_ERROR_NO_MEMORY,
            "%zu items to send and %zu to receive are more than a message holds; use more ranks",
            counts->given, counts->taken);
    return crease_mpi_agree(mpi, status);
}

crease_status crease_mpi_exchange(const crease_mpi *mpi, const crease_mpi_counts *counts,
    const void *give, void *take, size_t size)
{
    MPI_Datatype type = type_of(size);
    MPI_Request request;
    MPI_Ialltoallv(give, counts->give, counts->give_at, type, take, counts->take, counts->take_at,
        type, mpi->communicator, &request);
    const crease_status status = crease_mpi_wait(mpi, &request);
    MPI_Type_free(&type);
    return status;
}
