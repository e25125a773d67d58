/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* crease compare: how far the points of a cloud are from a CAD model. */
#include "command.h"

#ifdef CREASE_HAVE_CAD
#include "crease/crease_cad.h"
#include "deviation.h"
#include "facts.h"
#include "input.h"
#include "outputs.h"

#include <stdlib.h>
#include <string.h>

enum { ALLOWED = TARGET_CLOUD | TARGET_FIGURE | TARGET_PAGE | TARGET_REPORT };

typedef struct comparison {
    crease_cad_model *model;
    crease_cloud *cloud;    /* with the fields */
    double *deviations;     /* of the points */
    int32_t *faces;         /* numbers of those they are nearest to */
    double **of_face;       /* the deviations of the points of every face, one after the other */
    size_t *points_of_face; /* how many there are */
    const cJSON *told;      /* what the report says of the faces */
} comparison;

static void comparison_free(comparison *c)
{
    free(c->of_face ? c->of_face[0] : NULL);
    free(c->of_face);
    free(c->points_of_face);
    free(c->deviations);
    free(c->faces);
    crease_cloud_free(c->cloud);
    crease_cad_model_free(c->model);
}

static crease_status no_memory(crease_context *context, size_t count)
{
    return crease_context_fail(context, CREASE_ERROR_NO_MEMORY,
        "memory ran out: %zu points are not to be had; use fewer", count);
}

/* ------------------------------------------------------------------------------- measuring -- */

static crease_status measure(crease_context *context, const crease_cloud *cloud, comparison *c)
{
    const size_t count = crease_cloud_count(cloud);
    const crease_mesh *const mesh = crease_cad_model_mesh(c->model);
    crease_mesh_foot *const feet = calloc(count ? count : 1, sizeof *feet);
    c->deviations = calloc(count ? count : 1, sizeof *c->deviations);
    c->faces = calloc(count ? count : 1, sizeof *c->faces);
    crease_status status = feet && c->deviations && c->faces
        ? crease_mesh_project(context, mesh, crease_cloud_points(cloud), count, feet)
        : no_memory(context, count);
    for (size_t i = 0; i < count && status == CREASE_OK; i++) {
        c->deviations[i] = feet[i].distance;
        c->faces[i] = (int32_t)crease_mesh_owners(mesh)[feet[i].triangle];
    }
    free(feet);
    return status;
}

static crease_status sort_by_face(crease_context *context, size_t count, comparison *c)
{
    const size_t faces = crease_cad_model_face_count(c->model);
    c->points_of_face = calloc(faces + 1, sizeof *c->points_of_face);
    c->of_face = calloc(faces + 1, sizeof *c->of_face);
    double *const sorted = malloc((count ? count : 1) * sizeof *sorted);
    if (c->of_face)
        c->of_face[0] = sorted;
    else
        free(sorted);
    if (!c->points_of_face || !c->of_face || !sorted)
        return no_memory(context, count);
    for (size_t i = 0; i < count; i++)
        c->points_of_face[c->faces[i]]++;
    for (size_t f = 1; f < faces; f++)
        c->of_face[f] = c->of_face[f - 1] + c->points_of_face[f - 1];
    memset(c->points_of_face, 0, faces * sizeof *c->points_of_face);
    for (size_t i = 0; i < count; i++) {
        const int32_t f = c->faces[i];
        c->of_face[f][c->points_of_face[f]++] = c->deviations[i];
    }
    return CREASE_OK;
}

static crease_status label(crease_context *context, const crease_cloud *cloud, comparison *c)
{
    const crease_field fields[] = {
        {"deviation", CREASE_TYPE_FLOAT64, c->deviations},
        {"face", CREASE_TYPE_INT32, c->faces},
    };
    return crease_cloud_with_fields(context, cloud, fields, 2, &c->cloud);
}

/* --------------------------------------------------------------------------------- telling -- */

static const cJSON *describe_faces(report *r, const comparison *c)
{
    static const char *const types[] = {
        "plane", "sphere", "cylinder", "cone", "torus", "free form"};
    cJSON *list = cJSON_AddArrayToObject(r->root, "faces");
    for (size_t f = 0; f < crease_cad_model_face_count(c->model); f++) {
        const crease_cad_face face = crease_cad_model_face(c->model, f);
        cJSON *object = cJSON_CreateObject();
        cJSON_AddStringToObject(object, "type", types[face.type]);
        cJSON_AddNumberToObject(object, "area", face.area);
        cJSON_AddNumberToObject(object, "points", (double)c->points_of_face[f]);
        deviation_describe(object, deviation_summarise(c->of_face[f], c->points_of_face[f]));
        cJSON_AddItemToArray(list, object);
    }
    return list;
}

static void describe(report *r, comparison *c, size_t count)
{
    const deviation_summary all = deviation_summarise(c->deviations, count);
    cJSON *object = cJSON_AddObjectToObject(r->root, "deviation");
    deviation_describe(object, all);
    size_t bare = 0;
    for (size_t f = 0; f < crease_cad_model_face_count(c->model); f++)
        bare += c->points_of_face[f] == 0;
    c->told = describe_faces(r, c);
    report_line(
        r, "%zu faces, %zu of them without a point", crease_cad_model_face_count(c->model), bare);
    report_line(r, "deviation: mean %+.4g, rms %.4g, 95 %% within %.4g, all within %.4g", all.mean,
        all.rms, all.p95, all.most);
}

/* --------------------------------------------------------------------------------- writing -- */

static crease_status show(crease_context *context, const void *from, bool page, crease_scene *scene)
{
    (void)page;
    const comparison *const c = from;
    const crease_status status =
        crease_scene_add_mesh(context, scene, "model", crease_cad_model_mesh(c->model));
    return status == CREASE_OK ? facts_show(context, scene, c->told) : status;
}

static crease_status compare(
    crease_context *context, const settings *s, report *r, const crease_cloud *cloud, comparison *c)
{
    const size_t count = crease_cloud_count(cloud);
    crease_status status = crease_cad_model_read(context, s->inputs[0], 0, &c->model);
    if (status != CREASE_OK)
        return status;
    report_stage(r, "model");
    status = measure(context, cloud, c);
    if (status == CREASE_OK)
        status = sort_by_face(context, count, c);
    if (status == CREASE_OK)
        status = label(context, cloud, c);
    if (status != CREASE_OK)
        return status;
    report_stage(r, "deviations");
    describe(r, c, count);
    const outputs all = {
        .allowed = ALLOWED, .from = c, .cloud = c->cloud, .colour_by = "deviation", .show = show};
    return outputs_write(context, s, r, &all);
}

crease_status compare_run(crease_context *context, const settings *s, report *r)
{
    crease_cloud *cloud = NULL;
    comparison c = {0};
    crease_status status = s->input_count == 2
        ? targets_check(context, s, ALLOWED)
        : crease_context_fail(context, CREASE_ERROR_ARGUMENT,
              "an argument is missing: the CAD model, then the cloud");
    if (status == CREASE_OK)
        status = target_check(context, s->report, TARGET_REPORT);
    if (status == CREASE_OK)
        status = input_read(context, s, r, &cloud);
    if (status == CREASE_OK)
        status = compare(context, s, r, cloud, &c);
    comparison_free(&c);
    crease_cloud_free(cloud);
    return status;
}
#else
crease_status compare_run(crease_context *context, const settings *s, report *r)
{
    (void)s, (void)r;
    return crease_context_fail(context, CREASE_ERROR_UNSUPPORTED,
        "this build reads no CAD models; build with OpenCASCADE (CREASE_CAD=ON)");
}
#endif
