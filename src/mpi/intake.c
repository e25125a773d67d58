/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Points are numbered as they are in the file; those that are left out have no number, so a rank
 * knows its numbers only after all have read. */
#include "mpi/intake.h"

#include "base/memory.h"
#include "cloud/cloud.h"
#include "stream/sample.h"
#include "write/cloud.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ------------------------------------------------------------------------------------ reading --
 */

crease_status crease_mpi_rows_open(const crease_mpi *mpi, const char *path,
    const crease_read_options *options, size_t rows, crease_rows **out)
{
    char text[256];
    const crease_status status = crease_rows_open(mpi->context, path, options, out);
    if (status == CREASE_OK && crease_rows_count(*out) != rows)
        return crease_fail(mpi->context, CREASE_ERROR_FORMAT,
            "rank %d: %s: has %zu points here and %zu for rank 0; let all ranks see the same file",
            mpi->rank, path, crease_rows_count(*out), rows);
    if (status == CREASE_OK || status == CREASE_ERROR_NO_MEMORY)
        return status;
    snprintf(text, sizeof text, "%s", crease_context_message(mpi->context));
    return crease_fail(mpi->context, status, "rank %d, which reads a share of the file itself: %s",
        mpi->rank, text);
}

static void take_rows(crease_mpi_intake *intake, const crease_cloud *cloud)
{
    crease_mpi_parcels *const parcels = &intake->parcels;
    for (size_t i = 0; i < cloud->count; i++) {
        const double *const point = cloud->points + 3 * i;
        memcpy(parcels->items[parcels->count++].point, point, 3 * sizeof *point);
        for (int axis = 0; axis < 3; axis++) {
            intake->low[axis] = fmin(intake->low[axis], point[axis]);
            intake->high[axis] = fmax(intake->high[axis], point[axis]);
        }
    }
    intake->coordinate_type = cloud->coordinate_type;
    intake->wide_normals =
        intake->wide_normals || crease_cloud_normal_type(cloud) == CREASE_TYPE_FLOAT64;
}

static crease_status read_own(const crease_mpi *mpi, crease_mpi_intake *intake)
{
    crease_context *const context = mpi->context;
    const size_t rows = intake->end - intake->begin;
    intake->first = crease_allocate(context, (size_t)mpi->size + 1, sizeof *intake->first);
    intake->parcels.items = crease_allocate(context, rows, sizeof *intake->parcels.items);
    crease_status status =
        intake->first && intake->parcels.items ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    for (size_t at = intake->begin; at < intake->end && status == CREASE_OK;
         at += intake->at_once) {
        const size_t left = intake->end - at;
        crease_cloud *cloud = NULL;
        status = crease_rows_read(
            context, intake->rows, at, left < intake->at_once ? left : intake->at_once, &cloud);
        if (status == CREASE_OK)
            take_rows(intake, cloud);
        crease_cloud_free(cloud);
        if (status == CREASE_OK && crease_cancelled(context))
            status = crease_fail_cancelled(context);
    }
    return status;
}

static crease_status number(const crease_mpi *mpi, crease_mpi_intake *intake)
{
    const size_t ranks = (size_t)mpi->size;
    uint64_t wide = intake->wide_normals;
    intake->first[mpi->rank] = intake->parcels.count;
    crease_status status = crease_mpi_add(mpi, intake->first, ranks);
    if (status == CREASE_OK)
        status = crease_mpi_add(mpi, &wide, 1);
    if (status == CREASE_OK)
        status = crease_mpi_enclose(mpi, intake->low, intake->high);
    intake->wide_normals = wide > 0;
    for (size_t r = 0, sum = 0; r <= ranks; r++) {
        const size_t count = r < ranks ? intake->first[r] : 0;
        intake->first[r] = sum;
        sum += count;
    }
    for (size_t i = 0; i < intake->parcels.count; i++) {
        intake->parcels.items[i].number = (uint32_t)(intake->first[mpi->rank] + i);
        intake->parcels.items[i].from = (uint32_t)i;
    }
    return status;
}

crease_status crease_mpi_intake_read(
    const crease_mpi *mpi, crease_rows *rows, size_t at_once, crease_mpi_intake *out)
{
    const crease_mpi readers = {.rank = mpi->rank - 1, .size = mpi->size - 1};
    const size_t count = crease_rows_count(rows);
    *out = (crease_mpi_intake){.rows = rows,
        .at_once = at_once,
        .low = {INFINITY, INFINITY, INFINITY},
        .high = {-INFINITY, -INFINITY, -INFINITY}};
    if (mpi->rank > 0) {
        out->begin = crease_mpi_first_of(&readers, count, readers.rank);
        out->end = crease_mpi_first_of(&readers, count, readers.rank + 1);
    }
    crease_stage(mpi->context, "reading");
    const crease_status status = crease_mpi_agree(mpi, read_own(mpi, out));
    return status == CREASE_OK ? number(mpi, out) : status;
}

void crease_mpi_intake_free(crease_mpi_intake *intake)
{
    free(intake->parcels.items);
    free(intake->first);
    *intake = (crease_mpi_intake){0};
}

size_t crease_mpi_intake_total(const crease_mpi *mpi, const crease_mpi_intake *intake)
{
    return intake->first[mpi->size];
}

/* ------------------------------------------------------------------------------------- sample --
 */

/* What a rank says before it sends its points of the sample. */
typedef struct notice {
    uint64_t count;
    int64_t coordinate_type;
} notice;

/* Counts the own points of the sample; writes them down where there is room. */
static size_t draw_own(
    const crease_mpi *mpi, const crease_mpi_intake *intake, size_t most, double *points)
{
    const uint64_t first = intake->first[mpi->rank], last = intake->first[mpi->rank + 1];
    const size_t rows = crease_rows_count(intake->rows);
    size_t count = 0;
    for (size_t layer = 0; layer < most; layer++) {
        const size_t drawn = crease_sample_number(mpi->context, rows, most, layer);
        if (drawn < first || drawn >= last)
            continue;
        if (points)
            memcpy(
                points + 3 * count, intake->parcels.items[drawn - first].point, 3 * sizeof *points);
        count++;
    }
    return count;
}

static crease_status send_own(
    const crease_mpi *mpi, const crease_mpi_intake *intake, size_t most, double *points)
{
    const notice said = {draw_own(mpi, intake, most, points), (int64_t)intake->coordinate_type};
    const crease_status status = crease_mpi_send(mpi, 0, &said, 1, sizeof said);
    return status == CREASE_OK ? crease_mpi_send(mpi, 0, points, said.count, 3 * sizeof *points)
                               : status;
}

static crease_status receive_all(const crease_mpi *mpi, crease_cloud *sample)
{
    crease_status status = CREASE_OK;
    for (int r = 1; r < mpi->size && status == CREASE_OK; r++) {
        notice said = {0};
        status = crease_mpi_receive(mpi, r, &said, 1, sizeof said);
        if (status == CREASE_OK)
            status = crease_mpi_receive(
                mpi, r, sample->points + 3 * sample->count, said.count, 3 * sizeof(double));
        sample->count += said.count;
        sample->coordinate_type = (crease_type)said.coordinate_type;
    }
    return status;
}

crease_status crease_mpi_intake_sample(
    const crease_mpi *mpi, const crease_mpi_intake *intake, size_t most, crease_cloud **sample)
{
    crease_context *const context = mpi->context;
    const size_t room = mpi->rank > 0 ? draw_own(mpi, intake, most, NULL) : most;
    double *const points = crease_allocate(context, room, 3 * sizeof *points);
    crease_cloud *const all = sample ? crease_allocate(context, 1, sizeof *all) : NULL;
    crease_status status =
        crease_mpi_agree(mpi, points && (all || !sample) ? CREASE_OK : CREASE_ERROR_NO_MEMORY);
    if (!sample) {
        if (status == CREASE_OK)
            status = send_own(mpi, intake, most, points);
        free(points);
        return status;
    }
    if (all)
        all->points = points;
    else
        free(points);
    if (status == CREASE_OK)
        status = receive_all(mpi, all);
    if (status != CREASE_OK) {
        crease_cloud_free(all);
        return status;
    }
    *sample = all;
    return status;
}
