/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "spline/sheet.h"

#include "base/memory.h"
#include "base/vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STATIONS = 33 };

void crease_sheet_free(crease_sheet *sheet)
{
    if (!sheet)
        return;
    crease_surface_free(sheet->surface);
    free(sheet->lines);
    free(sheet->parameters);
    free(sheet->projected);
    free(sheet->deviations);
    free(sheet->variance);
    free(sheet->errors);
    free(sheet);
}

const crease_surface *crease_sheet_surface(const crease_sheet *sheet)
{
    return sheet->surface;
}

size_t crease_sheet_line_count(const crease_sheet *sheet)
{
    return sheet->line_count;
}

crease_line crease_sheet_line(const crease_sheet *sheet, size_t index)
{
    return index < sheet->line_count ? sheet->lines[index] : (crease_line){.direction = 0};
}

void crease_sheet_frame(const crease_sheet *sheet, double rotation[9], double origin[3])
{
    memcpy(rotation, sheet->frame.rotation, sizeof sheet->frame.rotation);
    memcpy(origin, sheet->frame.origin, sizeof sheet->frame.origin);
}

size_t crease_sheet_point_count(const crease_sheet *sheet)
{
    return sheet->point_count;
}

const double *crease_sheet_parameters(const crease_sheet *sheet)
{
    return sheet->parameters;
}

const double *crease_sheet_projected(const crease_sheet *sheet)
{
    return sheet->projected;
}

const double *crease_sheet_deviations(const crease_sheet *sheet)
{
    return sheet->deviations;
}

const double *crease_sheet_variance(const crease_sheet *sheet)
{
    return sheet->variance;
}

const double *crease_sheet_standard_errors(const crease_sheet *sheet)
{
    return sheet->errors;
}

double crease_sheet_bend(const crease_surface *surface, int direction, const double uv[2])
{
    double normal[2][3], cross[3];
    for (int side = 0; side < 2; side++) {
        crease_side sides[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
        sides[direction] = side ? CREASE_SIDE_LEFT : CREASE_SIDE_RIGHT;
        crease_surface_normal(surface, uv, sides, normal[side]);
    }
    crease_vector_cross(normal[0], normal[1], cross);
    return atan2(crease_vector_length(cross), crease_vector_dot(normal[0], normal[1])) *
        57.295779513082321;
}

static bool everywhere(const void *user, double u, double v)
{
    (void)user;
    (void)u;
    (void)v;
    return true;
}

double crease_sheet_dihedral_where(const crease_surface *surface, int direction, double parameter,
    bool (*counts)(const void *user, double u, double v), const void *user)
{
    double domain[2], sum = 0.0;
    int stations = 0;
    crease_surface_domain(surface, 1 - direction, domain);
    for (int i = 0; i < STATIONS; i++) {
        double uv[2];
        uv[direction] = parameter;
        uv[1 - direction] = domain[0] + (domain[1] - domain[0]) * (i + 0.5) / STATIONS;
        if (counts(user, uv[0], uv[1])) {
            sum += crease_sheet_bend(surface, direction, uv);
            stations++;
        }
    }
    return stations ? 180.0 - sum / stations : crease_sheet_dihedral(surface, direction, parameter);
}

double crease_sheet_dihedral(const crease_surface *surface, int direction, double parameter)
{
    return crease_sheet_dihedral_where(surface, direction, parameter, everywhere, NULL);
}

static crease_status take_border(
    crease_context *context, const crease_surface *surface, int direction, crease_curve **out)
{
    const crease_surface_parts parts = crease_surface_parts_of(surface);
    const int along = 1 - direction;
    const size_t count = parts.count[along], step = along ? 1 : parts.count[1];
    double *points = crease_allocate(context, count, 3 * sizeof *points);
    if (!points)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < count; i++)
        memcpy(points + 3 * i, parts.control_points + 3 * i * step, 3 * sizeof *points);
    const crease_status status =
        crease_curve_create(context, parts.order[along], count, parts.knots[along], points, out);
    free(points);
    return status;
}

crease_status crease_sheet_line_curve(
    crease_context *context, const crease_sheet *sheet, size_t index, crease_curve **out)
{
    *out = NULL;
    if (index >= sheet->line_count)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "sheet: crease line %zu; there are %zu, counted from 0", index, sheet->line_count);
    const crease_line line = sheet->lines[index];
    crease_surface *lower = NULL, *upper = NULL;
    crease_status status = crease_surface_split(
        context, sheet->surface, line.direction, line.parameter, &lower, &upper);
    if (status == CREASE_OK)
        status = take_border(context, upper, line.direction, out);
    crease_surface_free(lower);
    crease_surface_free(upper);
    return status;
}

/* Splits surfaces[first] .. at the parameters of the lines of one direction, which are ascending;
 * pieces follow each other. */
static crease_status split_all(crease_context *context, const crease_sheet *sheet, int direction,
    crease_surface *whole, crease_surface **pieces, size_t *count)
{
    crease_surface *rest = whole;
    crease_status status = CREASE_OK;
    *count = 0;
    for (size_t i = 0; i < sheet->line_count && status == CREASE_OK; i++) {
        if (sheet->lines[i].direction != direction)
            continue;
        crease_surface *lower = NULL, *upper = NULL;
        status = crease_surface_split(
            context, rest, direction, sheet->lines[i].parameter, &lower, &upper);
        if (status != CREASE_OK)
            break;
        crease_surface_free(rest);
        pieces[(*count)++] = lower;
        rest = upper;
    }
    pieces[(*count)++] = rest;
    return status;
}

static crease_status copy_surface(
    crease_context *context, const crease_surface *surface, crease_surface **out)
{
    const crease_surface_parts parts = crease_surface_parts_of(surface);
    return crease_surface_create(context, &parts, out);
}

crease_status crease_sheet_faces(
    crease_context *context, const crease_sheet *sheet, crease_surface ***out, size_t *count)
{
    *out = NULL;
    *count = 0;
    size_t lines[2] = {0, 0}, strips = 0, made = 0;
    for (size_t i = 0; i < sheet->line_count; i++)
        lines[sheet->lines[i].direction]++;
    crease_surface **faces =
        crease_allocate(context, (lines[0] + 1) * (lines[1] + 1), sizeof(crease_surface *));
    crease_surface **columns = crease_allocate(context, lines[0] + 1, sizeof(crease_surface *));
    crease_surface *whole = NULL;
    crease_status status = faces && columns ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK)
        status = copy_surface(context, sheet->surface, &whole);
    if (status == CREASE_OK)
        status = split_all(context, sheet, 0, whole, columns, &strips);
    size_t next = 0;
    for (; next < strips && status == CREASE_OK; next++) {
        size_t pieces = 0;
        status = split_all(context, sheet, 1, columns[next], faces + made, &pieces);
        made += pieces;
    }
    for (; next < strips; next++)
        crease_surface_free(columns[next]);
    free(columns);
    if (status != CREASE_OK) {
        crease_surfaces_free(faces, made);
        return status;
    }
    *out = faces;
    *count = made;
    return CREASE_OK;
}
