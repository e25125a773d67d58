/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* crease fit, one sheet: a surface that keeps its sharp edges. */
#include "fit.h"

#include "cad.h"
#include "deviation.h"
#include "option.h"
#include "outputs.h"

#include <math.h>
#include <stdlib.h>

/* A larger net would hide in a figure what it surrounds; on the page it can be switched off. */
enum { MOST_NET_IN_FIGURE = 100 };
/* What the fit has brought: everything that is written. */
typedef struct result {
    crease_sheet *sheet;
    crease_surface **faces;
    size_t face_count;
    crease_curve **lines;
    size_t line_count;
    crease_cloud *cloud;     /* the input with variance and deviation */
    crease_cloud *projected; /* the same on the surface */
} result;

static void result_free(result *all)
{
    for (size_t i = 0; i < all->line_count; i++)
        crease_curve_free(all->lines[i]);
    free(all->lines);
    crease_surfaces_free(all->faces, all->face_count);
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

static crease_status make_clouds(crease_context *context, const crease_cloud *cloud, result *all)
{
    const double *variance = crease_sheet_variance(all->sheet);
    const crease_field fields[] = {
        {"deviation", CREASE_TYPE_FLOAT64, crease_sheet_deviations(all->sheet)},
        {"variance", CREASE_TYPE_FLOAT64, variance},
    };
    const crease_cloud_parts parts = {.count = crease_cloud_count(cloud),
        .points = crease_sheet_projected(all->sheet),
        .fields = fields,
        .field_count = variance ? 2 : 1,
        .coordinate_type = CREASE_TYPE_FLOAT64};
    crease_status status =
        crease_cloud_with_fields(context, cloud, fields, parts.field_count, &all->cloud);
    if (status == CREASE_OK)
        status = crease_cloud_create(context, &parts, &all->projected);
    return status;
}

static crease_status make_result(
    crease_context *context, const settings *s, const crease_cloud *cloud, result *all)
{
    crease_status status = all->sheet ? CREASE_OK : fit(context, s, cloud, &all->sheet);
    if (status == CREASE_OK)
        status = crease_sheet_faces(context, all->sheet, &all->faces, &all->face_count);
    if (status == CREASE_OK)
        status = make_lines(context, all);
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
    for (size_t i = 0; i < parts.count[0]; i++) {
        cJSON *row = cJSON_CreateArray();
        for (size_t j = 0; j < parts.count[1]; j++)
            cJSON_AddItemToArray(row,
                cJSON_CreateDoubleArray(parts.control_points + 3 * (i * parts.count[1] + j), 3));
        cJSON_AddItemToArray(net, row);
    }
}

static void describe(report *r, const result *all)
{
    const size_t count = crease_sheet_point_count(all->sheet);
    const deviation_summary d = deviation_summarise(crease_sheet_deviations(all->sheet), count);
    const crease_surface_parts parts = crease_surface_parts_of(crease_sheet_surface(all->sheet));
    deviation_describe(cJSON_AddObjectToObject(r->root, "deviation"), d);
    cJSON_AddNumberToObject(r->root, "face_count", (double)all->face_count);
    report_line(r, "%zu x %zu control points, %zu faces, %zu creases", parts.count[0],
        parts.count[1], all->face_count, all->line_count);
    describe_lines(r, all);
    report_line(r, "deviation: rms %.4g, 95 %% below %.4g, max %.4g", d.rms, d.p95, d.most);
    describe_surface(r, crease_sheet_surface(all->sheet));
}

static crease_status write_cad(crease_context *context, const void *from, const char *path)
{
    const result *const all = from;
    return cad_write_surfaces(
        context, (const crease_surface *const *)all->faces, all->face_count, path);
}

static crease_status write_mesh(crease_context *context, const void *from, const char *path)
{
    const result *const all = from;
    crease_mesh *mesh = NULL;
    crease_status status = crease_mesh_create(
        context, (const crease_surface *const *)all->faces, all->face_count, 0.0, &mesh);
    if (status == CREASE_OK)
        status = crease_mesh_write(context, mesh, path);
    crease_mesh_free(mesh);
    return status;
}

static crease_status show(crease_context *context, const void *from, bool page, crease_scene *scene)
{
    const result *const all = from;
    const crease_surface *whole = crease_sheet_surface(all->sheet);
    const crease_surface_parts parts = crease_surface_parts_of(whole);
    const bool net = page || parts.count[0] * parts.count[1] <= MOST_NET_IN_FIGURE;
    const crease_status status =
        crease_scene_add_surfaces(context, scene, "surface", &whole, 1, net);
    return status != CREASE_OK || all->line_count == 0
        ? status
        : crease_scene_add_curves(
              context, scene, "creases", (const crease_curve *const *)all->lines, all->line_count);
}

static crease_status write_creases(
    crease_context *context, report *r, const void *from, const char *path)
{
    const result *const all = from;
    const crease_curve *const *lines = (const crease_curve *const *)all->lines;
    if (target_of(path, FIT_CREASES) == TARGET_CAD)
        return cad_write_creases(context, r, lines, all->line_count, path);
    return crease_curves_write(context, lines, all->line_count, 0.0, path);
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

crease_status fit_sheet(crease_context *context, const settings *s, report *r,
    const crease_cloud *cloud, crease_sheet *ready)
{
    result all = {.sheet = ready};
    crease_status status = make_result(context, s, cloud, &all);
    if (status == CREASE_OK) {
        report_stage(r, "fit");
        cJSON_AddStringToObject(r->root, "method", fit_method_names[s->method]);
        describe(r, &all);
        status = write_outputs(context, s, r, &all);
    }
    result_free(&all);
    return status;
}
