/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The curves of a trimmed sheet: its edges in u and v, its creases in space. */
#include "trim/trim.h"

#include "base/memory.h"
#include "crease/curve.h"
#include "spline/sheet.h"
#include "spline/surface.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PRECISION = 0.02; /* spacings: of curves through the border */
static const double STRAIGHT = 0.06;  /* spacings: of lines that pass for straight */
static const double STEP = 0.5;       /* spacings, at most, between places of a curve */
static const double SMOOTH = 0.97;    /* cosine of the turn where a round border closes */

/* ---------------------------------------------------------------------------------- curves -- */

/* From the plane to u or v: on knot lines and sides exactly what these are. */
static double parameter_of(const crease_trimming *task, int d, double at)
{
    double domain[2];
    crease_surface_domain(task->sheet->surface, d, domain);
    for (int end = 0; end < 2; end++)
        if (at == (end ? task->scatter.high[d] : task->scatter.low[d]))
            return domain[end];
    for (size_t i = 0; i < task->scatter.cuts.count[d]; i++)
        if (at == task->cuts[d][i])
            return task->knots[d][i];
    return at / task->scale[d];
}

static bool is_straight(const double *places, size_t count, double within)
{
    const double *const p = places, *const q = places + 2 * (count - 1);
    const double length = hypot(q[0] - p[0], q[1] - p[1]);
    for (size_t i = 1; i + 1 < count; i++) {
        const double *const r = places + 2 * i;
        if (fabs((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])) > within * length)
            return false;
    }
    return length > 0.0;
}

/* Whether an edge from a vertex to itself has no corner there. */
static bool is_round(const crease_overlay *o, const crease_overlay_edge *edge)
{
    const double *const p = o->places + 2 * edge->first, *const q = p + 2 * (edge->count - 1);
    const double a[2] = {p[2] - p[0], p[3] - p[1]}, b[2] = {q[0] - q[-2], q[1] - q[-1]};
    return edge->nodes[0] == edge->nodes[1] && edge->count > 5 &&
        a[0] * b[0] + a[1] * b[1] > SMOOTH * hypot(a[0], a[1]) * hypot(b[0], b[1]);
}

/* The curve again, over 0..1, in u and v. */
static crease_status to_parameters(
    const crease_trimming *task, const crease_curve *curve, crease_curve **out)
{
    const size_t count = crease_curve_count(curve);
    const int order = crease_curve_order(curve);
    double domain[2], *const points = crease_allocate(task->context, count, 3 * sizeof *points);
    double *const knots = crease_allocate(task->context, count + (size_t)order, sizeof *knots);
    crease_status status = points && knots ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    crease_curve_domain(curve, domain);
    for (size_t i = 0; i < count + (size_t)order && status == CREASE_OK; i++)
        knots[i] = (crease_curve_knots(curve)[i] - domain[0]) / (domain[1] - domain[0]);
    for (size_t i = 0; i < count && status == CREASE_OK; i++)
        for (int d = 0; d < 2; d++)
            points[3 * i + (size_t)d] =
                parameter_of(task, d, crease_curve_control_points(curve)[3 * i + (size_t)d]);
    if (status == CREASE_OK)
        status = crease_curve_create(task->context, order, count, knots, points, out);
    free(points);
    free(knots);
    return status;
}

static crease_status straight_curve(
    crease_trimming *task, const crease_overlay_edge *edge, crease_curve **out)
{
    static const double knots[] = {0.0, 0.0, 1.0, 1.0};
    double points[6] = {0.0};
    for (size_t end = 0; end < 2; end++)
        for (int d = 0; d < 2; d++)
            points[3 * end + (size_t)d] = parameter_of(task, d,
                task->overlay.places[2 * (edge->first + (end ? edge->count - 1 : 0)) + (size_t)d]);
    return crease_curve_create(task->context, 2, 2, knots, points, out);
}

/* The places as points, with more of them between those that are far apart: curves keep to a line
 * only where there are places of it. */
static crease_status fill_in(crease_context *context, const double *places, size_t count,
    double step, double **points, size_t *out)
{
    size_t room = 1, n = 0;
    for (size_t i = 0; i + 1 < count; i++)
        room += (size_t)ceil(hypot(places[2 * i + 2] - places[2 * i],
                                 places[2 * i + 3] - places[2 * i + 1]) /
                    step) +
            1;
    *points = crease_allocate(context, room, 3 * sizeof **points);
    if (!*points)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i + 1 < count; i++) {
        const double *const p = places + 2 * i, *const q = p + 2;
        const size_t parts = (size_t)fmax(ceil(hypot(q[0] - p[0], q[1] - p[1]) / step), 1.0);
        for (size_t k = 0; k < parts; k++, n++)
            for (size_t d = 0; d < 2; d++)
                (*points)[3 * n + d] = p[d] + (double)k / (double)parts * (q[d] - p[d]);
    }
    memcpy(*points + 3 * n++, places + 2 * (count - 1), 2 * sizeof *places);
    *out = n;
    return CREASE_OK;
}

static crease_status make_curve(
    crease_trimming *task, const crease_overlay_edge *edge, crease_curve **out)
{
    const crease_overlay *const o = &task->overlay;
    const double *const places = o->places + 2 * edge->first;
    if (is_straight(places, edge->count, STRAIGHT * task->scatter.spacing))
        return straight_curve(task, edge, out);
    const bool round = is_round(o, edge);
    crease_curve *flat = NULL;
    double *points = NULL;
    size_t count = 0;
    crease_status status =
        fill_in(task->context, places, edge->count, STEP * task->scatter.spacing, &points, &count);
    if (status == CREASE_OK)
        status = crease_curve_fit(
            task->context, points, count - round, round, PRECISION * task->scatter.spacing, &flat);
    if (status == CREASE_OK)
        status = to_parameters(task, flat, out);
    crease_curve_free(flat);
    free(points);
    return status;
}

crease_status crease_trim_make_edges(crease_trimming *task, crease_trim *trim)
{
    const crease_overlay *const o = &task->overlay;
    crease_status status = CREASE_OK;
    trim->vertices = crease_allocate(task->context, o->node_count, 2 * sizeof *trim->vertices);
    trim->edges = crease_allocate(task->context, o->edge_count, sizeof *trim->edges);
    trim->curves = crease_allocate(task->context, o->edge_count, sizeof(crease_curve *));
    if (!trim->vertices || !trim->edges || !trim->curves)
        return CREASE_ERROR_NO_MEMORY;
    trim->vertex_count = o->node_count;
    for (size_t i = 0; i < o->edge_count && status == CREASE_OK; i++) {
        const crease_overlay_edge *const edge = &o->edges[i];
        status = make_curve(task, edge, &trim->curves[i]);
        if (status != CREASE_OK)
            break;
        trim->edges[trim->edge_count++] = (crease_trim_edge){.curve = trim->curves[i],
            .vertices = {edge->nodes[0], edge->nodes[1]},
            .faces = {edge->faces[0], edge->faces[1]}};
        for (int end = 0; end < 2; end++) {
            double place[3];
            crease_curve_evaluate(trim->curves[i], end, CREASE_SIDE_RIGHT, 0, place);
            memcpy(trim->vertices + 2 * (size_t)edge->nodes[end], place, 2 * sizeof *place);
        }
    }
    return status;
}

/* --------------------------------------------------------------------------------- creases -- */

/* A curve as a surface of order 1, which can be split. */
static crease_status surface_of(
    crease_context *context, const crease_curve *curve, crease_surface **out)
{
    static const double once[] = {0.0, 1.0};
    const crease_surface_parts parts = {.order = {crease_curve_order(curve), 1},
        .count = {crease_curve_count(curve), 1},
        .knots = {crease_curve_knots(curve), once},
        .control_points = crease_curve_control_points(curve)};
    return crease_surface_create(context, &parts, out);
}

/* Cuts off what is before (or behind) a parameter. */
static crease_status cut_off(
    crease_context *context, crease_surface **curve, double at, bool behind)
{
    double domain[2];
    crease_surface *parts[2] = {NULL, NULL};
    crease_surface_domain(*curve, 0, domain);
    if (!(at > domain[0] && at < domain[1]))
        return CREASE_OK;
    const crease_status status = crease_surface_split(context, *curve, 0, at, &parts[0], &parts[1]);
    if (status != CREASE_OK)
        return status;
    crease_surface_free(*curve);
    crease_surface_free(parts[behind]);
    *curve = parts[!behind];
    return CREASE_OK;
}

static crease_status add_crease(
    crease_trimming *task, size_t line, const double range[2], crease_trim *trim)
{
    crease_context *const context = task->context;
    crease_curve *whole = NULL;
    crease_surface *cut_one = NULL;
    crease_curve **const more =
        crease_reallocate(context, trim->creases, trim->crease_count + 1, sizeof(crease_curve *));
    if (!more)
        return CREASE_ERROR_NO_MEMORY;
    trim->creases = more;
    crease_status status = crease_sheet_line_curve(context, task->sheet, line, &whole);
    if (status == CREASE_OK)
        status = surface_of(context, whole, &cut_one);
    if (status == CREASE_OK)
        status = cut_off(context, &cut_one, range[0], false);
    if (status == CREASE_OK)
        status = cut_off(context, &cut_one, range[1], true);
    if (status == CREASE_OK)
        status = crease_curve_create(context, cut_one->order[0], cut_one->count[0],
            cut_one->knots[0], cut_one->control_points, &trim->creases[trim->crease_count]);
    trim->crease_count += status == CREASE_OK;
    crease_curve_free(whole);
    crease_surface_free(cut_one);
    return status;
}

/* The edges of a line follow each other in the overlay; those that go on from each other are one
 * crease. */
crease_status crease_trim_add_creases(crease_trimming *task, size_t line, crease_trim *trim)
{
    const crease_line l = task->sheet->lines[line];
    const size_t d = (size_t)l.direction;
    double range[2] = {0.0, 0.0};
    bool begun = false;
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < trim->edge_count && status == CREASE_OK; i++) {
        const crease_trim_edge edge = trim->edges[i];
        const double *const a = crease_curve_control_points(edge.curve), *const b = a + 3;
        if (task->overlay.edges[i].direction != l.direction || a[d] != l.parameter ||
            edge.faces[0] < 0 || edge.faces[1] < 0)
            continue;
        if (begun && a[1 - d] != range[1])
            status = add_crease(task, line, range, trim);
        if (!begun || a[1 - d] != range[1])
            range[0] = a[1 - d];
        range[1] = b[1 - d];
        begun = true;
    }
    return begun && status == CREASE_OK ? add_crease(task, line, range, trim) : status;
}
