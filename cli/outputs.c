/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "outputs.h"

static crease_status write_seen(
    crease_context *context, const settings *s, const outputs *all, const char *path)
{
    const bool page = target_of(path, all->allowed) == TARGET_PAGE;
    crease_scene *scene = NULL;
    crease_figure_options figure = crease_figure_options_default();
    figure.colour_by = all->colour_by;
    crease_status status = crease_scene_create(context, target_name(s->inputs[0]), &scene);
    if (status == CREASE_OK)
        status = crease_scene_add_cloud(context, scene, "points", all->cloud);
    if (status == CREASE_OK && all->show)
        status = all->show(context, all->from, page, scene);
    if (status == CREASE_OK)
        status = page ? crease_page_write(context, scene, path)
                      : crease_figure_write(context, scene, &figure, path);
    crease_scene_free(scene);
    return status;
}

static crease_status write_one(
    crease_context *context, const settings *s, report *r, const outputs *all, const char *path)
{
    switch (target_of(path, all->allowed)) {
    case TARGET_CLOUD:
        return crease_cloud_write(context, all->cloud, path);
    case TARGET_CAD:
        return all->cad(context, all->from, path);
    case TARGET_MESH:
        return all->mesh(context, all->from, path);
    case TARGET_REPORT:
        return target_write_report(context, r, path);
    default:
        return write_seen(context, s, all, path);
    }
}

crease_status outputs_write(
    crease_context *context, const settings *s, report *r, const outputs *all)
{
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < s->output_count && status == CREASE_OK; i++) {
        status = write_one(context, s, r, all, s->outputs[i]);
        if (status == CREASE_OK)
            report_line(r, "wrote %s", s->outputs[i]);
    }
    if (status == CREASE_OK && s->creases)
        status = all->creases(context, r, all->from, s->creases);
    if (status == CREASE_OK && s->points) {
        status = crease_cloud_write(context, all->points, s->points);
        if (status == CREASE_OK)
            report_line(r, "wrote %s", s->points);
    }
    report_stage(r, "write");
    return status == CREASE_OK ? target_write_report(context, r, s->report) : status;
}
