/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Curves as polylines. Each span of a curve is divided so that its chords stay within the
 * tolerance: a chord over a step h of the parameter deviates by at most h^2 |C''| / 8. Ends of
 * curves that meet are one vertex. */
#include "write/curves.h"
#include "base/memory.h"
#include "base/vector.h"
#include "spline/bezier.h"
#include "spline/curve.h"
#include "write/output.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PLY, OBJ, CSV, FORMAT_COUNT };

static const char *const extensions[FORMAT_COUNT] = {"ply", "obj", "csv"};

static const double MOST_VERTICES = 1e8;

/* Points of all curves, one after the other; number[i] is the vertex a point is written as. */
typedef struct polylines {
    size_t count;     /* curves */
    size_t *first;    /* count + 1: where the points of each curve begin */
    double *points;   /* x 3 */
    uint32_t *number; /* for each point */
    size_t vertex_count;
    const crease_curve_columns *columns;
} polylines;

/* ------------------------------------------------------------------------------- dividing -- */

/* A curve as a surface that does not change across. */
static crease_surface_parts ribbon(const crease_curve *curve)
{
    static const double across[2] = {0.0, 1.0};
    return (crease_surface_parts){.order = {curve->order, 1},
        .count = {curve->count, 1},
        .knots = {curve->knots, across},
        .control_points = curve->control_points};
}

/* Number of chords that a span needs. */
static double chords(const crease_bezier *bezier, size_t span, double tolerance)
{
    const int order = bezier->parts.order[0];
    double points[3 * CREASE_ORDER_MAX];
    const size_t patch[2] = {span, 0};
    crease_bezier_patch(bezier, patch, bezier->parts.control_points, points);
    double most = 0.0;
    for (int i = 0; i + 2 < order; i++) {
        double second[3];
        for (int c = 0; c < 3; c++)
            second[c] = points[3 * i + c] - 2.0 * points[3 * i + 3 + c] + points[3 * i + 6 + c];
        most = fmax(most, crease_vector_length(second));
    }
    return fmax(1.0, ceil(sqrt((order - 1) * (order - 2) * most / (8.0 * tolerance))));
}

static crease_status too_many(crease_context *context)
{
    return crease_fail(context, CREASE_ERROR_ARGUMENT,
        "curves: the tolerance asks for too many points; give a larger one");
}

static crease_status append_points(crease_context *context, polylines *lines, size_t more)
{
    const size_t count = lines->first[lines->count] + more;
    double *const grown =
        crease_reallocate(context, lines->points, count, 3 * sizeof *lines->points);
    if (!grown)
        return CREASE_ERROR_NO_MEMORY;
    lines->points = grown;
    return CREASE_OK;
}

static void sample_span(const crease_curve *curve, const double ends[2], double count, double *out)
{
    for (double k = 1.0; k <= count; k += 1.0, out += 3) {
        const double t = k < count ? ends[0] + (ends[1] - ends[0]) * (k / count) : ends[1];
        crease_curve_evaluate(curve, t, CREASE_SIDE_LEFT, 0, out);
    }
}

static crease_status add_curve(
    crease_context *context, const crease_curve *curve, double tolerance, polylines *lines)
{
    const crease_surface_parts parts = ribbon(curve);
    crease_bezier bezier;
    crease_status status = crease_bezier_prepare(context, &parts, &bezier);
    if (status != CREASE_OK)
        return status;
    const size_t begin = lines->first[lines->count];
    double total = 1.0;
    for (size_t i = 0; i < bezier.span_count[0]; i++)
        total += chords(&bezier, i, tolerance);
    status = total + (double)begin <= MOST_VERTICES ? append_points(context, lines, (size_t)total)
                                                    : too_many(context);
    if (status == CREASE_OK) {
        double *out = lines->points + 3 * begin;
        crease_curve_evaluate(curve, bezier.spans[0][0].ends[0], CREASE_SIDE_RIGHT, 0, out);
        out += 3;
        for (size_t i = 0; i < bezier.span_count[0]; i++) {
            const double count = chords(&bezier, i, tolerance);
            sample_span(curve, bezier.spans[0][i].ends, count, out);
            out += 3 * (size_t)count;
        }
        lines->first[++lines->count] = begin + (size_t)total;
    }
    crease_bezier_release(&bezier);
    return status;
}

/* ------------------------------------------------------------------------------- numbering -- */

typedef struct end {
    double place[3];
    size_t point;
} end;

static int compare_ends(const void *left, const void *right)
{
    const end *const a = left;
    const end *const b = right;
    if (a->place[0] != b->place[0])
        return a->place[0] < b->place[0] ? -1 : 1;
    return a->point < b->point ? -1 : a->point > b->point;
}

/* Sets number[] of each end of a curve to the lowest point at the same place, others to their own.
 */
static void unite_ends(const polylines *lines, end *ends, double close)
{
    for (size_t i = 0; i < lines->first[lines->count]; i++)
        lines->number[i] = (uint32_t)i;
    for (size_t i = 0; i < 2 * lines->count; i++) {
        ends[i].point = i % 2 ? lines->first[i / 2 + 1] - 1 : lines->first[i / 2];
        memcpy(ends[i].place, lines->points + 3 * ends[i].point, sizeof ends[i].place);
    }
    qsort(ends, 2 * lines->count, sizeof *ends, compare_ends);
    for (size_t i = 0; i < 2 * lines->count; i++)
        for (size_t j = i; j-- > 0 && ends[i].place[0] - ends[j].place[0] <= close;) {
            if (crease_vector_distance(ends[i].place, ends[j].place) > close)
                continue;
            uint32_t *const mine = &lines->number[ends[i].point];
            uint32_t *const other = &lines->number[ends[j].point];
            *mine = *other = *mine < *other ? *mine : *other;
        }
}

/* Numbers the vertices in the order of the points. */
static void number_vertices(polylines *lines)
{
    lines->vertex_count = 0;
    for (size_t i = 0; i < lines->first[lines->count]; i++) {
        const uint32_t same = lines->number[i];
        lines->number[i] = same == i ? (uint32_t)lines->vertex_count++ : lines->number[same];
    }
}

static crease_status unite(crease_context *context, polylines *lines, double close)
{
    lines->number = crease_allocate(context, lines->first[lines->count], sizeof *lines->number);
    end *ends = crease_allocate(context, 2 * lines->count, sizeof *ends);
    if (lines->number && ends) {
        unite_ends(lines, ends, close);
        number_vertices(lines);
    }
    const bool done = lines->number && ends;
    free(ends);
    return done ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
}

/* -------------------------------------------------------------------------------- formats -- */

/* True for the first point of a vertex; *next is the number of the vertex to come. */
static bool is_new(const polylines *lines, size_t point, size_t *next)
{
    if (lines->number[point] != *next)
        return false;
    *next += 1;
    return true;
}

/* Chords between different vertices: a curve that is one point has none. */
static bool is_edge(const polylines *lines, size_t curve, size_t point)
{
    return point > lines->first[curve] && lines->number[point] != lines->number[point - 1];
}

static size_t count_edges(const polylines *lines)
{
    size_t edges = 0;
    for (size_t curve = 0; curve < lines->count; curve++)
        for (size_t i = lines->first[curve]; i < lines->first[curve + 1]; i++)
            edges += is_edge(lines, curve, i);
    return edges;
}

static void write_place(crease_output *output, const double place[3], const char *between)
{
    for (int c = 0; c < 3; c++) {
        crease_output_text(output, c ? between : "");
        crease_output_double(output, place[c]);
    }
}

static void write_ply(crease_output *output, const polylines *lines)
{
    crease_output_format(output,
        "ply\nformat binary_little_endian 1.0\ncomment crease %s\nelement vertex %zu\n"
        "property double x\nproperty double y\nproperty double z\nproperty int crease\n"
        "element edge %zu\nproperty int vertex1\nproperty int vertex2\nend_header\n",
        crease_version(), lines->vertex_count, count_edges(lines));
    size_t next = 0;
    for (size_t curve = 0; curve < lines->count; curve++)
        for (size_t i = lines->first[curve]; i < lines->first[curve + 1]; i++) {
            if (!is_new(lines, i, &next))
                continue;
            for (size_t c = 0; c < 3; c++)
                crease_output_binary_f64(output, lines->points[3 * i + c]);
            crease_output_binary_u32(output, (uint32_t)curve);
        }
    for (size_t curve = 0; curve < lines->count; curve++)
        for (size_t i = lines->first[curve]; i < lines->first[curve + 1]; i++) {
            if (!is_edge(lines, curve, i))
                continue;
            crease_output_binary_u32(output, lines->number[i - 1]);
            crease_output_binary_u32(output, lines->number[i]);
        }
}

static void write_obj(crease_output *output, const polylines *lines)
{
    crease_output_format(output, "# crease %s\n", crease_version());
    size_t next = 0;
    for (size_t i = 0; i < lines->first[lines->count]; i++)
        if (is_new(lines, i, &next)) {
            crease_output_text(output, "v ");
            write_place(output, lines->points + 3 * i, " ");
            crease_output_text(output, "\n");
        }
    for (size_t curve = 0; curve < lines->count; curve++) {
        crease_output_text(output, "l");
        for (size_t i = lines->first[curve]; i < lines->first[curve + 1]; i++)
            crease_output_format(output, " %u", lines->number[i] + 1);
        crease_output_text(output, "\n");
    }
}

static void write_csv(crease_output *output, const polylines *lines)
{
    const crease_curve_columns *const columns = lines->columns;
    crease_output_text(output, "crease,x,y,z");
    for (size_t c = 0; c < columns->count; c++)
        crease_output_format(output, ",%s", columns->names[c]);
    crease_output_text(output, "\n");
    for (size_t curve = 0; curve < lines->count; curve++)
        for (size_t i = lines->first[curve]; i < lines->first[curve + 1]; i++) {
            crease_output_format(output, "%zu,", curve);
            write_place(output, lines->points + 3 * i, ",");
            for (size_t c = 0; c < columns->count; c++) {
                crease_output_text(output, ",");
                crease_output_double(output, columns->values[curve * columns->count + c]);
            }
            crease_output_text(output, "\n");
        }
}

/* ---------------------------------------------------------------------------------- curves -- */

/* Length of the diagonal of the box around all control points. */
static double extent(const crease_curve *const *curves, size_t count)
{
    double lowest[3] = {INFINITY, INFINITY, INFINITY};
    double highest[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t k = 0; k < count; k++)
        for (size_t i = 0; i < 3 * curves[k]->count; i++) {
            lowest[i % 3] = fmin(lowest[i % 3], curves[k]->control_points[i]);
            highest[i % 3] = fmax(highest[i % 3], curves[k]->control_points[i]);
        }
    return count ? crease_vector_distance(lowest, highest) : 0.0;
}

static crease_status make_polylines(crease_context *context, const crease_curve *const *curves,
    size_t count, double tolerance, polylines *lines)
{
    const double size = extent(curves, count);
    lines->first = crease_allocate(context, count + 1, sizeof *lines->first);
    if (!lines->first)
        return CREASE_ERROR_NO_MEMORY;
    double chosen = tolerance > 0.0 ? tolerance : size / 2000.0;
    chosen = chosen > 0.0 ? chosen : 1.0;
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < count && status == CREASE_OK; i++)
        status = add_curve(context, curves[i], chosen, lines);
    return status == CREASE_OK ? unite(context, lines, 1e-9 * size) : status;
}

crease_status crease_curves_write(crease_context *context, const crease_curve *const *curves,
    size_t count, double tolerance, const char *path)
{
    static const crease_curve_columns none = {0, NULL, NULL};
    return crease_curves_write_columns(context, curves, count, tolerance, &none, path);
}

crease_status crease_curves_write_columns(crease_context *context,
    const crease_curve *const *curves, size_t count, double tolerance,
    const crease_curve_columns *columns, const char *path)
{
    static void (*const writers[FORMAT_COUNT])(crease_output *, const polylines *) = {
        write_ply, write_obj, write_csv};
    size_t format = 0;
    crease_output *output = NULL;
    polylines lines = {.columns = columns};
    if (!(tolerance >= 0.0))
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "curves: the tolerance is %g; give a length, or 0 for the default", tolerance);
    crease_status status = crease_output_choose(context, path, extensions, FORMAT_COUNT, &format);
    if (status == CREASE_OK)
        status = make_polylines(context, curves, count, tolerance, &lines);
    if (status == CREASE_OK)
        status = crease_output_open(context, path, &output);
    if (status == CREASE_OK) {
        writers[format](output, &lines);
        status = crease_output_close(context, output, CREASE_OK);
    }
    free(lines.first);
    free(lines.points);
    free(lines.number);
    return status;
}
