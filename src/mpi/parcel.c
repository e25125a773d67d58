/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Sorting by samples: every rank draws some of its points evenly, all learn of all of these, and by
 * them choose the same borders. Points with the key of a border are told apart by their numbers, so
 * that heaps of equal points are cut, too. */
#include "mpi/parcel.h"

#include "base/memory.h"
#include "space/morton.h"

#include <stdlib.h>
#include <string.h>

enum { SAMPLES = 512 }; /* of each rank */

size_t crease_mpi_first_of(const crease_mpi *mpi, size_t count, int rank)
{
    return count / (size_t)mpi->size * (size_t)rank +
        count % (size_t)mpi->size * (size_t)rank / (size_t)mpi->size;
}

/* -------------------------------------------------------------------------------- handing out --
 */

static void pack(const crease_mpi_cloud *cloud, size_t first, size_t count, crease_mpi_parcel *out)
{
    for (size_t i = 0; i < count; i++) {
        const size_t number = cloud->order ? cloud->order[first + i] : first + i;
        memcpy(out[i].point, cloud->points + 3 * number, sizeof out[i].point);
        out[i].number = (uint32_t)number;
        out[i].from = (uint32_t)i;
    }
}

/* The largest slice is rank 0's own or as large, but for one point. */
static crease_status hand_out(
    const crease_mpi *mpi, const crease_mpi_cloud *cloud, crease_mpi_parcel *spare)
{
    crease_status status = CREASE_OK;
    for (int r = 1; r < mpi->size && status == CREASE_OK; r++) {
        const size_t first = crease_mpi_first_of(mpi, cloud->count, r);
        const size_t count = crease_mpi_first_of(mpi, cloud->count, r + 1) - first;
        pack(cloud, first, count, spare);
        status = crease_mpi_send(mpi, r, spare, count, sizeof *spare);
    }
    return status;
}

crease_status crease_mpi_parcels_take(
    const crease_mpi *mpi, const crease_mpi_cloud *cloud, crease_mpi_parcels *out)
{
    const size_t first = crease_mpi_first_of(mpi, cloud->count, mpi->rank);
    const size_t count = crease_mpi_first_of(mpi, cloud->count, mpi->rank + 1) - first;
    crease_mpi_parcel *const own = crease_allocate(mpi->context, count + 1, sizeof *own);
    *out = (crease_mpi_parcels){own, count};
    crease_status status = crease_mpi_agree(mpi, own ? CREASE_OK : CREASE_ERROR_NO_MEMORY);
    if (status == CREASE_OK && mpi->rank > 0)
        status = crease_mpi_receive(mpi, 0, own, count, sizeof *own);
    if (status == CREASE_OK && mpi->rank == 0) {
        status = hand_out(mpi, cloud, own);
        pack(cloud, first, count, own);
    }
    return status;
}

/* ------------------------------------------------------------------------------------ sorting --
 */

/* A place on the Morton curve. */
typedef struct mark {
    uint64_t key, number;
} mark;

typedef struct sorting {
    const crease_mpi *mpi;
    crease_morton_frame frame;
    crease_mpi_parcels *parcels;
    mark *marks;     /* SAMPLES of each rank; then the first of them are the borders */
    size_t borders;  /* one less than ranks, or 0 when there are no points */
    uint32_t *ranks; /* of each point: where it goes */
    crease_mpi_counts counts;
    crease_mpi_parcel *given, *taken;
} sorting;

static int compare_marks(const void *a, const void *b)
{
    const mark *const x = a, *const y = b;
    if (x->key != y->key)
        return x->key < y->key ? -1 : 1;
    return (x->number > y->number) - (x->number < y->number);
}

static mark mark_of(const sorting *run, size_t i)
{
    const crease_mpi_parcel *const parcel = &run->parcels->items[i];
    return (mark){crease_morton_key(&run->frame, parcel->point), parcel->number};
}

/* Ranks with fewer points than samples leave some out: these come last. */
static crease_status choose_borders(sorting *run)
{
    const crease_mpi *const mpi = run->mpi;
    const size_t count = run->parcels->count, all = SAMPLES * (size_t)mpi->size;
    mark *const own = run->marks + SAMPLES * (size_t)mpi->rank;
    MPI_Request request;
    for (size_t s = 0; s < SAMPLES; s++)
        own[s] = s < count ? mark_of(run, count < SAMPLES ? s : count * s / SAMPLES)
                           : (mark){UINT64_MAX, UINT64_MAX};
    MPI_Iallgather(MPI_IN_PLACE, 0, MPI_UINT64_T, run->marks, 2 * SAMPLES, MPI_UINT64_T,
        mpi->communicator, &request);
    const crease_status status = crease_mpi_wait(mpi, &request);
    if (status != CREASE_OK)
        return status;
    qsort(run->marks, all, sizeof *run->marks, compare_marks);
    size_t known = all;
    while (known > 0 && run->marks[known - 1].number == UINT64_MAX)
        known--;
    run->borders = known > 0 ? (size_t)mpi->size - 1 : 0;
    for (size_t r = 0; r < run->borders; r++)
        run->marks[r] = run->marks[(r + 1) * known / (size_t)mpi->size];
    return status;
}

static void choose_ranks(sorting *run)
{
    for (size_t i = 0; i < run->parcels->count; i++) {
        const mark own = mark_of(run, i);
        size_t low = 0, high = run->borders; /* borders that are not after the point */
        while (low < high) {
            const size_t middle = low + (high - low) / 2;
            if (compare_marks(&run->marks[middle], &own) <= 0)
                low = middle + 1;
            else
                high = middle;
        }
        run->ranks[i] = (uint32_t)low;
        run->counts.give[low]++;
    }
}

/* Rank by rank; give_at is moved while it is filled, and set back. */
static void fill_given(sorting *run)
{
    int *const at = run->counts.give_at;
    for (size_t i = 0; i < run->parcels->count; i++)
        run->given[at[run->ranks[i]]++] = run->parcels->items[i];
    for (int r = 0; r < run->mpi->size; r++)
        at[r] -= run->counts.give[r];
}

/* The own points go before those of others come: there is no room for both. */
static crease_status move_points(sorting *run)
{
    const crease_mpi *const mpi = run->mpi;
    crease_mpi_parcels *const parcels = run->parcels;
    run->given = crease_allocate(mpi->context, parcels->count, sizeof *run->given);
    crease_status status = crease_mpi_agree(mpi, run->given ? CREASE_OK : CREASE_ERROR_NO_MEMORY);
    if (status != CREASE_OK)
        return status;
    fill_given(run);
    free(parcels->items);
    *parcels = (crease_mpi_parcels){NULL, 0};
    run->taken = crease_allocate(mpi->context, run->counts.taken + 1, sizeof *run->taken);
    status = crease_mpi_agree(mpi, run->taken ? CREASE_OK : CREASE_ERROR_NO_MEMORY);
    if (status == CREASE_OK)
        status = crease_mpi_exchange(mpi, &run->counts, run->given, run->taken, sizeof *run->taken);
    for (size_t i = 0; i < run->counts.taken && status == CREASE_OK; i++)
        run->taken[i].from = (uint32_t)i;
    *parcels = (crease_mpi_parcels){run->taken, run->counts.taken};
    return status;
}

static crease_status sort(sorting *run)
{
    const crease_mpi *const mpi = run->mpi;
    run->marks = crease_allocate(mpi->context, (size_t)mpi->size, SAMPLES * sizeof *run->marks);
    run->ranks = crease_allocate(mpi->context, run->parcels->count, sizeof *run->ranks);
    crease_status status = run->marks && run->ranks ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK)
        status = crease_mpi_counts_create(mpi, &run->counts);
    status = crease_mpi_agree(mpi, status);
    if (status == CREASE_OK)
        status = choose_borders(run);
    if (status != CREASE_OK)
        return status;
    choose_ranks(run);
    status = crease_mpi_counts_settle(mpi, &run->counts);
    return status == CREASE_OK ? move_points(run) : status;
}

crease_status crease_mpi_parcels_sort(
    const crease_mpi *mpi, const double low[3], const double high[3], crease_mpi_parcels *parcels)
{
    sorting run = {.mpi = mpi, .frame = crease_morton_frame_of(low, high), .parcels = parcels};
    const crease_status status = sort(&run);
    free(run.marks);
    free(run.ranks);
    free(run.given);
    crease_mpi_counts_free(&run.counts);
    return status;
}
