/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "read/binary.h"

#include "base/parallel.h"

#include <string.h>

enum { GRAIN = 4096 }; /* rows whose bytes stay in the cache while their columns are taken out */

static uint64_t load_bits(const unsigned char *from, size_t size, crease_order order)
{
    uint64_t bits = 0;
    for (size_t i = 0; i < size; i++)
        bits |= (uint64_t)from[order == CREASE_ORDER_LITTLE ? i : size - 1 - i] << (8 * i);
    return bits;
}

static inline double load_float(const unsigned char *from, crease_order order)
{
    const uint32_t bits = (uint32_t)load_bits(from, 4, order);
    float value;
    memcpy(&value, &bits, sizeof value);
    return (double)value;
}

static inline double load_double(const unsigned char *from, crease_order order)
{
    const uint64_t bits = load_bits(from, 8, order);
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

double crease_cell_load(const unsigned char *from, int cell, crease_order order)
{
    switch (cell) {
    case CREASE_TYPE_FLOAT32:
        return load_float(from, order);
    case CREASE_TYPE_FLOAT64:
        return load_double(from, order);
    case CREASE_TYPE_INT8:
        return (int8_t)from[0];
    case CREASE_TYPE_INT16:
        return (int16_t)load_bits(from, 2, order);
    case CREASE_TYPE_INT32:
        return (int32_t)load_bits(from, 4, order);
    case CREASE_CELL_INT64:
        return (double)(int64_t)load_bits(from, 8, order);
    default:
        return (double)load_bits(from, crease_cell_size(cell), order);
    }
}

/* A cell that is kept as it is goes bit by bit: what is no number stays the same one. */
static void copy_bits(unsigned char *to, const unsigned char *from, size_t size, crease_order order)
{
    const uint64_t eight = load_bits(from, size, order);
    const uint8_t one = (uint8_t)eight;
    const uint16_t two = (uint16_t)eight;
    const uint32_t four = (uint32_t)eight;
    switch (size) {
    case 1:
        memcpy(to, &one, 1);
        break;
    case 2:
        memcpy(to, &two, 2);
        break;
    case 4:
        memcpy(to, &four, 4);
        break;
    default:
        memcpy(to, &eight, 8);
    }
}

void crease_column_copy(
    const crease_column *column, size_t row, const unsigned char *from, crease_order order)
{
    unsigned char *const to = column->values + row * column->step;
    if (column->cell == (int)column->type) {
        copy_bits(to, from, crease_cell_size(column->cell), order);
        return;
    }
    const double value = crease_cell_load(from, column->cell, order);
    memcpy(to, &value, sizeof value);
}

size_t crease_columns_pack(crease_columns *columns)
{
    size_t size = 0;
    for (size_t i = 0; i < columns->count; i++) {
        columns->items[i].offset = size;
        size += crease_cell_size(columns->items[i].cell);
    }
    for (size_t i = 0; i < columns->count; i++)
        columns->items[i].stride = size;
    return size;
}

typedef struct filling {
    const crease_columns *columns;
    const unsigned char *bytes;
    crease_order order;
} filling;

/* The coordinates that nearly every file has, without a choice for each value. */
static bool fill_floats(
    const crease_column *column, const unsigned char *bytes, size_t begin, size_t end)
{
    if (column->cell != CREASE_TYPE_FLOAT32 || column->type != CREASE_TYPE_FLOAT64)
        return false;
    const unsigned char *from = bytes + column->offset + begin * column->stride;
    unsigned char *to = column->values + begin * column->step;
    for (size_t row = begin; row < end; row++, from += column->stride, to += column->step) {
        const double value = load_float(from, CREASE_ORDER_LITTLE);
        memcpy(to, &value, sizeof value);
    }
    return true;
}

static void fill_rows(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const filling *const work = user;
    for (size_t i = 0; i < work->columns->count; i++) {
        const crease_column *column = &work->columns->items[i];
        if (!column->values ||
            (work->order == CREASE_ORDER_LITTLE && fill_floats(column, work->bytes, begin, end)))
            continue;
        const unsigned char *from = work->bytes + column->offset;
        for (size_t row = begin; row < end; row++)
            crease_column_copy(column, row, from + row * column->stride, work->order);
    }
}

crease_status crease_columns_fill(crease_context *context, crease_columns *columns,
    const unsigned char *bytes, crease_order order)
{
    filling work = {.columns = columns, .bytes = bytes, .order = order};
    return crease_parallel_for(context, columns->rows, GRAIN, fill_rows, &work);
}
