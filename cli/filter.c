/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* crease filter: less noise, edges kept, outliers set aside. */
#include "command.h"
#include "input.h"
#include "target.h"

enum { ALLOWED = TARGET_CLOUD | TARGET_FIGURE | TARGET_PAGE | TARGET_REPORT };

static void describe(report *r, const settings *s, const crease_filtered *filtered)
{
    const size_t outliers = crease_filtered_outlier_count(filtered);
    const double spacing = crease_filtered_spacing(filtered);
    cJSON_AddNumberToObject(r->root, "outliers", (double)outliers);
    cJSON_AddNumberToObject(r->root, "spacing", spacing);
    cJSON_AddNumberToObject(r->root, "noise_before", crease_filtered_sigma(filtered));
    cJSON_AddNumberToObject(r->root, "noise_after", crease_filtered_sigma_after(filtered));
    cJSON_AddNumberToObject(r->root, "movement", crease_filtered_movement(filtered));
    report_line(r, "outliers: %zu, %s", outliers,
        s->filter.remove_outliers ? "left out" : "marked in the field `outlier`");
    report_line(r, "noise %.2g before, %.2g after; moved by %.2g (rms); spacing %.4g",
        crease_filtered_sigma(filtered), crease_filtered_sigma_after(filtered),
        crease_filtered_movement(filtered), spacing);
}

static crease_status write_seen(
    crease_context *context, const settings *s, const crease_cloud *cloud, const char *path)
{
    crease_scene *scene = NULL;
    crease_figure_options figure = crease_figure_options_default();
    figure.colour_by = s->filter.remove_outliers ? NULL : "outlier";
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

crease_status filter_run(crease_context *context, const settings *s, report *r)
{
    crease_cloud *cloud = NULL;
    crease_filtered *filtered = NULL;
    crease_status status = targets_check(context, s, ALLOWED);
    if (status == CREASE_OK)
        status = target_check(context, s->report, TARGET_REPORT);
    if (status == CREASE_OK)
        status = input_read(context, s, r, &cloud);
    if (status == CREASE_OK)
        status = crease_cloud_filter(context, cloud, &s->filter, &filtered);
    if (status == CREASE_OK) {
        report_stage(r, "filter");
        describe(r, s, filtered);
        status = write_outputs(context, s, r, crease_filtered_cloud(filtered));
    }
    crease_filtered_free(filtered);
    crease_cloud_free(cloud);
    return status;
}
