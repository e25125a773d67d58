/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A trimmed sheet. The border is found in a plane of u and v, each scaled to the mean length of the
 * surface along it; there the knot lines at which the surface may be sharp cut what is inside. */
#include "model/trim.h"

#include "base/memory.h"
#include "base/select.h"
#include "base/vector.h"
#include "crease/curve.h"
#include "model/fringe.h"
#include "space/density.h"
#include "spline/sheet.h"
#include "spline/surface.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STATIONS = 32, LEAST_POINTS = 100, TRIES = 5 };

static const double DISC = 2.5;         /* spacings: radius of the disc that is rolled */
static const double SPARSE_DISC = 2.0;  /* the same where points are sparse, in spacings there */
static const double LARGER = 1.5;       /* disc that is tried after one that finds no border */
static const double OUTLYING = 8.0;     /* standard deviations from the sheet, and ... */
static const double FAR_OFF = 3.0;      /* ... spacings: no point of the sheet */
static const double LEAST_WIDTH = 0.75; /* spacings: narrower faces are left out */
static const double PRECISION = 0.02;   /* spacings: of curves through the border */
static const double STRAIGHT = 0.06;    /* spacings: of lines that pass for straight */
static const double STEP = 0.5;         /* spacings, at most, between places of a curve */
static const double SMOOTH = 0.97;      /* cosine of the turn where a round border closes */

struct task {
    crease_context *context;
    const crease_sheet *sheet;
    double scale[2];            /* from u, v to the plane */
    double *places;             /* of the points, in the plane */
    double *knots[2], *cuts[2]; /* at which the surface may be sharp: u or v, and in the plane */
    crease_scatter scatter;
    crease_frontier frontier;
    crease_overlay overlay;
    bool whole;
};

/* ----------------------------------------------------------------------------------- plane -- */

static void set_scale(struct task *task)
{
    const crease_surface *const surface = task->sheet->surface;
    const crease_side sides[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
    double domain[2][2], squares[2] = {0.0, 0.0};
    for (int d = 0; d < 2; d++)
        crease_surface_domain(surface, d, domain[d]);
    for (int i = 0; i < STATIONS; i++)
        for (int k = 0; k < STATIONS; k++) {
            double out[12];
            const double uv[2] = {
                domain[0][0] + (domain[0][1] - domain[0][0]) * (i + 0.5) / STATIONS,
                domain[1][0] + (domain[1][1] - domain[1][0]) * (k + 0.5) / STATIONS};
            crease_surface_evaluate(surface, uv, sides, 1, out);
            squares[0] += crease_vector_dot(out + 6, out + 6);
            squares[1] += crease_vector_dot(out + 3, out + 3);
        }
    for (int d = 0; d < 2; d++) {
        task->scale[d] = sqrt(squares[d] / (STATIONS * STATIONS));
        task->scatter.low[d] = domain[d][0] * task->scale[d];
        task->scatter.high[d] = domain[d][1] * task->scale[d];
    }
}

/* The inner knots with a multiplicity of at least the degree. */
static crease_status find_cuts(struct task *task, int d)
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
static crease_status place_points(struct task *task, double far)
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

static crease_status find_spacings(struct task *task, double spacings[2])
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

static crease_status residual_scale(struct task *task, double *scale)
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

static crease_status cut(struct task *task, bool *sound)
{
    return crease_overlay_find(task->context, &task->frontier, &task->scatter.cuts,
        LEAST_WIDTH * task->scatter.spacing, &task->overlay, sound);
}

static crease_status find_border(struct task *task)
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

static crease_status keep_whole(struct task *task)
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

/* ---------------------------------------------------------------------------------- curves -- */

/* From the plane to u or v: on knot lines and sides exactly what these are. */
static double parameter_of(const struct task *task, int d, double at)
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
    const struct task *task, const crease_curve *curve, crease_curve **out)
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
    struct task *task, const crease_overlay_edge *edge, crease_curve **out)
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
    struct task *task, const crease_overlay_edge *edge, crease_curve **out)
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

static crease_status make_edges(struct task *task, crease_trim *trim)
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

/* ----------------------------------------------------------------------------------- faces -- */

/* The pieces between all knot lines at which the surface may be sharp, u-major. */
static crease_status make_pieces(struct task *task, crease_trim *trim)
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

static crease_status make_faces(struct task *task, crease_trim *trim)
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
    struct task *task, size_t line, const double range[2], crease_trim *trim)
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
static crease_status add_creases(struct task *task, size_t line, crease_trim *trim)
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

/* ----------------------------------------------------------------------------------- making -- */

static crease_status make_trim(struct task *task, crease_trim *trim)
{
    crease_status status = make_edges(task, trim);
    if (status == CREASE_OK)
        status = make_faces(task, trim);
    for (size_t i = 0; i < task->sheet->line_count && status == CREASE_OK; i++)
        status = add_creases(task, i, trim);
    trim->whole = task->whole;
    return status;
}

crease_status crease_sheet_trim(
    crease_context *context, const crease_sheet *sheet, crease_trim **out)
{
    struct task task = {.context = context, .sheet = sheet, .whole = true};
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
