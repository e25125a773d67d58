/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* crease info: what a cloud or a CAD model holds. */
#include "command.h"
#include "input.h"

#include <string.h>

#ifdef CREASE_HAVE_CAD
#include "crease/crease_cad.h"
#endif

static bool is_cad(const char *format)
{
    return format &&
        (strcmp(format, "STEP") == 0 || strcmp(format, "IGES") == 0 || strcmp(format, "BREP") == 0);
}

#ifdef CREASE_HAVE_CAD
static void add_counts(cJSON *model, const crease_cad_info *info)
{
    const struct {
        const char *name;
        size_t count;
    } counts[] = {{"solids", info->solids}, {"shells", info->shells},
        {"closed_shells", info->closed_shells}, {"faces", info->faces}, {"edges", info->edges},
        {"vertices", info->vertices}, {"free_edges", info->free_edges},
        {"sharp_edges", info->sharp_edges}, {"wire_edges", info->wire_edges},
        {"bspline_faces", info->bspline_faces}, {"plane_faces", info->plane_faces},
        {"other_faces", info->other_faces}};
    for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++)
        cJSON_AddNumberToObject(model, counts[i].name, (double)counts[i].count);
}

static void print_model(const report *r, const char *path, const crease_cad_info *info)
{
    report_line(r, "%s: %s%s%s, %s", path, info->format, info->schema[0] ? " " : "", info->schema,
        info->valid ? "valid" : "NOT valid");
    report_line(r, "  solids: %zu, shells: %zu (%zu closed), faces: %zu, edges: %zu, vertices: %zu",
        info->solids, info->shells, info->closed_shells, info->faces, info->edges, info->vertices);
    report_line(r, "  faces: %zu B-spline, %zu plane, %zu other", info->bspline_faces,
        info->plane_faces, info->other_faces);
    report_line(r, "  edges: %zu free, %zu sharp, %zu on no face", info->free_edges,
        info->sharp_edges, info->wire_edges);
    report_line(r, "  x %g to %g, y %g to %g, z %g to %g", info->lowest[0], info->highest[0],
        info->lowest[1], info->highest[1], info->lowest[2], info->highest[2]);
    report_line(r, "  area %g, volume %g, tolerance %g", info->area, info->volume, info->tolerance);
}

static crease_status describe_model(crease_context *context, const char *path, report *r)
{
    crease_cad_info info;
    const crease_status status = crease_cad_info_read(context, path, &info);
    if (status != CREASE_OK)
        return status;
    cJSON *model = cJSON_AddObjectToObject(r->root, "model");
    cJSON_AddStringToObject(model, "format", info.format);
    cJSON_AddStringToObject(model, "schema", info.schema);
    cJSON_AddBoolToObject(model, "valid", info.valid);
    add_counts(model, &info);
    report_vector(model, "lowest", info.lowest);
    report_vector(model, "highest", info.highest);
    cJSON_AddNumberToObject(model, "area", info.area);
    cJSON_AddNumberToObject(model, "volume", info.volume);
    cJSON_AddNumberToObject(model, "tolerance", info.tolerance);
    print_model(r, path, &info);
    return CREASE_OK;
}
#else
static crease_status describe_model(crease_context *context, const char *path, report *r)
{
    (void)r;
    return crease_context_fail(context, CREASE_ERROR_UNSUPPORTED,
        "%s: this build reads no CAD models; build with OpenCASCADE (CREASE_CAD=ON)", path);
}
#endif

static void print_cloud(const report *r, const crease_cloud *cloud)
{
    double lowest[3], highest[3];
    crease_cloud_bounds(cloud, lowest, highest);
    report_line(r, "  x %g to %g, y %g to %g, z %g to %g", lowest[0], highest[0], lowest[1],
        highest[1], lowest[2], highest[2]);
    report_line(r, "  coordinates: %s%s",
        crease_cloud_coordinate_type(cloud) == CREASE_TYPE_FLOAT64 ? "double" : "float",
        crease_cloud_normals(cloud) ? ", with normals" : "");
    const size_t count = crease_cloud_count(cloud);
    for (size_t i = 0; i < crease_cloud_field_count(cloud) && count; i++) {
        const crease_field field = crease_cloud_field(cloud, i);
        double low = crease_field_value(&field, 0), high = low;
        for (size_t j = 1; j < count; j++) {
            const double value = crease_field_value(&field, j);
            low = value < low ? value : low;
            high = value > high ? value : high;
        }
        report_line(r, "  field %s: %g to %g", field.name, low, high);
    }
}

crease_status info_run(crease_context *context, const settings *s, report *r)
{
    const char *path = NULL;
    crease_status status =
        input_path(context, s, "the file to read, or - for standard input", &path);
    if (status != CREASE_OK)
        return status;
    const char *format = strcmp(path, "-") == 0 ? NULL : crease_file_format(path);
    if (is_cad(format))
        return describe_model(context, path, r);
    crease_cloud *cloud = NULL;
    status = input_read(context, s, r, &cloud);
    if (status == CREASE_OK) {
        cJSON_AddStringToObject(r->root, "format", format ? format : "XYZ");
        print_cloud(r, cloud);
    }
    crease_cloud_free(cloud);
    return status;
}
