/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A trimmed sheet. The border is found in a plane of u and v, each scaled to the mean length of the
 * surface along it; there the knot lines at which the surface may be sharp cut what is inside. */
#include "trim/trim.h"

#include "base/memory.h"
#include "base/select.h"
#include "base/vector.h"
#include "space/density.h"
#include "spline/sheet.h"
#include "spline/surface.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STATIONS = 1024, LEAST_POINTS = 100, TRIES = 5 };

static const double DISC = 2.5;         /* spacings: radius of the disc that is rolled */
static const double SPARSE_DISC = 2.0;  /* the same where points are sparse, in spacings there */
static const double LARGER = 1.5;       /* disc that is tried after one that finds no border */
static const double OUTLYING = 8.0;     /* standard deviations from the sheet, and ... */
static const double FAR_OFF = 3.0;      /* ... spacings: no point of the sheet */
static const double LEAST_WIDTH = 0.75; /* spacings: narrower faces are left out */

/* ----------------------------------------------------------------------------------- plane -- */

/* Beyond the points the surface may stretch. */
static void set_scale(crease_trimming *task)
{
    const crease_surface *const surface = task->sheet->surface;
    const crease_side sides[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
    double domain[2][2], squares[2] = {0.0, 0.0};
    for (int d = 0; d < 2; d++)
        crease_surface_domain(surface, d, domain[d]);
    const size_t count = task->sheet->parameters ? task->sheet->point_count : 0;
    const size_t step = count / STATIONS + 1;
    double stations = 0.0;
    for (size_t i = 0; i < count; i += step, stations++) {
        double out[12];
        crease_surface_evaluate(surface, task->sheet->parameters + 2 * i, sides, 1, out);
        squares[0] += crease_vector_dot(out + 6, out + 6);
        squares[1] += crease_vector_dot(out + 3, out + 3);
    }
    for (int d = 0; d < 2; d++) {
        task->scale[d] = squares[d] > 0.0 ? sqrt(squares[d] / stations) : 1.0;
        task->scatter.low[d] = domain[d][0] * task->scale[d];
        task->scatter.high[d] = domain[d][1] * task->scale[d];
    }
}

/* The inner knots with a multiplicity of at least the degree. */
static crease_status find_cuts(crease_trimming *task, int d)
{
    const crease_surface *const s = task->sheet->surface;
    const size_t degree = (size_t)s->order[d] - 1;
    size_t count = 0;
    task->knots[d] = crease_allocate(task->context, s->count[d], sizeof *task->knots[d]);
    task->cuts[d] = crease_allocate(task->context, s->count[d], sizeof *task->cuts[d]);
    if (!task->knots[d] || !task->cuts[d])
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = degree + 1; i < s->count[d]; i++) {
        const double knot = s->knots[d][i];
        if (knot == s->knots[d][i - 1] || (size_t)crease_surface_multiplicity(s, d, knot) < degree)
            continue;
        task->knots[d][count] = knot;
        task->cuts[d][count++] = knot * task->scale[d];
    }
    task->scatter.cuts.count[d] = count;
    task->scatter.cuts.at[d] = task->cuts[d];
    return CREASE_OK;
}

/* The points in the plane, but for those that are not on the sheet. */
static crease_status place_points(crease_trimming *task, double far)
{
    const crease_sheet *const sheet = task->sheet;
    size_t n = 0;
    for (size_t i = 0; i < sheet->point_count; i++) {
        if (!(fabs(sheet->deviations[i]) <= far))
            continue;
        for (size_t d = 0; d < 2; d++)
            task->places[2 * n + d] = sheet->parameters[2 * i + d] * task->scale[d];
        n++;
    }
    task->scatter.count = n;
    task->scatter.places = task->places;
    return CREASE_OK;
}

static crease_status find_spacings(crease_trimming *task, double spacings[2])
{
    static const double shares[2] = {0.5, 0.95};
    const size_t n = task->scatter.count;
    double *const points = crease_allocate(task->context, n, 3 * sizeof *points);
    if (!points)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < n; i++)
        memcpy(points + 3 * i, task->places + 2 * i, 2 * sizeof *points);
    const crease_status status =
        crease_density_spacings(task->context, points, n, shares, 2, spacings);
    free(points);
    return status;
}

static crease_status residual_scale(crease_trimming *task, double *scale)
{
    const size_t n = task->sheet->point_count;
    double *const values = crease_duplicate(
        task->context, task->sheet->deviations, n, sizeof *task->sheet->deviations);
    if (!values)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < n; i++)
        values[i] = fabs(values[i]);
    *scale = 1.4826 * crease_select(values, n, n / 2);
    free(values);
    return CREASE_OK;
}

/* ---------------------------------------------------------------------------------- border -- */

static crease_status cut(crease_trimming *task, bool *sound)
{
    return crease_overlay_find(task->context, &task->frontier, &task->scatter.cuts,
        LEAST_WIDTH * task->scatter.spacing, &task->overlay, sound);
}

static crease_status find_border(crease_trimming *task)
{
    crease_fringe_state state = CREASE_FRINGE_LOST;
    double spacings[2] = {0.0, 0.0}, scale = 0.0;
    bool sound = false;
    const size_t n = task->sheet->point_count;
    if (n < LEAST_POINTS || !task->sheet->parameters)
        return CREASE_OK;
    task->places = crease_allocate(task->context, n, 2 * sizeof *task->places);
    crease_status status = task->places ? residual_scale(task, &scale) : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK)
        status = place_points(task, INFINITY);
    if (status == CREASE_OK)
        status = find_spacings(task, spacings);
    if (status != CREASE_OK || !(spacings[0] > 0.0))
        return status;
    task->scatter.spacing = spacings[0];
    status = place_points(task, fmax(OUTLYING * scale, FAR_OFF * spacings[0]));
    double radius = fmax(DISC * spacings[0], SPARSE_DISC * spacings[1]);
    for (int i = 0; i < TRIES && status == CREASE_OK && !sound; i++, radius *= LARGER) {
        status = crease_fringe_find(task->context, &task->scatter, radius, &task->frontier, &state);
        if (status != CREASE_OK || state == CREASE_FRINGE_FULL)
            return status;
        if (state == CREASE_FRINGE_FOUND)
            status = cut(task, &sound);
        if (!sound)
            crease_frontier_clear(&task->frontier);
    }
    if (status == CREASE_OK && !sound)
        crease_warn(task->context,
            "the sheet is not trimmed: its points are too uneven to tell where they end");
    task->whole = !sound;
    return status;
}

static crease_status keep_whole(crease_trimming *task)
{
    bool sound = false;
    crease_status status =
        crease_fringe_of_rectangle(task->context, &task->scatter, &task->frontier);
    task->scatter.spacing = 0.0;
    if (status == CREASE_OK)
        status = cut(task, &sound);
    return status == CREASE_OK && !sound ? crease_fail(task->context, CREASE_ERROR_NUMERIC,
                                               "sheet: it has no extent; give points of a surface")
                                         : status;
}

/* ----------------------------------------------------------------------------------- faces -- */

/* The pieces between all knot lines at which the surface may be sharp, u-major. */
static crease_status make_pieces(crease_trimming *task, crease_trim *trim)
{
    const size_t *const counts = task->scatter.cuts.count;
    crease_line *const lines = crease_allocate(task->context, counts[0] + counts[1], sizeof *lines);
    if (!lines)
        return CREASE_ERROR_NO_MEMORY;
    crease_sheet cut_there = {.surface = task->sheet->surface, .lines = lines};
    for (int d = 0; d < 2; d++)
        for (size_t i = 0; i < counts[d]; i++)
            lines[cut_there.line_count++] =
                (crease_line){.direction = d, .parameter = task->knots[d][i]};
    const crease_status status =
        crease_sheet_faces(task->context, &cut_there, &trim->pieces, &trim->piece_count);
    free(lines);
    return status;
}

static crease_status make_faces(crease_trimming *task, crease_trim *trim)
{
    const crease_overlay *const o = &task->overlay;
    trim->halves = crease_allocate(task->context, o->half_count, sizeof *trim->halves);
    trim->first_half =
        crease_duplicate(task->context, o->first_half, o->loop_count + 1, sizeof *o->first_half);
    trim->faces = crease_allocate(task->context, o->face_count, sizeof *trim->faces);
    if (!trim->halves || !trim->first_half || !trim->faces)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < o->half_count; i++)
        trim->halves[i] = (crease_trim_half){o->halves[i] / 2, (o->halves[i] & 1) != 0};
    for (size_t i = 0; i < o->face_count; i++) {
        const crease_overlay_face *const from = &o->faces[i];
        trim->faces[i] = (crease_trim_face){
            .piece = from->cell[0] * (task->scatter.cuts.count[1] + 1) + from->cell[1],
            .first_loop = from->first_loop,
            .loop_count = from->loop_count};
    }
    trim->face_count = o->face_count;
    return make_pieces(task, trim);
}

/* ----------------------------------------------------------------------------------- making -- */

static crease_status make_trim(crease_trimming *task, crease_trim *trim)
{
    crease_status status = crease_trim_make_edges(task, trim);
    if (status == CREASE_OK)
        status = make_faces(task, trim);
    for (size_t i = 0; i < task->sheet->line_count && status == CREASE_OK; i++)
        status = crease_trim_add_creases(task, i, trim);
    trim->whole = task->whole;
    return status;
}

crease_status crease_sheet_trim(
    crease_context *context, const crease_sheet *sheet, crease_trim **out)
{
    crease_trimming task = {.context = context, .sheet = sheet, .whole = true};
    crease_trim *trim = NULL;
    *out = NULL;
    set_scale(&task);
    crease_status status = find_cuts(&task, 0);
    if (status == CREASE_OK)
        status = find_cuts(&task, 1);
    if (status == CREASE_OK)
        status = find_border(&task);
    if (status == CREASE_OK && task.whole)
        status = keep_whole(&task);
    if (status == CREASE_OK) {
        trim = crease_allocate(context, 1, sizeof *trim);
        status = trim ? make_trim(&task, trim) : CREASE_ERROR_NO_MEMORY;
    }
    if (status == CREASE_OK)
        *out = trim;
    else
        crease_trim_free(trim);
    crease_frontier_clear(&task.frontier);
    crease_overlay_clear(&task.overlay);
    for (int d = 0; d < 2; d++) {
        free(task.knots[d]);
        free(task.cuts[d]);
    }
    free(task.places);
    return status;
}
