/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* crease detect: which points lie on sharp edges. */
#include "command.h"
#include "input.h"
#include "target.h"

enum { ALLOWED = TARGET_CLOUD | TARGET_FIGURE | TARGET_PAGE | TARGET_REPORT };

static crease_status labelled(crease_context *context, const crease_cloud *cloud,
    const crease_scores *scores, crease_cloud **out)
{
    const crease_field fields[] = {
        {"variance", CREASE_TYPE_FLOAT64, crease_scores_variance(scores)},
        {"feature", CREASE_TYPE_UINT8, crease_scores_features(scores)},
    };
    return crease_cloud_with_fields(context, cloud, fields, 2, out);
}

static void describe(report *r, const crease_scores *scores)
{
    const size_t count = crease_scores_count(scores);
    const uint8_t *features = crease_scores_features(scores);
    size_t found = 0;
    for (size_t i = 0; i < count; i++)
        found += features[i];
    cJSON_AddNumberToObject(r->root, "features", (double)found);
    report_line(r, "%zu of %zu points lie on sharp edges (%.1f %%)", found, count,
        count ? 100.0 * (double)found / (double)count : 0.0);
}

static crease_status write_seen(
    crease_context *context, const settings *s, const crease_cloud *cloud, const char *path)
{
    crease_scene *scene = NULL;
    crease_figure_options figure = crease_figure_options_default();
    figure.colour_by = "feature";
    crease_status status = crease_scene_create(context, target_name(s->inputs[0]), &scene);
    if (status == CREASE_OK)
        status = crease_scene_add_cloud(context, scene, "points", cloud);
    if (status == CREASE_OK)
        status = target_of(path, ALLOWED) == TARGET_PAGE
            ? crease_page_write(context, scene, path)
            : crease_figure_write(context, scene, &figure, path);
    crease_scene_free(scene);
    return status;
}

static crease_status write_outputs(
    crease_context *context, const settings *s, report *r, const crease_cloud *cloud)
{
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < s->output_count && status == CREASE_OK; i++) {
        const char *path = s->outputs[i];
        const target_kind kind = target_of(path, ALLOWED);
        if (kind == TARGET_CLOUD)
            status = crease_cloud_write(context, cloud, path);
        else if (kind == TARGET_REPORT)
            status = target_write_report(context, r, path);
        else
            status = write_seen(context, s, cloud, path);
        if (status == CREASE_OK)
            report_line(r, "wrote %s", path);
    }
    report_stage(r, "write");
    return status == CREASE_OK ? target_write_report(context, r, s->report) : status;
}

crease_status detect_run(crease_context *context, const settings *s, report *r)
{
    crease_cloud *cloud = NULL, *result = NULL;
    crease_scores *scores = NULL;
    crease_status status = targets_check(context, s, ALLOWED);
    if (status == CREASE_OK)
        status = target_check(context, s->report, TARGET_REPORT);
    if (status == CREASE_OK)
        status = input_read(context, s, r, &cloud);
    if (status == CREASE_OK)
        status = crease_scores_compute(context, cloud, &s->detect, &scores);
    if (status == CREASE_OK) {
        report_stage(r, "scores");
        describe(r, scores);
        status = labelled(context, cloud, scores, &result);
    }
    if (status == CREASE_OK)
        status = write_outputs(context, s, r, result);
    crease_cloud_free(result);
    crease_scores_free(scores);
    crease_cloud_free(cloud);
    return status;
}
