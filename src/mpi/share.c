/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "mpi/share.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

enum { BOXES = 64 }; /* by which a rank tells the others where its points are */

static crease_status make_tree(
    crease_context *context, const crease_mpi_parcel *parcels, size_t count, crease_tree **out)
{
    double *const points = crease_allocate(context, count, 3 * sizeof *points);
    *out = NULL;
    if (!points)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < count; i++)
        memcpy(points + 3 * i, parcels[i].point, sizeof parcels[i].point);
    const crease_status status = crease_tree_create(context, points, count, out);
    free(points);
    return status;
}

/* --------------------------------------------------------------------------- others' points -- */

/* What one rank knows while it asks. */
typedef struct asking {
    const crease_mpi *mpi;
    const crease_tree *tree; /* of own points */
    crease_reaches reaches;  /* of its points */
    double *boxes;           /* BOXES x 6 for each rank */
    uint64_t *box_counts;    /* by rank */
    crease_mpi_counts asked; /* reaches sent and received */
    crease_reach *questions, *requests;
} asking;

static bool concerns(const asking *ask, const crease_reach *reach, int rank)
{
    const double *const boxes = ask->boxes + (size_t)rank * BOXES * 6;
    bool touched = false;
    for (size_t b = 0; b < ask->box_counts[rank] && !touched; b++)
        touched = crease_reach_touches(reach, boxes + 6 * b, boxes + 6 * b + 3);
    return touched;
}

/* The reaches that concern each rank; counts them, or writes them down where there is room. */
static void choose_questions(asking *ask)
{
    size_t written = 0;
    for (int r = 0; r < ask->mpi->size; r++) {
        int count = 0;
        for (size_t i = 0; i < ask->reaches.count && r != ask->mpi->rank; i++) {
            if (!concerns(ask, &ask->reaches.items[i], r))
                continue;
            if (ask->questions)
                ask->questions[written++] = ask->reaches.items[i];
            count++;
        }
        ask->asked.give[r] = count;
    }
}

static crease_status tell_boxes(asking *ask)
{
    const crease_mpi *const mpi = ask->mpi;
    const size_t mine = (size_t)mpi->rank;
    MPI_Request request;
    ask->box_counts[mine] = crease_tree_boxes(ask->tree, BOXES, ask->boxes + mine * BOXES * 6);
    crease_status status = crease_mpi_add(mpi, ask->box_counts, (size_t)mpi->size);
    if (status != CREASE_OK)
        return status;
    MPI_Iallgather(MPI_IN_PLACE, 0, MPI_DOUBLE, ask->boxes, BOXES * 6, MPI_DOUBLE,
        mpi->communicator, &request);
    return crease_mpi_wait(mpi, &request);
}

static crease_status send_questions(asking *ask)
{
    const crease_mpi *const mpi = ask->mpi;
    choose_questions(ask);
    crease_status status = crease_mpi_counts_settle(mpi, &ask->asked);
    if (status != CREASE_OK)
        return status;
    ask->questions = crease_allocate(mpi->context, ask->asked.given, sizeof *ask->questions);
    ask->requests = crease_allocate(mpi->context, ask->asked.taken, sizeof *ask->requests);
    status =
        crease_mpi_agree(mpi, ask->questions && ask->requests ? CREASE_OK : CREASE_ERROR_NO_MEMORY);
    if (status != CREASE_OK)
        return status;
    choose_questions(ask);
    return crease_mpi_exchange(
        mpi, &ask->asked, ask->questions, ask->requests, sizeof *ask->requests);
}

/* Counts the own points that each rank asked for, and lists them where there is room. */
static void choose_points(
    const asking *ask, uint8_t *wanted, crease_mpi_counts *counts, uint32_t *list)
{
    const size_t own = ask->tree->count;
    size_t written = 0;
    for (int r = 0; r < ask->mpi->size; r++) {
        const crease_reach *const requests = ask->requests + ask->asked.take_at[r];
        int count = 0;
        memset(wanted, 0, own);
        for (int i = 0; i < ask->asked.take[r]; i++)
            crease_reach_mark(&requests[i], ask->tree, wanted);
        for (size_t i = 0; i < own; i++) {
            if (wanted[i] && list)
                list[written++] = (uint32_t)i;
            count += wanted[i];
        }
        counts->give[r] = count;
    }
}

static crease_status choose_given(const asking *ask, crease_mpi_share *share)
{
    const crease_mpi *const mpi = ask->mpi;
    uint8_t *const wanted = crease_allocate(mpi->context, ask->tree->count, 1);
    crease_status status = crease_mpi_agree(mpi, wanted ? CREASE_OK : CREASE_ERROR_NO_MEMORY);
    if (status == CREASE_OK) {
        choose_points(ask, wanted, &share->counts, NULL);
        status = crease_mpi_counts_settle(mpi, &share->counts);
    }
    if (status == CREASE_OK) {
        share->give = crease_allocate(mpi->context, share->counts.given, sizeof *share->give);
        share->take = crease_allocate(mpi->context, share->counts.taken, sizeof *share->take);
        status =
            crease_mpi_agree(mpi, share->give && share->take ? CREASE_OK : CREASE_ERROR_NO_MEMORY);
    }
    if (status == CREASE_OK)
        choose_points(ask, wanted, &share->counts, share->give);
    free(wanted);
    return status;
}

static crease_status ask_all(asking *ask, int k, crease_mpi_share *share)
{
    const crease_mpi *const mpi = ask->mpi;
    const size_t ranks = (size_t)mpi->size;
    ask->boxes = crease_allocate(mpi->context, ranks, BOXES * 6 * sizeof *ask->boxes);
    ask->box_counts = crease_allocate(mpi->context, ranks, sizeof *ask->box_counts);
    crease_status status = ask->boxes && ask->box_counts ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK)
        status = crease_mpi_counts_create(mpi, &ask->asked);
    if (status == CREASE_OK)
        status = crease_mpi_counts_create(mpi, &share->counts);
    if (status == CREASE_OK)
        status = crease_reaches_find(mpi->context, ask->tree, k, &ask->reaches);
    status = crease_mpi_agree(mpi, status);
    if (status == CREASE_OK)
        status = tell_boxes(ask);
    if (status == CREASE_OK)
        status = send_questions(ask);
    return status == CREASE_OK ? choose_given(ask, share) : status;
}

/* Chooses which own points go to which rank. */
static crease_status choose_all(const crease_mpi *mpi, const crease_mpi_parcel *own, size_t count,
    int k, crease_mpi_share *share)
{
    crease_tree *tree = NULL;
    crease_status status = crease_mpi_agree(mpi, make_tree(mpi->context, own, count, &tree));
    asking ask = {.mpi = mpi, .tree = tree};
    if (status == CREASE_OK)
        status = ask_all(&ask, k, share);
    crease_reaches_free(&ask.reaches);
    free(ask.boxes);
    free(ask.box_counts);
    free(ask.questions);
    free(ask.requests);
    crease_mpi_counts_free(&ask.asked);
    crease_tree_free(tree);
    return status;
}

/* ------------------------------------------------------------------------------- the piece -- */

static int compare_numbers(const void *a, const void *b)
{
    const crease_mpi_parcel *const x = a, *const y = b;
    return (x->number > y->number) - (x->number < y->number);
}

/* The piece from sorted parcels; given and taken points become points of the piece. */
static crease_status fill(
    const crease_mpi *mpi, const crease_mpi_parcel *all, crease_mpi_share *share)
{
    const size_t count = share->own_count + share->counts.taken;
    uint32_t *const after = crease_allocate(mpi->context, count, sizeof *after);
    share->points = crease_allocate(mpi->context, count, 3 * sizeof *share->points);
    share->numbers = crease_allocate(mpi->context, count, sizeof *share->numbers);
    share->own = crease_allocate(mpi->context, count, sizeof *share->own);
    if (!after || !share->points || !share->numbers || !share->own) {
        free(after);
        return CREASE_ERROR_NO_MEMORY;
    }
    for (size_t i = 0; i < count; i++) {
        memcpy(share->points + 3 * i, all[i].point, sizeof all[i].point);
        share->numbers[i] = all[i].number;
        share->own[i] = all[i].from < share->own_count;
        after[all[i].from] = (uint32_t)i;
    }
    for (size_t i = 0; i < share->counts.given; i++)
        share->give[i] = after[share->give[i]];
    for (size_t i = 0; i < share->counts.taken; i++)
        share->take[i] = after[share->own_count + i];
    free(after);
    share->piece = (crease_piece){count, share->points, share->numbers, share->own};
    return CREASE_OK;
}

/* The own points are freed as soon as they are copied. */
static crease_status complete(
    const crease_mpi *mpi, crease_mpi_parcels *own, crease_mpi_share *share)
{
    const size_t count = share->own_count + share->counts.taken;
    crease_mpi_parcel *const given =
        crease_allocate(mpi->context, share->counts.given, sizeof *given);
    crease_mpi_parcel *const all = crease_allocate(mpi->context, count, sizeof *all);
    crease_status status = crease_mpi_agree(mpi, given && all ? CREASE_OK : CREASE_ERROR_NO_MEMORY);
    if (status == CREASE_OK) {
        for (size_t i = 0; i < share->counts.given; i++)
            given[i] = own->items[share->give[i]];
        memcpy(all, own->items, share->own_count * sizeof *all);
        free(own->items);
        own->items = NULL;
        status =
            crease_mpi_exchange(mpi, &share->counts, given, all + share->own_count, sizeof *all);
    }
    free(given);
    if (status == CREASE_OK) {
        for (size_t i = share->own_count; i < count; i++)
            all[i].from = (uint32_t)i;
        qsort(all, count, sizeof *all, compare_numbers);
        status = crease_mpi_agree(mpi, fill(mpi, all, share));
    }
    free(all);
    return status;
}

crease_status crease_mpi_share_create(
    const crease_mpi *mpi, crease_mpi_parcels *own, int k, crease_mpi_share *out)
{
    *out = (crease_mpi_share){.own_count = own->count};
    crease_status status = choose_all(mpi, own->items, own->count, k, out);
    if (status == CREASE_OK)
        status = complete(mpi, own, out);
    free(own->items);
    *own = (crease_mpi_parcels){NULL, 0};
    if (status != CREASE_OK)
        crease_mpi_share_free(out);
    return status;
}

void crease_mpi_share_free(crease_mpi_share *share)
{
    free(share->points);
    free(share->numbers);
    free(share->own);
    free(share->give);
    free(share->take);
    crease_mpi_counts_free(&share->counts);
    *share = (crease_mpi_share){0};
}

/* --------------------------------------------------------------------------------- values -- */

crease_status crease_mpi_share_exchange(
    const crease_mpi *mpi, const crease_mpi_share *share, void *values, size_t size)
{
    char *const given = crease_allocate(mpi->context, share->counts.given, size);
    char *const taken = crease_allocate(mpi->context, share->counts.taken, size);
    crease_status status =
        crease_mpi_agree(mpi, given && taken ? CREASE_OK : CREASE_ERROR_NO_MEMORY);
    if (status == CREASE_OK) {
        for (size_t i = 0; i < share->counts.given; i++)
            memcpy(given + i * size, (char *)values + share->give[i] * size, size);
        status = crease_mpi_exchange(mpi, &share->counts, given, taken, size);
    }
    for (size_t i = 0; i < share->counts.taken && status == CREASE_OK; i++)
        memcpy((char *)values + share->take[i] * size, taken + i * size, size);
    free(given);
    free(taken);
    return status;
}

/* The values and numbers of own points, packed. */
static void pack_own(
    const crease_mpi_share *share, const char *values, size_t size, char *out, uint32_t *numbers)
{
    size_t packed = 0;
    for (size_t i = 0; i < share->piece.count; i++) {
        if (!share->own[i])
            continue;
        memcpy(out + packed * size, values + i * size, size);
        numbers[packed++] = share->numbers[i];
    }
}

static void place(const char *from, const uint32_t *numbers, size_t count, size_t size, char *all)
{
    for (size_t i = 0; i < count; i++)
        memcpy(all + numbers[i] * size, from + i * size, size);
}

/* Rank 0: its own, then those of the others in turn. */
static crease_status collect(const crease_mpi *mpi, const crease_mpi_share *share, size_t size,
    char *values, uint32_t *numbers, char *all)
{
    crease_status status = CREASE_OK;
    place(values, numbers, share->own_count, size, all);
    for (int r = 1; r < mpi->size && status == CREASE_OK; r++) {
        uint64_t count = 0;
        status = crease_mpi_receive(mpi, r, &count, 1, sizeof count);
        if (status == CREASE_OK)
            status = crease_mpi_receive(mpi, r, numbers, count, sizeof *numbers);
        if (status == CREASE_OK)
            status = crease_mpi_receive(mpi, r, values, count, size);
        if (status == CREASE_OK)
            place(values, numbers, count, size, all);
    }
    return status;
}

static crease_status deliver(const crease_mpi *mpi, const crease_mpi_share *share, size_t size,
    const char *values, const uint32_t *numbers)
{
    const uint64_t count = share->own_count;
    crease_status status = crease_mpi_send(mpi, 0, &count, 1, sizeof count);
    if (status == CREASE_OK)
        status = crease_mpi_send(mpi, 0, numbers, count, sizeof *numbers);
    return status == CREASE_OK ? crease_mpi_send(mpi, 0, values, count, size) : status;
}

crease_status crease_mpi_share_gather(const crease_mpi *mpi, const crease_mpi_share *share,
    const void *values, size_t size, void *all)
{
    const size_t room = share->own_count + 1; /* no slice is larger than rank 0's by more */
    char *const packed = crease_allocate(mpi->context, room, size);
    uint32_t *const numbers = crease_allocate(mpi->context, room, sizeof *numbers);
    crease_status status =
        crease_mpi_agree(mpi, packed && numbers ? CREASE_OK : CREASE_ERROR_NO_MEMORY);
    if (status == CREASE_OK) {
        pack_own(share, values, size, packed, numbers);
        status = mpi->rank > 0 ? deliver(mpi, share, size, packed, numbers)
                               : collect(mpi, share, size, packed, numbers, all);
    }
    free(packed);
    free(numbers);
    return status;
}
