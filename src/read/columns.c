/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "read/columns.h"

#include "base/memory.h"
#include "cloud/cloud.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LONGEST_NAME = 200 };

/* The square of a distance between such points is still a number. */
static const double most_coordinate = 1e150;

size_t crease_cell_size(int cell)
{
    return cell >= CREASE_CELL_INT64 ? 8 : crease_type_size((crease_type)cell);
}

/* ------------------------------------------------------------------------------- their roles -- */

static crease_role role_of(crease_span name)
{
    static const char *const names[][2] = {{"x", "x"}, {"y", "y"}, {"z", "z"}, {"nx", "normal_x"},
        {"ny", "normal_y"}, {"nz", "normal_z"}};
    for (int role = CREASE_ROLE_X; role <= CREASE_ROLE_NZ; role++)
        if (crease_span_is_like(name, names[role][0]) || crease_span_is_like(name, names[role][1]))
            return (crease_role)role;
    return CREASE_ROLE_FIELD;
}

static const crease_column *find_role(const crease_columns *columns, crease_role role)
{
    for (size_t i = 0; i < columns->count; i++)
        if (columns->items[i].role == role)
            return &columns->items[i];
    return NULL;
}

static char *copy_name(crease_context *context, crease_span name)
{
    const size_t length = (size_t)(name.end - name.at);
    const size_t kept = length < LONGEST_NAME ? length : LONGEST_NAME;
    char *copy = crease_allocate(context, kept + 1, 1);
    for (size_t i = 0; copy && i < kept; i++)
        copy[i] = name.at[i] > ' ' || name.at[i] < 0 ? name.at[i] : '_';
    return copy;
}

static bool make_room(crease_context *context, crease_columns *columns)
{
    if (columns->count < columns->room)
        return true;
    const size_t room = columns->room ? 2 * columns->room : 16;
    crease_column *items = crease_reallocate(context, columns->items, room, sizeof *items);
    if (!items)
        return false;
    columns->items = items;
    columns->room = room;
    return true;
}

crease_status crease_columns_add(
    crease_context *context, crease_columns *columns, crease_span name, int cell, crease_role role)
{
    if (role < CREASE_ROLE_SKIPPED) {
        role = role_of(name);
        if (find_role(columns, role))
            role = CREASE_ROLE_FIELD;
    }
    if (!make_room(context, columns))
        return CREASE_ERROR_NO_MEMORY;
    char *copy = copy_name(context, name);
    if (!copy)
        return CREASE_ERROR_NO_MEMORY;
    columns->items[columns->count++] = (crease_column){.name = copy,
        .role = role,
        .cell = cell,
        .type = cell >= CREASE_CELL_INT64 ? CREASE_TYPE_FLOAT64 : (crease_type)cell};
    return CREASE_OK;
}

crease_status crease_columns_add_named(
    crease_context *context, crease_columns *columns, const char *name, int cell)
{
    return crease_columns_add(
        context, columns, (crease_span){name, name + strlen(name)}, cell, CREASE_ROLE_FIELD);
}

static crease_status check_names(
    crease_context *context, const crease_source *source, const crease_columns *columns)
{
    for (size_t i = 0; i < columns->count; i++)
        for (size_t j = 0; j < i && columns->items[i].role < CREASE_ROLE_SKIPPED; j++)
            if (columns->items[j].role < CREASE_ROLE_SKIPPED &&
                strcmp(columns->items[i].name, columns->items[j].name) == 0)
                return crease_fail(context, CREASE_ERROR_FORMAT,
                    "%s: columns %zu and %zu of its points are both named '%s'; rename one",
                    source->name, j + 1, i + 1, columns->items[i].name);
    return CREASE_OK;
}

static void settle_roles(crease_columns *columns)
{
    const bool normals = find_role(columns, CREASE_ROLE_NX) && find_role(columns, CREASE_ROLE_NY) &&
        find_role(columns, CREASE_ROLE_NZ);
    columns->coordinate_type = CREASE_TYPE_FLOAT32;
    for (size_t i = 0; i < columns->count; i++) {
        crease_column *column = &columns->items[i];
        if (!normals && column->role >= CREASE_ROLE_NX && column->role <= CREASE_ROLE_NZ)
            column->role = CREASE_ROLE_FIELD;
        if (column->role <= CREASE_ROLE_Z && column->cell != CREASE_TYPE_FLOAT32)
            columns->coordinate_type = CREASE_TYPE_FLOAT64;
        if (column->role <= CREASE_ROLE_NZ)
            column->type = CREASE_TYPE_FLOAT64;
    }
}

crease_status crease_columns_settle(
    crease_context *context, const crease_source *source, crease_columns *columns)
{
    for (int role = CREASE_ROLE_X; role <= CREASE_ROLE_Z; role++)
        if (!find_role(columns, (crease_role)role))
            return crease_fail(context, CREASE_ERROR_FORMAT,
                "%s: its points have no coordinate '%c'; name three columns x, y and z",
                source->name, "xyz"[role]);
    settle_roles(columns);
    return check_names(context, source, columns);
}

/* ---------------------------------------------------------------------------------- memory -- */

static bool allocate_column(crease_context *context, crease_columns *columns, crease_column *column)
{
    if (column->role >= CREASE_ROLE_SKIPPED)
        return true;
    if (column->role == CREASE_ROLE_FIELD) {
        column->step = crease_type_size(column->type);
        column->values = crease_allocate(context, columns->rows, column->step);
        return column->values != NULL;
    }
    double **const home = column->role <= CREASE_ROLE_Z ? &columns->points : &columns->normals;
    if (!*home)
        *home = crease_allocate(context, 3 * columns->rows, sizeof **home);
    column->step = 3 * sizeof **home;
    column->values = *home ? (unsigned char *)(*home + column->role % 3) : NULL;
    return *home != NULL;
}

crease_status crease_columns_allocate(
    crease_context *context, const crease_source *source, crease_columns *columns, uint64_t rows)
{
    if (rows > UINT32_MAX)
        return crease_fail(context, CREASE_ERROR_FORMAT,
            "%s: %llu points; at most %u fit one cloud, split it", source->name,
            (unsigned long long)rows, UINT32_MAX);
    columns->rows = (size_t)rows;
    for (size_t i = 0; i < columns->count; i++)
        if (!allocate_column(context, columns, &columns->items[i]))
            return CREASE_ERROR_NO_MEMORY;
    return CREASE_OK;
}

void crease_columns_free(crease_columns *columns)
{
    for (size_t i = 0; i < columns->count; i++) {
        free(columns->items[i].name);
        if (columns->items[i].role == CREASE_ROLE_FIELD)
            free(columns->items[i].values);
    }
    free(columns->items);
    free(columns->points);
    free(columns->normals);
    *columns = (crease_columns){.items = NULL};
}

/* ---------------------------------------------------------------------------------- storing -- */

static bool store_whole(unsigned char *to, crease_type type, double value)
{
    static const double lowest[] = {INT8_MIN, 0, INT16_MIN, 0, INT32_MIN, 0};
    static const double highest[] = {
        INT8_MAX, UINT8_MAX, INT16_MAX, UINT16_MAX, INT32_MAX, UINT32_MAX};
    if (!(value >= lowest[type] && value <= highest[type]) || value != floor(value))
        return false;
    const int64_t whole = (int64_t)value;
    const uint8_t byte = (uint8_t)whole;
    const uint16_t two = (uint16_t)whole;
    const uint32_t four = (uint32_t)whole;
    const size_t size = crease_type_size(type);
    memcpy(to, size == 1 ? (const void *)&byte : (size == 2 ? (const void *)&two : &four), size);
    return true;
}

bool crease_column_store(const crease_column *column, size_t row, double value)
{
    unsigned char *const to = column->values + row * column->step;
    const float single = (float)value;
    if (column->type < CREASE_TYPE_FLOAT32)
        return store_whole(to, column->type, value);
    if (column->type == CREASE_TYPE_FLOAT32) {
        memcpy(to, &single, sizeof single);
        return true;
    }
    const double kept = column->cell == CREASE_TYPE_FLOAT32 ? (double)single : value;
    memcpy(to, &kept, sizeof kept);
    return true;
}

/* -------------------------------------------------------------------------------- finishing -- */

static bool is_valid(const double *point)
{
    return fabs(point[0]) <= most_coordinate && fabs(point[1]) <= most_coordinate &&
        fabs(point[2]) <= most_coordinate;
}

static size_t first_invalid(const crease_columns *columns)
{
    size_t row = 0;
    while (row < columns->rows && is_valid(columns->points + 3 * row))
        row++;
    return row;
}

static crease_status fail_invalid(crease_context *context, const crease_source *source,
    const crease_columns *columns, crease_place place, size_t row)
{
    int axis = 0;
    while (fabs(columns->points[3 * row + (size_t)axis]) <= most_coordinate)
        axis++;
    const double value = columns->points[3 * row + (size_t)axis];
    const size_t where = place.find(place.user, row);
    if (isfinite(value))
        return crease_fail(context, CREASE_ERROR_VALUE,
            "%s: %s %zu: %c of point %zu is beyond 1e150; use another unit, or leave such points "
            "out with --skip-invalid",
            source->name, place.unit, where, "xyz"[axis], source -> rows_before + row + 1);
    return crease_fail(context, CREASE_ERROR_VALUE,
        "%s: %s %zu: %c of point %zu is %s; mend it, or leave such points out with --skip-invalid",
        source->name, place.unit, where, "xyz"[axis], source -> rows_before + row + 1,
        isnan(value) ? "not a number" : "infinite");
}

static void move_row(crease_columns *columns, size_t from, size_t to)
{
    for (size_t i = 0; i < columns->count; i++) {
        const crease_column *column = &columns->items[i];
        if (column->values)
            memcpy(column->values + to * column->step, column->values + from * column->step,
                crease_type_size(column->type));
    }
}

static void skip_invalid(
    crease_context *context, const crease_source *source, crease_columns *columns, size_t first)
{
    size_t kept = first;
    for (size_t row = first; row < columns->rows; row++)
        if (is_valid(columns->points + 3 * row))
            move_row(columns, row, kept++);
    crease_warn(context, "%s: %zu of %zu points have no finite coordinates and are left out",
        source->name, columns->rows - kept, columns->rows);
    columns->rows = kept;
}

static crease_cloud *move_out(crease_context *context, crease_columns *columns)
{
    crease_cloud *cloud = crease_allocate(context, 1, sizeof *cloud);
    if (!cloud)
        return NULL;
    cloud->fields = crease_allocate(context, columns->count, sizeof *cloud->fields);
    if (!cloud->fields) {
        free(cloud);
        return NULL;
    }
    cloud->count = columns->rows;
    cloud->coordinate_type = columns->coordinate_type;
    cloud->points = columns->points;
    cloud->normals = columns->normals;
    columns->points = columns->normals = NULL;
    for (size_t i = 0; i < columns->count; i++) {
        crease_column *column = &columns->items[i];
        if (column->role != CREASE_ROLE_FIELD)
            continue;
        cloud->fields[cloud->field_count++] =
            (crease_field){.name = column->name, .type = column->type, .values = column->values};
        column->name = NULL;
        column->values = NULL;
    }
    return cloud;
}

crease_status crease_columns_finish(crease_context *context, const crease_source *source,
    const crease_read_options *options, crease_columns *columns, crease_place place,
    crease_cloud **out)
{
    const size_t invalid = first_invalid(columns);
    if (invalid < columns->rows) {
        if (!options->skip_invalid)
            return fail_invalid(context, source, columns, place, invalid);
        skip_invalid(context, source, columns, invalid);
    }
    *out = move_out(context, columns);
    return *out ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
}
