/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "read/colour.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool is_colour(const crease_column *column)
{
    static const char *const names[] = {"r", "g", "b", "red", "green", "blue", "alpha"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (crease_span_is_like(
                (crease_span){column->name, column->name + strlen(column->name)}, names[i]))
            return true;
    return false;
}

static bool are_bytes(const double *values, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!(values[i] >= 0 && values[i] <= UINT8_MAX) || values[i] != floor(values[i]) ||
            signbit(values[i]))
            return false;
    return true;
}

bool crease_colours_named(const crease_columns *columns)
{
    for (size_t i = 0; i < columns->count; i++)
        if (columns->items[i].role == CREASE_ROLE_FIELD && is_colour(&columns->items[i]))
            return true;
    return false;
}

crease_status crease_colours_narrow(
    crease_context *context, crease_columns *columns, crease_survey *survey)
{
    for (size_t i = 0; i < columns->count; i++) {
        crease_column *column = &columns->items[i];
        const double *values = (const void *)column->values;
        if (column->role != CREASE_ROLE_FIELD || !is_colour(column))
            continue;
        const bool narrow =
            survey && survey->made ? survey->bytes[i] : are_bytes(values, columns->rows);
        if (survey)
            survey->bytes[i] = survey->bytes[i] && narrow;
        if (!narrow)
            continue;
        uint8_t *bytes = crease_allocate(context, columns->rows, 1);
        if (!bytes)
            return CREASE_ERROR_NO_MEMORY;
        for (size_t row = 0; row < columns->rows; row++)
            bytes[row] = (uint8_t)values[row];
        free(column->values);
        column->values = bytes;
        column->type = CREASE_TYPE_UINT8;
        column->step = 1;
    }
    return CREASE_OK;
}

static const crease_column *find_column(const crease_columns *columns, const char *name)
{
    for (size_t i = 0; i < columns->count; i++)
        if (strcmp(columns->items[i].name, name) == 0)
            return &columns->items[i];
    return NULL;
}

/* Adds one byte of the packed column as a column of its own. */
static crease_status add_byte(
    crease_context *context, crease_columns *columns, size_t packed, const char *name, int shift)
{
    const crease_status status =
        crease_columns_add_named(context, columns, name, CREASE_TYPE_UINT8);
    if (status != CREASE_OK)
        return status;
    crease_column *column = &columns->items[columns->count - 1];
    column->step = 1;
    column->values = crease_allocate(context, columns->rows, 1);
    if (!column->values)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t row = 0; row < columns->rows; row++) {
        uint32_t bits;
        memcpy(&bits, columns->items[packed].values + 4 * row, sizeof bits);
        column->values[row] = (unsigned char)(bits >> shift);
    }
    return CREASE_OK;
}

crease_status crease_colours_unpack(crease_context *context, crease_columns *columns)
{
    static const char *const names[] = {"blue", "green", "red", "alpha"};
    const crease_column *packed = find_column(columns, "rgb");
    if (!packed)
        packed = find_column(columns, "rgba");
    if (!packed || crease_cell_size(packed->cell) != 4 || find_column(columns, "red") ||
        find_column(columns, "green") || find_column(columns, "blue"))
        return CREASE_OK;
    const size_t index = (size_t)(packed - columns->items);
    const int first = packed->name[3] && !find_column(columns, "alpha") ? 3 : 2;
    for (int i = 2; i >= 0; i--) {
        const crease_status status = add_byte(context, columns, index, names[i], 8 * i);
        if (status != CREASE_OK)
            return status;
    }
    const crease_status status =
        first == 3 ? add_byte(context, columns, index, names[3], 24) : CREASE_OK;
    free(columns->items[index].values);
    columns->items[index].values = NULL;
    columns->items[index].role = CREASE_ROLE_SKIPPED;
    return status;
}
