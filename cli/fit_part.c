/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* crease fit, a whole part: a face for every smooth region, edges where they meet. */
#include "fit.h"

#ifdef CREASE_HAVE_CAD
#include "cad.h"
#include "crease/crease_cad.h"
#include "deviation.h"
#include "engine.h"
#include "facts.h"
#include "option.h"
#include "outputs.h"
#include "region.h"

#include <stdlib.h>
#include <string.h>

/* Times as far from a shell as from a sheet, for 95 % of the points: then the sheet is taken. */
static const double FURTHER = 2.0;

/* What the fit has brought: everything that is written. */
typedef struct result {
    crease_regions *regions;
    crease_network *network;
    crease_part *part;
    const crease_curve **sharp; /* curves of the edges that are creases */
    size_t sharp_count;
    crease_cloud *cloud;              /* the input with deviation and face */
    crease_cloud *projected;          /* the same on the part */
    const cJSON *of_faces, *of_edges; /* what the report says of each */
} result;

static void result_free(result *all)
{
    free(all->sharp);
    crease_cloud_free(all->projected);
    crease_cloud_free(all->cloud);
    crease_part_free(all->part);
    crease_network_free(all->network);
    crease_regions_free(all->regions);
}

static crease_status no_memory(crease_context *context, size_t count)
{
    return crease_context_fail(context, CREASE_ERROR_NO_MEMORY,
        "memory ran out: %zu numbers are not to be had; use fewer points", count);
}

/* ---------------------------------------------------------------------------------- fitting -- */

static crease_status project(
    crease_context *context, const crease_cloud *cloud, const crease_cloud_parts *like, result *all)
{
    const size_t count = crease_cloud_count(cloud);
    crease_mesh_foot *feet = calloc(count ? count : 1, sizeof *feet);
    double *places = calloc(count ? count : 1, 3 * sizeof *places);
    crease_status status = feet && places
        ? crease_mesh_project(
              context, crease_part_mesh(all->part), crease_cloud_points(cloud), count, feet)
        : no_memory(context, 3 * count);
    for (size_t i = 0; i < count && status == CREASE_OK; i++)
        memcpy(places + 3 * i, feet[i].point, sizeof feet[i].point);
    crease_cloud_parts parts = *like;
    parts.points = places;
    if (status == CREASE_OK)
        status = crease_cloud_create(context, &parts, &all->projected);
    free(places);
    free(feet);
    return status;
}

static crease_status make_clouds(
    crease_context *context, const settings *s, const crease_cloud *cloud, result *all)
{
    const crease_field fields[] = {
        {"deviation", CREASE_TYPE_FLOAT64, crease_part_deviations(all->part)},
        {"face", CREASE_TYPE_INT32, crease_part_nearest_faces(all->part)},
    };
    const crease_cloud_parts parts = {.count = crease_cloud_count(cloud),
        .fields = fields,
        .field_count = 2,
        .coordinate_type = CREASE_TYPE_FLOAT64};
    const crease_status status = crease_cloud_with_fields(context, cloud, fields, 2, &all->cloud);
    return status == CREASE_OK && s->points ? project(context, cloud, &parts, all) : status;
}

/* What an edge is, and the name of its layer on the page. */
typedef enum edge_kind { EDGE_SHARP, EDGE_SMOOTH, EDGE_FREE, EDGE_SEAM, EDGE_KINDS } edge_kind;

static const char *const edge_names[EDGE_KINDS] = {"creases", "smooth edges", "borders", "seams"};

/* Creases are the edges of two faces that meet at an angle. */
static edge_kind kind_of(const crease_part *part, size_t index)
{
    const crease_part_edge edge = crease_part_edge_at(part, index);
    if (edge.faces[1] == UINT32_MAX)
        return EDGE_FREE;
    if (edge.faces[0] == edge.faces[1])
        return EDGE_SEAM;
    return edge.smooth ? EDGE_SMOOTH : EDGE_SHARP;
}

static crease_status pick_sharp(crease_context *context, result *all)
{
    const size_t count = crease_part_edge_count(all->part);
    all->sharp = calloc(count ? count : 1, sizeof *all->sharp);
    if (!all->sharp)
        return no_memory(context, count);
    for (size_t i = 0; i < count; i++)
        if (kind_of(all->part, i) == EDGE_SHARP)
            all->sharp[all->sharp_count++] = crease_part_curves(all->part)[i];
    return CREASE_OK;
}

static crease_status build(
    crease_context *context, const settings *s, report *r, const crease_cloud *cloud, result *all)
{
    crease_part_options options = crease_part_options_default();
    options.bspline_faces = s->faces == FACES_BSPLINE;
    options.open = s->method == METHOD_SHELL;
    crease_regions_options splitting = s->regions;
    splitting.united = options.open;
    crease_status status = engine_regions(context, cloud, &splitting, &all->regions);
    if (status == CREASE_OK && !s->no_snap)
        status = crease_regions_snap(context, all->regions);
    if (status != CREASE_OK)
        return status;
    report_stage(r, "regions");
    status = crease_network_find(context, all->regions, NULL, &all->network);
    if (status != CREASE_OK)
        return status;
    report_stage(r, "creases");
    status = crease_part_build(context, cloud, all->regions, all->network, &options, &all->part);
    if (status == CREASE_OK)
        status = make_clouds(context, s, cloud, all);
    if (status == CREASE_OK)
        status = pick_sharp(context, all);
    report_stage(r, "part");
    return status;
}

/* --------------------------------------------------------------------------------- telling -- */

static const crease_regions *regions_of(const result *all)
{
    return crease_part_regions(all->part);
}

static cJSON *face_object(const result *all, size_t index)
{
    const crease_part_face face = crease_part_face_at(all->part, index);
    const crease_region region = crease_regions_at(regions_of(all), face.region);
    const deviation_summary d = {face.mean, face.rms, face.p95, face.most};
    cJSON *object = cJSON_CreateObject();
    cJSON_AddNumberToObject(object, "region", face.region);
    region_describe(object, &region);
    cJSON_AddNumberToObject(object, "area", face.area);
    cJSON_AddNumberToObject(object, "points", (double)face.point_count);
    deviation_describe(object, d);
    return object;
}

static cJSON *edge_object(const result *all, size_t index)
{
    const crease_part_edge edge = crease_part_edge_at(all->part, index);
    cJSON *object = cJSON_CreateObject();
    cJSON *faces = cJSON_AddArrayToObject(object, "faces");
    cJSON_AddItemToArray(faces, cJSON_CreateNumber(edge.faces[0]));
    if (edge.faces[1] != UINT32_MAX)
        cJSON_AddItemToArray(faces, cJSON_CreateNumber(edge.faces[1]));
    cJSON_AddBoolToObject(object, "smooth", edge.smooth);
    cJSON_AddNumberToObject(object, "length", edge.length);
    cJSON_AddNumberToObject(object, "angle", edge.angle);
    return object;
}

static void describe_lists(report *r, result *all)
{
    cJSON *faces = cJSON_AddArrayToObject(r->root, "faces");
    for (size_t i = 0; i < crease_part_face_count(all->part); i++)
        cJSON_AddItemToArray(faces, face_object(all, i));
    cJSON *edges = cJSON_AddArrayToObject(r->root, "edges");
    for (size_t i = 0; i < crease_part_edge_count(all->part); i++)
        cJSON_AddItemToArray(edges, edge_object(all, i));
    all->of_faces = faces;
    all->of_edges = edges;
}

static void describe_kinds(report *r, const result *all)
{
    region_counts counts = {0};
    char text[160];
    for (size_t i = 0; i < crease_part_face_count(all->part); i++)
        counts.of[crease_regions_at(regions_of(all), crease_part_face_at(all->part, i).region)
                      .type]++;
    region_counts_text(&counts, text, sizeof text);
    const size_t faces = crease_part_face_count(all->part);
    const size_t edges = crease_part_edge_count(all->part);
    report_line(r, "%zu face%s: %s; %zu edge%s, %zu of them sharp", faces, faces == 1 ? "" : "s",
        text, edges, edges == 1 ? "" : "s", all->sharp_count);
}

/* What was snapped, by the numbers of the regions. */
static void describe_snaps(report *r, const result *all)
{
    static const char *const names[] = {
        "parallel", "perpendicular", "coaxial", "equal radii", "symmetric"};
    cJSON *list = cJSON_AddArrayToObject(r->root, "snapped");
    for (size_t i = 0; i < crease_regions_snap_count(regions_of(all)); i++) {
        const crease_snap snap = crease_regions_snap_at(regions_of(all), i);
        cJSON *object = cJSON_CreateObject();
        cJSON_AddStringToObject(object, "to", names[snap.kind]);
        cJSON *regions = cJSON_AddArrayToObject(object, "regions");
        for (size_t k = 0; k < snap.region_count; k++)
            cJSON_AddItemToArray(regions, cJSON_CreateNumber(snap.regions[k]));
        cJSON_AddItemToArray(list, object);
    }
}

/* How many of each kind. */
static void tell_snaps(const report *r, const result *all)
{
    size_t counts[CREASE_SNAP_SYMMETRIC + 1] = {0};
    const size_t count = crease_regions_snap_count(regions_of(all));
    for (size_t i = 0; i < count; i++)
        counts[crease_regions_snap_at(regions_of(all), i).kind]++;
    if (count > 0)
        report_line(r,
            "snapped within their errors: %zu parallel, %zu perpendicular, %zu coaxial, %zu equal "
            "radii, %zu symmetric",
            counts[CREASE_SNAP_PARALLEL], counts[CREASE_SNAP_PERPENDICULAR],
            counts[CREASE_SNAP_COAXIAL], counts[CREASE_SNAP_EQUAL_RADII],
            counts[CREASE_SNAP_SYMMETRIC]);
}

/* What is in the model besides the regions as found. */
static void tell_changes(report *r, const result *all)
{
    const size_t unseen = crease_part_unseen_count(all->part);
    if (unseen > 0)
        report_line(r,
            unseen == 1 ? "1 face that no point shows is where its neighbours end"
                        : "%zu faces that no point shows are where their neighbours end",
            unseen);
    else if (regions_of(all) != all->regions)
        report_line(
            r, "regions that join without an angle were united: as found they do not close");
}

static void describe(report *r, result *all)
{
    static const char *const states[] = {"solid", "shell", "faces"};
    const crease_part_state state = crease_part_state_of(all->part);
    const char *why = crease_part_message(all->part);
    const double volume = crease_part_volume(all->part);
    const size_t solids = crease_part_solid_count(all->part);
    const deviation_summary d =
        deviation_summarise(crease_part_deviations(all->part), crease_cloud_count(all->cloud));
    cJSON *object = cJSON_AddObjectToObject(r->root, "part");
    cJSON_AddStringToObject(object, "state", states[state]);
    cJSON_AddStringToObject(object, "why", why);
    cJSON_AddNumberToObject(object, "solids", (double)solids);
    cJSON_AddNumberToObject(object, "volume", volume);
    cJSON_AddBoolToObject(object, "united",
        regions_of(all) != all->regions && crease_part_unseen_count(all->part) == 0);
    cJSON_AddNumberToObject(object, "unseen", (double)crease_part_unseen_count(all->part));
    cJSON_AddNumberToObject(r->root, "noise", crease_regions_sigma(regions_of(all)));
    deviation_describe(cJSON_AddObjectToObject(r->root, "deviation"), d);
    describe_lists(r, all);
    describe_snaps(r, all);
    if (solids > 1)
        report_line(r, "%zu closed, valid solids, volume %.6g%s%s", solids, volume,
            *why ? "; but " : "", why);
    else if (state == CREASE_PART_SOLID)
        report_line(r, "a closed, valid solid, volume %.6g%s%s", volume, *why ? "; but " : "", why);
    else
        report_line(r, "%s", why);
    tell_changes(r, all);
    describe_kinds(r, all);
    tell_snaps(r, all);
    report_line(r, "deviation: rms %.4g, 95 %% below %.4g, max %.4g; noise %.2g", d.rms, d.p95,
        d.most, crease_regions_sigma(regions_of(all)));
}

/* --------------------------------------------------------------------------------- writing -- */

/* The edges of one kind, with what the report says of them. */
static crease_status show_edges(
    crease_context *context, const result *all, edge_kind kind, crease_scene *scene)
{
    const size_t most = crease_part_edge_count(all->part);
    const crease_curve **curves = calloc(most ? most : 1, sizeof *curves);
    size_t *edges = calloc(most ? most : 1, sizeof *edges), count = 0;
    crease_status status = curves && edges ? CREASE_OK : no_memory(context, most);
    for (size_t i = 0; i < most && status == CREASE_OK; i++)
        if (kind_of(all->part, i) == kind) {
            curves[count] = crease_part_curves(all->part)[i];
            edges[count++] = i;
        }
    if (status == CREASE_OK && count > 0)
        status = crease_scene_add_curves(context, scene, edge_names[kind], curves, count);
    for (size_t i = 0; i < count && status == CREASE_OK; i++) {
        const crease_fact number = {
            .name = "edge", .numbers = {(double)edges[i]}, .number_count = 1};
        status = crease_scene_describe(context, scene, i, &number, 1);
        if (status == CREASE_OK)
            status =
                facts_show_one(context, scene, i, cJSON_GetArrayItem(all->of_edges, (int)edges[i]));
    }
    free(edges);
    free(curves);
    return status;
}

/* A figure shows the creases alone; the page every edge, to switch on and off. */
static crease_status show(crease_context *context, const void *from, bool page, crease_scene *scene)
{
    const result *const all = from;
    crease_status status =
        crease_scene_add_mesh(context, scene, "faces", crease_part_mesh(all->part));
    if (status == CREASE_OK)
        status = facts_show(context, scene, all->of_faces);
    for (int kind = 0; kind < (page ? EDGE_KINDS : EDGE_SHARP + 1) && status == CREASE_OK; kind++)
        status = show_edges(context, all, (edge_kind)kind, scene);
    return status;
}

static crease_status write_cad(crease_context *context, const void *from, const char *path)
{
    return crease_part_write(context, ((const result *)from)->part, path);
}

static crease_status write_mesh(crease_context *context, const void *from, const char *path)
{
    return crease_mesh_write(context, crease_part_mesh(((const result *)from)->part), path);
}

static crease_status write_creases(
    crease_context *context, report *r, const void *from, const char *path)
{
    const result *const all = from;
    if (target_of(path, FIT_CREASES) == TARGET_CAD)
        return cad_write_creases(context, r, all->sharp, all->sharp_count, path);
    return crease_curves_write(context, all->sharp, all->sharp_count, 0.0, path);
}

static crease_status write_outputs(
    crease_context *context, const settings *s, report *r, const result *all)
{
    const outputs made = {.allowed = FIT_ALLOWED,
        .from = all,
        .cloud = all->cloud,
        .colour_by = "deviation",
        .show = show,
        .cad = write_cad,
        .mesh = write_mesh,
        .creases = write_creases,
        .points = all->projected};
    return outputs_write(context, s, r, &made);
}

/* Whether a sheet is the better model: faces that a shell lacks leave points far from it. */
static bool is_worse(const result *all, const crease_sheet *rival)
{
    const size_t count = crease_cloud_count(all->cloud);
    const double *const from_part = crease_part_deviations(all->part);
    const double *const from_sheet = crease_sheet_deviations(rival);
    return crease_part_state_of(all->part) != CREASE_PART_SHELL ||
        deviation_summarise(from_part, count).p95 >
        FURTHER * deviation_summarise(from_sheet, count).p95;
}

crease_status fit_part(crease_context *context, const settings *s, report *r,
    const crease_cloud *cloud, const crease_sheet *rival, bool *instead)
{
    result all = {0};
    crease_status status = build(context, s, r, cloud, &all);
    *instead = status == CREASE_OK && rival && is_worse(&all, rival);
    if (status == CREASE_OK && !*instead) {
        cJSON_AddStringToObject(r->root, "method", fit_method_names[s->method]);
        describe(r, &all);
        status = write_outputs(context, s, r, &all);
    }
    result_free(&all);
    return status;
}
#else
crease_status fit_part(crease_context *context, const settings *s, report *r,
    const crease_cloud *cloud, const crease_sheet *rival, bool *instead)
{
    (void)r, (void)cloud, (void)rival, (void)instead;
    return crease_context_fail(context, CREASE_ERROR_UNSUPPORTED,
        "%s: this build joins no faces to a part; build with OpenCASCADE (CREASE_CAD=ON), or fit "
        "a sheet (--method sheet)",
        s->inputs[0]);
}
#endif
