/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* crease fit, one sheet: a surface that keeps its sharp edges. */
#include "fit.h"

#include "cad.h"
#include "option.h"
#include "outputs.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A larger net would hide in a figure what it surrounds; on the page it can be switched off. */
enum { MOST_NET_IN_FIGURE = 100 };

/* Spacings between the points and a sheet that does not follow them. */
static const double FAR_OFF = 2.0;

/* What the fit has brought: everything that is written. */
typedef struct result {
    crease_sheet *sheet;
    crease_surface **faces;
    size_t face_count;
    crease_curve **lines; /* as long as the sheet */
    size_t line_count;
    crease_trim *trim;       /* NULL: the whole sheet is written */
    bool whole;              /* known to have nothing to be cut off */
    crease_mesh *mesh;       /* of the trimmed faces */
    crease_cloud *cloud;     /* the input with variance and deviation */
    crease_cloud *projected; /* the same on the surface */
} result;

static void result_free(result *all)
{
    for (size_t i = 0; i < all->line_count; i++)
        crease_curve_free(all->lines[i]);
    free(all->lines);
    crease_surfaces_free(all->faces, all->face_count);
    crease_trim_free(all->trim);
    crease_mesh_free(all->mesh);
    crease_cloud_free(all->projected);
    crease_cloud_free(all->cloud);
    crease_sheet_free(all->sheet);
}

static crease_status fit(
    crease_context *context, const settings *s, const crease_cloud *cloud, crease_sheet **out)
{
    return s->method == METHOD_AVERAGING ? crease_averaging_fit(context, cloud, &s->averaging, out)
                                         : crease_sheet_fit(context, cloud, &s->sheet, out);
}

static crease_status make_lines(crease_context *context, result *all)
{
    const size_t count = crease_sheet_line_count(all->sheet);
    all->lines = calloc(count ? count : 1, sizeof *all->lines);
    crease_status status = all->lines ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < count && status == CREASE_OK; i++) {
        status = crease_sheet_line_curve(context, all->sheet, i, &all->lines[i]);
        all->line_count += status == CREASE_OK;
    }
    return status;
}

/* Whether triangles are asked for. */
static bool is_drawn(const settings *s)
{
    for (size_t i = 0; i < s->output_count; i++)
        if (target_of(s->outputs[i], FIT_ALLOWED) & (TARGET_MESH | TARGET_FIGURE | TARGET_PAGE))
            return true;
    return false;
}

/* Only where something is cut off. */
static crease_status trim(crease_context *context, const settings *s, report *r, result *all)
{
    const bool sound = all->trim != NULL;
    crease_status status = CREASE_OK;
    if (s->no_trim || s->method == METHOD_AVERAGING || all->whole)
        return CREASE_OK;
    if (!sound)
        status = crease_sheet_trim(context, all->sheet, &all->trim);
    bool keep = status == CREASE_OK && !crease_trim_is_whole(all->trim);
    if (keep && cad_is_there() && (!sound || is_drawn(s))) {
        status = cad_trim_mesh(context, all->trim, is_drawn(s) ? &all->mesh : NULL, &keep);
        if (!keep && status == CREASE_OK)
            report_line(r, "the sheet is not trimmed: its faces would not be valid");
    }
    if (!keep) {
        crease_trim_free(all->trim);
        all->trim = NULL;
    }
    return status;
}

static crease_status make_clouds(crease_context *context, const crease_cloud *cloud, result *all)
{
    const double *variance = crease_sheet_variance(all->sheet);
    const double *errors = crease_sheet_standard_errors(all->sheet);
    crease_field fields[3] = {
        {"deviation", CREASE_TYPE_FLOAT64, crease_sheet_deviations(all->sheet)}};
    size_t field_count = 1;
    if (errors)
        fields[field_count++] = (crease_field){"standard_error", CREASE_TYPE_FLOAT64, errors};
    if (variance)
        fields[field_count++] = (crease_field){"variance", CREASE_TYPE_FLOAT64, variance};
    const crease_cloud_parts parts = {.count = crease_cloud_count(cloud),
        .points = crease_sheet_projected(all->sheet),
        .fields = fields,
        .field_count = field_count,
        .coordinate_type = CREASE_TYPE_FLOAT64};
    crease_status status =
        crease_cloud_with_fields(context, cloud, fields, parts.field_count, &all->cloud);
    if (status == CREASE_OK)
        status = crease_cloud_create(context, &parts, &all->projected);
    return status;
}

static crease_status make_result(
    crease_context *context, const settings *s, report *r, const crease_cloud *cloud, result *all)
{
    crease_status status = all->sheet ? CREASE_OK : fit(context, s, cloud, &all->sheet);
    if (status == CREASE_OK)
        status = crease_sheet_faces(context, all->sheet, &all->faces, &all->face_count);
    if (status == CREASE_OK)
        status = make_lines(context, all);
    if (status == CREASE_OK)
        status = trim(context, s, r, all);
    if (status == CREASE_OK)
        status = make_clouds(context, cloud, all);
    return status;
}

static void describe_lines(report *r, const result *all)
{
    cJSON *list = cJSON_AddArrayToObject(r->root, "creases");
    for (size_t i = 0; i < all->line_count; i++) {
        const crease_line line = crease_sheet_line(all->sheet, i);
        cJSON *object = cJSON_CreateObject();
        cJSON_AddStringToObject(object, "constant", line.direction == 0 ? "u" : "v");
        cJSON_AddNumberToObject(object, "parameter", line.parameter);
        cJSON_AddNumberToObject(object, "angle", line.angle);
        cJSON_AddNumberToObject(object, "standard_error", line.standard_error);
        cJSON_AddItemToArray(list, object);
        report_line(r, "crease at %s = %.6g: dihedral angle %.2f degrees",
            line.direction == 0 ? "u" : "v", line.parameter, line.angle);
    }
}

/* A row of control points as text: of a large net, items for each number would take longer and more
 * memory than the fit. */
static cJSON *row_to_json(const double *points, size_t count)
{
    enum { LONGEST = 28 }; /* of a number, with what is beside it */
    const size_t room = 3 * LONGEST * count + sizeof "[]";
    char *const text = malloc(room);
    size_t length = 0;
    for (size_t i = 0; text && i < count; i++, points += 3)
        length += (size_t)snprintf(text + length, room - length, "%s[%.17g, %.17g, %.17g]",
            i ? ", " : "[", points[0], points[1], points[2]);
    if (text)
        memcpy(text + length, "]", sizeof "]");
    cJSON *const row = text ? cJSON_CreateRaw(text) : NULL;
    free(text);
    return row;
}

static void describe_surface(report *r, const crease_surface *surface)
{
    const crease_surface_parts parts = crease_surface_parts_of(surface);
    static const char *const directions[] = {"u", "v"};
    cJSON *object = cJSON_AddObjectToObject(r->root, "surface");
    for (int d = 0; d < 2; d++) {
        cJSON *one = cJSON_AddObjectToObject(object, directions[d]);
        cJSON_AddNumberToObject(one, "order", parts.order[d]);
        cJSON_AddItemToObject(one, "knots",
            cJSON_CreateDoubleArray(parts.knots[d], (int)parts.count[d] + parts.order[d]));
    }
    cJSON *net = cJSON_AddArrayToObject(object, "control_points");
    for (size_t i = 0; i < parts.count[0]; i++)
        cJSON_AddItemToArray(
            net, row_to_json(parts.control_points + 3 * i * parts.count[1], parts.count[1]));
}

static cJSON *curve_to_json(const crease_curve *curve)
{
    const int order = crease_curve_order(curve);
    const size_t count = crease_curve_count(curve);
    cJSON *object = cJSON_CreateObject(), *points = cJSON_CreateArray();
    cJSON_AddNumberToObject(object, "order", order);
    cJSON_AddItemToObject(
        object, "knots", cJSON_CreateDoubleArray(crease_curve_knots(curve), (int)count + order));
    for (size_t i = 0; i < count; i++)
        cJSON_AddItemToArray(
            points, cJSON_CreateDoubleArray(crease_curve_control_points(curve) + 3 * i, 2));
    cJSON_AddItemToObject(object, "control_points", points);
    return object;
}

/* Edges are numbered from 1 in loops, where those that run backwards are negative. */
static cJSON *loop_to_json(const crease_trim *from, size_t face, size_t loop)
{
    size_t count;
    const crease_trim_half *const halves = crease_trim_loop(from, face, loop, &count);
    cJSON *list = cJSON_CreateArray();
    for (size_t i = 0; i < count; i++) {
        const double number = (double)halves[i].edge + 1.0;
        cJSON_AddItemToArray(list, cJSON_CreateNumber(halves[i].reversed ? -number : number));
    }
    return list;
}

static void describe_trim(report *r, const result *all)
{
    size_t holes = 0;
    cJSON *object = cJSON_AddObjectToObject(r->root, "trim");
    cJSON *edges = cJSON_AddArrayToObject(object, "edges");
    cJSON *faces = cJSON_AddArrayToObject(object, "faces");
    for (size_t i = 0; i < crease_trim_edge_count(all->trim); i++)
        cJSON_AddItemToArray(edges, curve_to_json(crease_trim_edge_at(all->trim, i).curve));
    for (size_t f = 0; f < crease_trim_face_count(all->trim); f++) {
        cJSON *face = cJSON_CreateObject(), *loops = cJSON_AddArrayToObject(face, "loops");
        for (size_t l = 0; l < crease_trim_loop_count(all->trim, f); l++)
            cJSON_AddItemToArray(loops, loop_to_json(all->trim, f, l));
        holes += crease_trim_loop_count(all->trim, f) - 1;
        cJSON_AddItemToArray(faces, face);
    }
    report_line(r, "trimmed to the border of the points, holes inside faces: %zu", holes);
}

/* How exactly the sheet is known, over the points. */
static void describe_errors(report *r, const result *all)
{
    const double *errors = crease_sheet_standard_errors(all->sheet);
    if (!errors)
        return;
    const deviation_summary d = deviation_summarise(errors, crease_sheet_point_count(all->sheet));
    cJSON *object = cJSON_AddObjectToObject(r->root, "standard_error");
    cJSON_AddNumberToObject(object, "rms", d.rms);
    cJSON_AddNumberToObject(object, "p95", d.p95);
    cJSON_AddNumberToObject(object, "max", d.most);
}

static void describe(report *r, const result *all, const deviation_summary *of_all)
{
    const size_t faces = all->trim ? crease_trim_face_count(all->trim) : all->face_count;
    const size_t count = crease_sheet_point_count(all->sheet);
    const deviation_summary d =
        of_all ? *of_all : deviation_summarise(crease_sheet_deviations(all->sheet), count);
    const crease_surface_parts parts = crease_surface_parts_of(crease_sheet_surface(all->sheet));
    deviation_describe(cJSON_AddObjectToObject(r->root, "deviation"), d);
    describe_errors(r, all);
    cJSON_AddNumberToObject(r->root, "face_count", (double)faces);
    report_line(r, "%zu x %zu control points; faces: %zu, creases: %zu", parts.count[0],
        parts.count[1], faces, all->line_count);
    if (all->trim)
        describe_trim(r, all);
    describe_lines(r, all);
    report_line(r, "deviation: rms %.4g, 95 %% below %.4g, max %.4g", d.rms, d.p95, d.most);
    describe_surface(r, crease_sheet_surface(all->sheet));
}

static crease_status write_cad(crease_context *context, const void *from, const char *path)
{
    const result *const all = from;
    if (all->trim)
        return cad_write_trim(context, all->trim, path);
    return cad_write_surfaces(
        context, (const crease_surface *const *)all->faces, all->face_count, path);
}

static crease_status write_mesh(crease_context *context, const void *from, const char *path)
{
    const result *const all = from;
    if (all->mesh)
        return crease_mesh_write(context, all->mesh, path);
    crease_mesh *mesh = NULL;
    crease_status status = crease_mesh_create(
        context, (const crease_surface *const *)all->faces, all->face_count, 0.0, &mesh);
    if (status == CREASE_OK)
        status = crease_mesh_write(context, mesh, path);
    crease_mesh_free(mesh);
    return status;
}

/* The creases as far as the sheet goes. */
static const crease_curve *const *creases_of(const result *all, size_t *count)
{
    *count = all->trim ? crease_trim_crease_count(all->trim) : all->line_count;
    return all->trim ? crease_trim_creases(all->trim) : (const crease_curve *const *)all->lines;
}

static crease_status show(crease_context *context, const void *from, bool page, crease_scene *scene)
{
    const result *const all = from;
    const crease_surface *whole = crease_sheet_surface(all->sheet);
    const crease_surface_parts parts = crease_surface_parts_of(whole);
    const bool net = page || parts.count[0] * parts.count[1] <= MOST_NET_IN_FIGURE;
    size_t count;
    const crease_curve *const *const creases = creases_of(all, &count);
    crease_status status = CREASE_OK;
    if (!all->mesh)
        status = crease_scene_add_surfaces(context, scene, "surface", &whole, 1, net);
    else
        status = crease_scene_add_mesh(context, scene, "surface", all->mesh);
    if (status == CREASE_OK && all->mesh && net)
        status = crease_scene_add_nets(context, scene, "surface", &whole, 1);
    return status != CREASE_OK || count == 0
        ? status
        : crease_scene_add_curves(context, scene, "creases", creases, count);
}

static crease_status write_creases(
    crease_context *context, report *r, const void *from, const char *path)
{
    const result *const all = from;
    size_t count;
    const crease_curve *const *const lines = creases_of(all, &count);
    if (target_of(path, FIT_CREASES) == TARGET_CAD)
        return cad_write_creases(context, r, lines, count, path);
    return crease_curves_write(context, lines, count, 0.0, path);
}

static crease_status write_outputs(
    crease_context *context, const settings *s, report *r, const result *all)
{
    const outputs made = {.allowed = FIT_ALLOWED,
        .from = all,
        .cloud = all->cloud,
        .show = show,
        .cad = write_cad,
        .mesh = write_mesh,
        .creases = write_creases,
        .points = all->projected};
    return outputs_write(context, s, r, &made);
}

/* A sheet of points that lie one over another, as those of a whole part do, passes between them. */
static crease_status tell_of_layers(
    crease_context *context, report *r, const crease_cloud *cloud, const result *all)
{
    const size_t count = crease_cloud_count(cloud);
    const double *const points = crease_cloud_points(cloud);
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    bool suits = true;
    for (size_t i = 0; i < 3 * count; i++) {
        low[i % 3] = fmin(low[i % 3], points[i]);
        high[i % 3] = fmax(high[i % 3], points[i]);
    }
    const double spacing =
        hypot(hypot(high[0] - low[0], high[1] - low[1]), high[2] - low[2]) / sqrt((double)count);
    const deviation_summary d = deviation_summarise(crease_sheet_deviations(all->sheet), count);
    if (!(d.p95 > FAR_OFF * spacing))
        return CREASE_OK;
    const crease_status status = crease_sheet_suits(context, cloud, &suits);
    if (status == CREASE_OK && !suits)
        report_line(r,
            "these points lie one over another, and the sheet passes between them: take --method "
            "part for a closed part");
    return status;
}

void fit_ready_free(fit_ready *ready)
{
    crease_trim_free(ready->trim);
    crease_sheet_free(ready->sheet);
    *ready = (fit_ready){.sheet = NULL};
}

crease_status fit_sheet(crease_context *context, const settings *s, report *r,
    const crease_cloud *cloud, fit_ready *ready, const deviation_summary *of_all)
{
    result all = {.sheet = ready->sheet, .trim = ready->trim, .whole = ready->whole};
    *ready = (fit_ready){.sheet = NULL};
    crease_status status = make_result(context, s, r, cloud, &all);
    if (status == CREASE_OK) {
        report_stage(r, "fit");
        cJSON_AddStringToObject(r->root, "method", fit_method_names[s->method]);
        describe(r, &all, of_all);
        if (s->method == METHOD_SHEET)
            status = tell_of_layers(context, r, cloud, &all);
    }
    if (status == CREASE_OK)
        status = write_outputs(context, s, r, &all);
    result_free(&all);
    return status;
}
