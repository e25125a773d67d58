/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "read/table.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "read/number.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CHUNK_SIZE = 1 << 18 };

/* What is wrong with a row. */
typedef enum fault { FAULT_NONE, FAULT_FEW, FAULT_MANY, FAULT_NUMBER, FAULT_RANGE } fault;

typedef struct flaw {
    fault fault;
    size_t column; /* values that were read before */
    crease_span cell;
    size_t line; /* within the chunk */
} flaw;

struct crease_chunk {
    const char *begin, *end;
    size_t lines, rows;           /* in this chunk */
    size_t first_line, first_row; /* in the table */
    flaw flaw;                    /* the first one */
};

const char *crease_table_data(const char *line, const char *end)
{
    const char *at = crease_skip_blanks(line, end);
    return at < end ? at : NULL;
}

const char *crease_table_data_uncommented(const char *line, const char *end)
{
    const char *at = crease_skip_blanks(line, end);
    return at < end && *at != '#' ? at : NULL;
}

static const char *line_end(const char *at, const char *end)
{
    const char *stop = memchr(at, '\n', (size_t)(end - at));
    return stop ? stop : end;
}

/* ---------------------------------------------------------------------------------- counting -- */

/* Cuts the text behind line ends. A line longer than a chunk leaves chunks after it empty. */
static void cut(crease_table *table)
{
    const char *at = table->begin;
    for (size_t i = 0; i < table->chunk_count; i++) {
        crease_chunk *chunk = &table->chunks[i];
        const size_t left = (size_t)(table->end - table->begin) - i * CHUNK_SIZE;
        const char *border = left > CHUNK_SIZE ? table->end - left + CHUNK_SIZE : table->end;
        chunk->begin = at;
        if (at < border) {
            at = line_end(border - 1, table->end);
            at += at < table->end;
        }
        chunk->end = at;
    }
}

static void count_chunks(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const crease_table *const table = user;
    for (size_t i = begin; i < end; i++) {
        crease_chunk *chunk = &table->chunks[i];
        size_t lines = 0, rows = 0;
        for (const char *at = chunk->begin, *stop; at < chunk->end; at = stop + 1) {
            stop = line_end(at, chunk->end);
            lines++;
            rows += table->data(at, stop) != NULL;
        }
        chunk->lines = lines;
        chunk->rows = rows;
    }
}

crease_status crease_table_count(crease_context *context, crease_table *table)
{
    table->chunk_count = (size_t)(table->end - table->begin) / CHUNK_SIZE + 1;
    table->chunks = crease_allocate(context, table->chunk_count, sizeof *table->chunks);
    if (!table->chunks)
        return CREASE_ERROR_NO_MEMORY;
    cut(table);
    const crease_status status =
        crease_parallel_for(context, table->chunk_count, 1, count_chunks, table);
    size_t line = table->first_line;
    table->rows = 0;
    for (size_t i = 0; i < table->chunk_count; i++) {
        table->chunks[i].first_line = line;
        table->chunks[i].first_row = table->rows;
        line += table->chunks[i].lines;
        table->rows += table->chunks[i].rows;
    }
    return status;
}

size_t crease_table_line(const crease_table *table, size_t row)
{
    const crease_chunk *chunk = table->chunks;
    while (row >= chunk->first_row + chunk->rows)
        chunk++;
    size_t line = chunk->first_line, left = row - chunk->first_row;
    for (const char *at = chunk->begin, *stop; at < chunk->end; at = stop + 1, line++) {
        stop = line_end(at, chunk->end);
        if (table->data(at, stop) && left-- == 0)
            break;
    }
    return line;
}

static size_t find_line(const void *user, size_t row)
{
    return crease_table_line(user, row);
}

crease_place crease_table_place(const crease_table *table)
{
    return (crease_place){.unit = "line", .find = find_line, .user = table};
}

void crease_table_free(crease_table *table)
{
    free(table->chunks);
    table->chunks = NULL;
}

/* ----------------------------------------------------------------------------------- reading -- */

/* A walk over the cells of one row. */
typedef struct row_cursor {
    const char *at, *end;
    char separator;
    bool comma;
    size_t values; /* read so far */
} row_cursor;

static bool at_border(const row_cursor *row)
{
    return row->at == row->end || *row->at == row->separator ||
        (row->separator == ' ' && crease_is_blank(*row->at));
}

/* Goes over the separator in front of every cell but the first. */
static fault enter_cell(row_cursor *row)
{
    if (row->values && row->separator != ' ') {
        if (row->at == row->end)
            return FAULT_FEW;
        row->at++;
    }
    row->at = crease_skip_blanks(row->at, row->end);
    return row->at == row->end && row->separator == ' ' ? FAULT_FEW : FAULT_NONE;
}

/* Goes to the separator behind a cell. */
static fault leave_cell(row_cursor *row)
{
    if (row->separator != ' ')
        row->at = crease_skip_blanks(row->at, row->end);
    else if (at_border(row))
        row->at = crease_skip_blanks(row->at, row->end);
    else
        return FAULT_NUMBER;
    return row->separator == ' ' || at_border(row) ? FAULT_NONE : FAULT_NUMBER;
}

static fault read_number(row_cursor *row, double *value)
{
    const fault entered = enter_cell(row);
    if (entered)
        return entered;
    const char *after = crease_number_parse(row->at, row->end, row->comma, value);
    if (!after && row->separator != ' ' && at_border(row))
        *value = NAN; /* an empty cell */
    else if (!after)
        return FAULT_NUMBER;
    else
        row->at = after;
    return leave_cell(row);
}

static fault skip_cell(row_cursor *row)
{
    const fault entered = enter_cell(row);
    if (entered)
        return entered;
    if (row->at < row->end && *row->at == '"') {
        const char *quote = memchr(row->at + 1, '"', (size_t)(row->end - row->at - 1));
        row->at = quote ? quote + 1 : row->at;
    }
    while (!at_border(row))
        row->at++;
    return leave_cell(row);
}

static fault skip_list(row_cursor *row)
{
    double count = 0;
    const fault counted = read_number(row, &count);
    if (counted)
        return counted;
    if (!(count >= 0 && count <= (double)UINT32_MAX) || count != floor(count))
        return FAULT_RANGE;
    row->values++;
    for (uint64_t left = (uint64_t)count; left; left--) {
        const fault skipped = skip_cell(row);
        if (skipped)
            return skipped;
    }
    return FAULT_NONE;
}

static fault read_cell(row_cursor *row, const crease_column *column, size_t index)
{
    if (column->role == CREASE_ROLE_SKIPPED)
        return skip_cell(row);
    if (column->role == CREASE_ROLE_LIST)
        return skip_list(row);
    double value = 0;
    const fault found = read_number(row, &value);
    if (found)
        return found;
    return crease_column_store(column, index, value) ? FAULT_NONE : FAULT_RANGE;
}

static fault end_row(row_cursor *row)
{
    if (row->at < row->end && *row->at == row->separator)
        row->at = crease_skip_blanks(row->at + 1, row->end); /* one separator too many */
    return row->at == row->end || *row->at == '#' ? FAULT_NONE : FAULT_MANY;
}

static flaw read_row(
    const crease_table *table, const crease_columns *columns, crease_span line, size_t index)
{
    row_cursor row = {
        .at = line.at, .end = line.end, .separator = table->separator, .comma = table->comma};
    for (size_t i = 0; i < columns->count; i++) {
        const char *const begin = row.at;
        const fault found = read_cell(&row, &columns->items[i], index);
        if (found)
            return (flaw){.fault = found, .column = i, .cell = {begin, line.end}};
        row.values++;
    }
    const fault found = end_row(&row);
    return (flaw){.fault = found, .column = columns->count, .cell = {row.at, line.end}};
}

typedef struct reading {
    const crease_table *table;
    const crease_columns *columns;
} reading;

static void read_chunk(const reading *work, crease_chunk *chunk)
{
    size_t row = chunk->first_row, line = 0;
    for (const char *at = chunk->begin, *stop; at < chunk->end; at = stop + 1, line++) {
        stop = line_end(at, chunk->end);
        const char *data = work->table->data(at, stop);
        if (!data)
            continue;
        if (row == work->columns->rows)
            return;
        chunk->flaw = read_row(work->table, work->columns, (crease_span){data, stop}, row++);
        if (chunk->flaw.fault) {
            chunk->flaw.line = line;
            return;
        }
    }
}

static void read_chunks(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const reading *const work = user;
    for (size_t i = begin; i < end; i++)
        read_chunk(work, &work->table->chunks[i]);
}

/* The cell where a flaw is, without separators and blanks. */
static crease_span flawed_cell(crease_span cell, char separator)
{
    while (cell.at < cell.end && (crease_is_blank(*cell.at) || *cell.at == separator))
        cell.at++;
    const char *stop = cell.at;
    while (stop < cell.end && !crease_is_blank(*stop) && *stop != separator)
        stop++;
    return (crease_span){cell.at, stop};
}

static crease_status fail_row(crease_context *context, const crease_source *source,
    const crease_table *table, const crease_columns *columns, const crease_chunk *chunk)
{
    const flaw *const first = &chunk->flaw;
    const size_t line = chunk->first_line + first->line;
    char text[CREASE_EXCERPT_SIZE];
    crease_span_excerpt(flawed_cell(first->cell, table->separator), text);
    switch (first->fault) {
    case FAULT_FEW:
        return crease_fail(context, CREASE_ERROR_FORMAT,
            "%s: line %zu: ends after %zu columns, every point has %zu; mend or remove the line",
            source->name, line, first->column, columns->count);
    case FAULT_MANY:
        return crease_fail(context, CREASE_ERROR_FORMAT,
            "%s: line %zu: has more columns (from '%s' on) than the %zu of every point; mend or "
            "remove the line",
            source->name, line, text, columns->count);
    case FAULT_RANGE:
        return crease_fail(context, CREASE_ERROR_FORMAT,
            "%s: line %zu: '%s' does not fit the type of '%s'; mend the line or the header",
            source->name, line, text, columns->items[first->column].name);
    default:
        return crease_fail(context, CREASE_ERROR_FORMAT,
            "%s: line %zu: '%s' is not a number (column %zu); mend or remove the line",
            source->name, line, text, first->column + 1);
    }
}

crease_status crease_table_fill(crease_context *context, const crease_source *source,
    const crease_table *table, const crease_columns *columns)
{
    reading work = {.table = table, .columns = columns};
    const crease_status status =
        crease_parallel_for(context, table->chunk_count, 1, read_chunks, &work);
    for (size_t i = 0; status == CREASE_OK && i < table->chunk_count; i++)
        if (table->chunks[i].flaw.fault)
            return fail_row(context, source, table, columns, &table->chunks[i]);
    return status;
}
