/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* LAS, versions 1.0 to 1.4, point formats 0 to 10: what airborne and terrestrial scanners deliver.
 * Coordinates are whole numbers, scaled and shifted by the header. LAZ, which is compressed, is not
 * read.
 * Based on: ASPRS. LAS specification 1.4 - R15. 2019. */
#include "read/binary.h"
#include "read/formats.h"

#include <string.h>

/* Bytes of the header where each thing stands. */
enum {
    MINOR_VERSION = 25,
    POINTS_BEGIN = 96,
    POINT_FORMAT = 104,
    RECORD_SIZE = 105,
    LEGACY_COUNT = 107,
    SCALES = 131,
    OFFSETS = 155,
    LEGACY_HEADER = 227,
    COUNT = 247,
    HEADER = 375,
    FORMATS = 11,
    LAST_WITH_FLAGS = 5 /* up to this format three flags share the classification's byte */
};

typedef struct las {
    crease_context *context;
    const crease_source *source;
    int format;
    size_t begin, record;
    uint64_t count;
    crease_columns columns;
} las;

/* What a record holds, for each point format the byte where it begins, 0 for nothing. */
static const struct {
    const char *name;
    crease_type type;
    unsigned char at[FORMATS];
} parts[] = {
    {"intensity", CREASE_TYPE_UINT16, {12, 12, 12, 12, 12, 12, 12, 12, 12, 12, 12}},
    {"classification", CREASE_TYPE_UINT8, {15, 15, 15, 15, 15, 15, 16, 16, 16, 16, 16}},
    {"gps_time", CREASE_TYPE_FLOAT64, {0, 20, 0, 20, 20, 20, 22, 22, 22, 22, 22}},
    {"red", CREASE_TYPE_UINT16, {0, 0, 20, 28, 0, 28, 0, 30, 30, 0, 30}},
    {"green", CREASE_TYPE_UINT16, {0, 0, 22, 30, 0, 30, 0, 32, 32, 0, 32}},
    {"blue", CREASE_TYPE_UINT16, {0, 0, 24, 32, 0, 32, 0, 34, 34, 0, 34}},
};
/* The shortest record of each format. */
static const size_t least_record[FORMATS] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

static double number(const las *file, size_t at, int cell)
{
    return crease_cell_load(
        (const unsigned char *)file->source->bytes + at, cell, CREASE_ORDER_LITTLE);
}

static crease_status fail_damaged(const las *file, const char *what)
{
    return crease_fail(file->context, CREASE_ERROR_FORMAT,
        "%s: %s; the file is damaged, get it again", file->source->name, what);
}

static crease_status fail_truncated(const las *file)
{
    return crease_fail(file->context, CREASE_ERROR_TRUNCATED,
        "%s: byte %zu: ends before the %llu points that its header promises; get the whole file",
        file->source->name, file->source->size, (unsigned long long)file->count);
}

static crease_status check(const las *file)
{
    if (file->format >= FORMATS || file->record < least_record[file->format])
        return fail_damaged(file, "its point format is none of LAS 1.0 to 1.4");
    if (file->begin < LEGACY_HEADER)
        return fail_damaged(file, "its points begin inside its header");
    return CREASE_OK;
}

static crease_status check_size(const las *file)
{
    if (file->begin > file->source->size ||
        file->count > (file->source->size - file->begin) / file->record)
        return fail_truncated(file);
    return CREASE_OK;
}

static crease_status read_header(las *file)
{
    if (file->source->size < LEGACY_HEADER)
        return crease_fail(file->context, CREASE_ERROR_TRUNCATED,
            "%s: byte %zu: ends within the header of a LAS file; get the whole file",
            file->source->name, file->source->size);
    const int format = (int)number(file, POINT_FORMAT, CREASE_TYPE_UINT8);
    /* the two highest bits are set by programs that compress */
    if (format & 0xc0)
        return crease_fail(file->context, CREASE_ERROR_FORMAT,
            "%s: is compressed (LAZ); give it as LAS, for instance by laszip or PDAL",
            file->source->name);
    file->format = format;
    file->begin = (size_t)number(file, POINTS_BEGIN, CREASE_TYPE_UINT32);
    file->record = (size_t)number(file, RECORD_SIZE, CREASE_TYPE_UINT16);
    file->count = (uint64_t)number(file, LEGACY_COUNT, CREASE_TYPE_UINT32);
    if (number(file, MINOR_VERSION, CREASE_TYPE_UINT8) >= 4 && file->source->size >= HEADER) {
        const double count = number(file, COUNT, CREASE_CELL_UINT64);
        file->count = count < 0x1p53 ? (uint64_t)count : UINT64_C(1) << 53;
    }
    return check(file);
}

/* A column as crease_columns_fill() wants it. */
static crease_status add(las *file, const char *name, int cell, size_t at)
{
    const crease_status status =
        crease_columns_add_named(file->context, &file->columns, name, cell);
    if (status == CREASE_OK) {
        crease_column *column = &file->columns.items[file->columns.count - 1];
        column->offset = at;
        column->stride = file->record;
    }
    return status;
}

static crease_status add_columns(las *file)
{
    static const char *const names[] = {"x", "y", "z"};
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < 3 && status == CREASE_OK; i++)
        status = add(file, names[i], CREASE_TYPE_INT32, 4 * i);
    for (size_t i = 0; i < sizeof parts / sizeof parts[0] && status == CREASE_OK; i++)
        if (parts[i].at[file->format])
            status = add(file, parts[i].name, (int)parts[i].type, parts[i].at[file->format]);
    return status;
}

/* Whole numbers to lengths. */
static void place_points(las *file)
{
    double scale[3], offset[3];
    for (size_t c = 0; c < 3; c++) {
        scale[c] = number(file, SCALES + 8 * c, CREASE_TYPE_FLOAT64);
        offset[c] = number(file, OFFSETS + 8 * c, CREASE_TYPE_FLOAT64);
    }
    for (size_t i = 0; i < 3 * file->columns.rows; i++)
        file->columns.points[i] = file->columns.points[i] * scale[i % 3] + offset[i % 3];
    file->columns.coordinate_type = CREASE_TYPE_FLOAT64;
}

/* Takes the flags off the class. */
static void mask_classes(las *file)
{
    if (file->format > LAST_WITH_FLAGS)
        return;
    for (size_t i = 0; i < file->columns.count; i++)
        if (strcmp(file->columns.items[i].name, "classification") == 0)
            for (size_t row = 0; row < file->columns.rows; row++)
                file->columns.items[i].values[row] &= 0x1f;
}

static size_t byte_of(const void *user, size_t row)
{
    const las *const file = user;
    return file->source->bytes_before + file->begin + row * file->record;
}

static crease_status read_points(las *file, const crease_read_options *options, crease_cloud **out)
{
    crease_status status = add_columns(file);
    if (status == CREASE_OK)
        status = crease_columns_settle(file->context, file->source, &file->columns);
    if (status == CREASE_OK)
        status = crease_columns_allocate(file->context, file->source, &file->columns, file->count);
    if (status == CREASE_OK)
        status = crease_columns_fill(file->context, &file->columns,
            (const unsigned char *)file->source->bytes + file->begin, CREASE_ORDER_LITTLE);
    if (status != CREASE_OK)
        return status;
    place_points(file);
    mask_classes(file);
    const crease_place place = {.unit = "byte", .find = byte_of, .user = file};
    return crease_columns_finish(file->context, file->source, options, &file->columns, place, out);
}

crease_status crease_las_read(crease_context *context, const crease_source *source,
    const crease_read_options *options, crease_cloud **out)
{
    las file = {.context = context, .source = source};
    crease_status status = read_header(&file);
    if (status == CREASE_OK)
        status = check_size(&file);
    if (status == CREASE_OK)
        status = read_points(&file, options, out);
    crease_columns_free(&file.columns);
    return status;
}

/* ------------------------------------------------------------------------------------ layout -- */

crease_status crease_las_layout(
    crease_context *context, const crease_source *head, crease_layout *out)
{
    las file = {.context = context, .source = head};
    const crease_status status = read_header(&file);
    if (status == CREASE_OK)
        *out = (crease_layout){
            .counted = true, .count = file.count, .size = file.record, .first = file.begin};
    return status;
}

static void set_number(char *to, uint64_t number, int bytes)
{
    for (int i = 0; i < bytes; i++)
        to[i] = (char)(number >> 8 * i & 0xff);
}

void crease_las_set_count(char *header, const crease_layout *layout, uint32_t count)
{
    set_number(header + LEGACY_COUNT, count, 4);
    if (header[MINOR_VERSION] >= 4 && layout->first >= HEADER)
        set_number(header + COUNT, count, 8);
}
