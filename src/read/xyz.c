/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Rows of numbers: XYZ, TXT, CSV, ASC, PTS. Nothing is taken from the extension: the separator, the
 * decimal comma, the names and the kinds of the columns are found by looking at the first lines.
 *
 *  - Comments begin with #, // or %. The last one in front of the rows that names as many columns
 *    as there are, x y z among them, is a header; so is a first line without any number.
 *  - A first line with one whole number is the count of points (PTS).
 *  - Columns of text are passed over. Without a header the first three columns of numbers are
 *    x y z; three more of unit length are a normal. */
#include "base/memory.h"
#include "read/colour.h"
#include "read/formats.h"
#include "read/number.h"
#include "read/table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct xyz {
    crease_context *context;
    const crease_source *source;
    const crease_read_options *options;
    crease_span comment, header, first; /* candidate lines; at NULL where there is none */
    size_t first_line;                  /* number of the first row's line */
    const char *body;                   /* the first row's line and all behind */
    const char *rest;                   /* what is behind the first row's line */
    bool counted;                       /* there was a count of points */
    uint64_t promised;                  /* that count */
    char separator;
    crease_columns columns;
    bool named; /* by a header */
} xyz;

/* ------------------------------------------------------------------------------------- cells -- */

static crease_span trimmed(crease_span cell)
{
    cell.at = crease_skip_blanks(cell.at, cell.end);
    while (cell.end > cell.at && crease_is_blank(cell.end[-1]))
        cell.end--;
    if (cell.end - cell.at >= 2 && *cell.at == '"' && cell.end[-1] == '"')
        return (crease_span){cell.at + 1, cell.end - 1};
    return cell;
}

/* Takes the next cell off the line; a separator at the end of the line ends the last cell. */
static bool next_cell(crease_span *line, char separator, crease_span *cell)
{
    if (separator == ' ')
        return crease_span_word(line, cell);
    if (line->at == line->end)
        return false;
    const char *stop = memchr(line->at, separator, (size_t)(line->end - line->at));
    *cell = trimmed((crease_span){line->at, stop ? stop : line->end});
    line->at = stop ? stop + 1 : line->end;
    return true;
}

static bool is_number(crease_span cell, char separator)
{
    double value = 0;
    return crease_number_parse(cell.at, cell.end, separator != ',', &value) == cell.end;
}

static size_t count_cells(crease_span line, char separator, size_t *numbers)
{
    size_t cells = 0;
    crease_span cell;
    for (*numbers = 0; next_cell(&line, separator, &cell); cells++)
        *numbers += is_number(cell, separator);
    return cells;
}

static const char separators[] = {';', ',', ' ', '\t'};

/* The separator that gives the most numbers, or the most cells when there are no numbers. */
static char choose_separator(crease_span line, size_t *most_numbers)
{
    char chosen = ' ';
    size_t most_cells = 0;
    *most_numbers = 0;
    for (size_t i = 0; i < sizeof separators; i++) {
        size_t numbers = 0;
        const size_t cells = count_cells(line, separators[i], &numbers);
        if (numbers > *most_numbers || (!*most_numbers && cells > most_cells)) {
            chosen = separators[i];
            *most_numbers = numbers;
            most_cells = cells;
        }
    }
    return chosen;
}

/* --------------------------------------------------------------------------------- preamble -- */

/* The text behind the sign of a comment, or NULL when the line is none. */
static const char *comment_text(const char *at, const char *end)
{
    const char *begin = at;
    while (at < end && (*at == '#' || *at == '%'))
        at++;
    if (at == begin && end - at >= 2 && at[0] == '/' && at[1] == '/')
        at += 2;
    return at > begin ? at : NULL;
}

static const char *data_of(const char *line, const char *end)
{
    const char *at = crease_skip_blanks(line, end);
    return at < end && !comment_text(at, end) ? at : NULL;
}

/* Takes a line that stands before the rows; false when it is the first row. */
static bool take_line(xyz *file, crease_span line)
{
    const char *comment = comment_text(line.at, line.end);
    if (line.at == line.end)
        return true;
    if (comment) {
        file->comment = (crease_span){comment, line.end};
        return true;
    }
    if (!file->counted && !file->header.at && crease_span_count(line, &file->promised)) {
        file->counted = true;
        return true;
    }
    size_t numbers = 0;
    choose_separator(line, &numbers);
    if (numbers || file->header.at)
        return false;
    file->header = line;
    return true;
}

static void read_preamble(xyz *file)
{
    const char *begin = file->source->bytes, *const end = begin + file->source->size;
    if (file->source->size >= 3 && memcmp(begin, "\xef\xbb\xbf", 3) == 0)
        begin += 3;
    crease_cursor cursor = {.at = begin, .end = end};
    crease_span line;
    do {
        file->body = cursor.at;
        file->first_line = cursor.line + 1;
        if (!crease_cursor_line(&cursor, &line))
            return;
    } while (take_line(file, line));
    file->first = line;
    file->rest = cursor.at;
}

/* ----------------------------------------------------------------------------------- columns -- */

static crease_span text_span(const char *text)
{
    return (crease_span){text, text + strlen(text)};
}

/* Whether the line names as many columns as there are and, when asked, x y z among them. */
static bool names_columns(crease_span line, char separator, size_t count, bool coordinates)
{
    size_t cells = 0, found = 0;
    crease_span cell;
    for (; next_cell(&line, separator, &cell); cells++)
        found += crease_span_is_like(cell, "x") || crease_span_is_like(cell, "y") ||
            crease_span_is_like(cell, "z");
    return cells == count && (!coordinates || found == 3);
}

/* Looks for the separator with which the line is a header; 0 when there is none. */
static char header_separator(const xyz *file, crease_span line, size_t count, bool coordinates)
{
    if (!line.at)
        return 0;
    if (names_columns(line, file->separator, count, coordinates))
        return file->separator;
    for (size_t i = 0; i < sizeof separators; i++)
        if (names_columns(line, separators[i], count, coordinates))
            return separators[i];
    return 0;
}

/* Name of a column that nothing names; `number` counts columns of numbers from 0. */
static crease_span default_name(const xyz *file, size_t number, size_t numbers, char room[24])
{
    static const char *const first[] = {"x", "y", "z"};
    static const char *const pts[] = {"intensity", "red", "green", "blue"};
    if (number < 3)
        return text_span(first[number]);
    const bool known = file->counted && number < numbers; /* empty cells come on top */
    if (known && (numbers == 4 || numbers == 7))
        return text_span(pts[number - 3]);
    if (known && numbers == 6)
        return text_span(pts[number - 2]);
    snprintf(room, 24, "scalar_%zu", number + 1);
    return text_span(room);
}

/* Adds the columns of the first row, under the names of the header when there is one. */
static crease_status add_columns(
    xyz *file, crease_span row, crease_span header, char names, size_t numbers)
{
    crease_span cell, name = {NULL, NULL};
    char room[24];
    size_t number = 0;
    while (next_cell(&row, file->separator, &cell)) {
        const bool text = file->first.at && cell.at < cell.end && !is_number(cell, file->separator);
        if (!names || !next_cell(&header, names, &name) || name.at == name.end)
            name = default_name(file, text ? 0 : number, numbers, room);
        number += !text;
        const crease_status status = crease_columns_add(file->context, &file->columns, name,
            CREASE_TYPE_FLOAT64, text ? CREASE_ROLE_SKIPPED : CREASE_ROLE_FIELD);
        if (status != CREASE_OK)
            return status;
    }
    return CREASE_OK;
}

static crease_status fail_columns(const xyz *file, size_t numbers)
{
    char text[CREASE_EXCERPT_SIZE];
    return crease_fail(file->context, CREASE_ERROR_FORMAT,
        "%s: line %zu: '%s' has %zu columns of numbers where x, y and z are needed; is it a cloud?",
        file->source->name, file->first_line, crease_span_excerpt(file->first, text), numbers);
}

static crease_status find_columns(xyz *file)
{
    const crease_span row = file->first.at ? file->first : file->header;
    size_t numbers = 0;
    file->separator = choose_separator(row, &numbers);
    if (file->first.at && numbers < 3)
        return fail_columns(file, numbers);
    size_t unused = 0;
    const size_t count = count_cells(row, file->separator, &unused);
    if (count > CREASE_MOST_COLUMNS)
        return crease_fail(file->context, CREASE_ERROR_FORMAT,
            "%s: line %zu: has %zu columns; at most %d are read, leave some out",
            file->source->name, file->first_line, count, CREASE_MOST_COLUMNS);
    char names = header_separator(file, file->header, count, false);
    if (file->header.at && !names)
        return crease_fail(file->context, CREASE_ERROR_FORMAT,
            "%s: line %zu: has %zu columns, but the header names another number; mend the header",
            file->source->name, file->first_line, count);
    crease_span header = file->header;
    if (!names) {
        header = file->comment;
        names = header_separator(file, header, count, true);
    }
    file->named = names != 0;
    return add_columns(file, row, header, names, numbers);
}

/* ----------------------------------------------------------------------------- what they are -- */

/* Six columns of numbers, the last three of unit length in every row. */
static bool has_plain_normals(const crease_columns *columns)
{
    if (columns->count != 6 || columns->rows == 0)
        return false;
    const double *parts[3];
    for (size_t i = 0; i < 3; i++) {
        if (columns->items[3 + i].role != CREASE_ROLE_FIELD)
            return false;
        parts[i] = (const void *)columns->items[3 + i].values;
    }
    for (size_t row = 0; row < columns->rows; row++) {
        const double x = parts[0][row], y = parts[1][row], z = parts[2][row];
        if (!(fabs(sqrt(x * x + y * y + z * z) - 1.0) < 0.01))
            return false;
    }
    return true;
}

static crease_status make_normals(crease_context *context, crease_columns *columns)
{
    columns->normals = crease_allocate(context, 3 * columns->rows, sizeof *columns->normals);
    if (!columns->normals)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < 3; i++) {
        crease_column *column = &columns->items[3 + i];
        double *values = (void *)column->values;
        for (size_t row = 0; row < columns->rows; row++)
            columns->normals[3 * row + i] = values[row];
        free(values);
        column->role = (crease_role)(CREASE_ROLE_NX + i);
        column->values = (unsigned char *)(columns->normals + i);
        column->step = 3 * sizeof *columns->normals;
    }
    return CREASE_OK;
}

/* The same, as all rows of the file tell. */
static bool have_normals(const xyz *file)
{
    crease_survey *const survey = file->source->survey;
    if (survey && survey->made)
        return survey->normals;
    const bool plain = !file->named && has_plain_normals(&file->columns);
    if (survey)
        survey->normals = survey->normals && plain;
    return plain;
}

/* ------------------------------------------------------------------------------------- whole -- */

static crease_status check_count(const xyz *file, size_t rows)
{
    if (!file->counted || file->promised == rows || file->source->line)
        return CREASE_OK;
    return crease_fail(file->context,
        rows < file->promised ? CREASE_ERROR_TRUNCATED : CREASE_ERROR_FORMAT,
        "%s: its first line promises %llu points but %zu follow; %s", file->source->name,
        (unsigned long long)file->promised, rows,
        rows < file->promised ? "get the whole file" : "mend the first line");
}

static crease_status read_rows(xyz *file, crease_table *table, crease_cloud **out)
{
    crease_context *const context = file->context;
    crease_columns *const columns = &file->columns;
    crease_status status = crease_table_count(context, table);
    if (status == CREASE_OK)
        status = check_count(file, table->rows);
    if (status == CREASE_OK)
        status = crease_columns_settle(context, file->source, columns);
    if (status == CREASE_OK)
        status = crease_columns_allocate(context, file->source, columns, table->rows);
    if (status == CREASE_OK)
        status = crease_table_fill(context, file->source, table, columns);
    if (status == CREASE_OK && have_normals(file))
        status = make_normals(context, columns);
    if (status == CREASE_OK)
        status = crease_colours_narrow(context, columns, file->source->survey);
    if (status != CREASE_OK)
        return status;
    return crease_columns_finish(
        context, file->source, file->options, columns, crease_table_place(table), out);
}

static crease_status check_text(crease_context *context, const crease_source *source)
{
    const unsigned char *begin = (const unsigned char *)source->bytes;
    if (source->size < 2 || (begin[0] ^ begin[1]) != 1 || begin[0] < 0xfe)
        return CREASE_OK;
    return crease_fail(context, CREASE_ERROR_FORMAT,
        "%s: byte 0: is text of 16-bit characters; save it as UTF-8 or ASCII", source->name);
}

/* What is before the rows, and the columns. */
static crease_status open_file(xyz *file)
{
    const crease_status status = check_text(file->context, file->source);
    if (status != CREASE_OK)
        return status;
    read_preamble(file);
    if (!file->first.at && !file->header.at)
        return crease_fail(file->context, CREASE_ERROR_FORMAT,
            "%s: there are no points in it; name another file", file->source->name);
    return find_columns(file);
}

crease_status crease_xyz_read(crease_context *context, const crease_source *source,
    const crease_read_options *options, crease_cloud **out)
{
    xyz file = {.context = context, .source = source, .options = options};
    crease_status status = open_file(&file);
    /* some of the rows come behind the first one, which tells what the columns are */
    crease_table table = {.begin = source->line ? file.rest : file.body,
        .end = source->bytes + source->size,
        .first_line = source->line ? source->line : file.first_line,
        .data = data_of,
        .separator = file.separator,
        .comma = file.separator != ','};
    if (status == CREASE_OK)
        status = read_rows(&file, &table, out);
    crease_table_free(&table);
    crease_columns_free(&file.columns);
    return status;
}

crease_status crease_xyz_layout(
    crease_context *context, const crease_source *head, crease_layout *out)
{
    const crease_read_options options = crease_read_options_default();
    xyz file = {.context = context, .source = head, .options = &options};
    crease_status status = open_file(&file);
    if (status == CREASE_OK && (!file.first.at || file.rest == head->bytes + head->size))
        status = crease_fail(context, CREASE_ERROR_UNSUPPORTED,
            "%s: what is before its second row is too long, or there is none, for reading in parts",
            head->name);
    if (status == CREASE_OK)
        status = crease_columns_settle(context, head, &file.columns);
    if (status == CREASE_OK)
        *out = (crease_layout){.counted = file.counted,
            .count = file.promised,
            .first = (size_t)(file.body - head->bytes),
            .alone = true,
            .is_row = data_of,
            .lead = (size_t)(file.rest - head->bytes),
            .line = file.first_line,
            .columns = file.columns.count,
            .asks =
                (!file.named && file.columns.count == 6) || crease_colours_named(&file.columns)};
    crease_columns_free(&file.columns);
    return status;
}
