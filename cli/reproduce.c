/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* crease reproduce: the paper's experiment, figures and numbers. */
#include "command.h"
#include "figures.h"
#include "study.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>

static crease_status make_folder(crease_context *context, const char *folder)
{
    struct stat there;
    if (mkdir(folder, 0777) == 0 || (stat(folder, &there) == 0 && S_ISDIR(there.st_mode)))
        return CREASE_OK;
    return crease_context_fail(context, CREASE_ERROR_CANNOT_WRITE,
        "%s: the folder cannot be made (%s)", folder, strerror(errno));
}

/* The cube and the four samples, for those who want to try other programs on them. */
static crease_status write_clouds(crease_context *context, const char *folder, report *r)
{
    static const struct {
        const char *name;
        int across, along;
        bool roof;
    } samples[] = {{"sample_17x3_roof.ply", 17, 3, true}, {"sample_3x17_roof.ply", 3, 17, true},
        {"sample_17x3.ply", 17, 3, false}, {"sample_3x17.ply", 3, 17, false}};
    crease_cloud *cloud = NULL;
    char path[4096];
    crease_status status = crease_shape_cube(context, 32, &cloud);
    snprintf(path, sizeof path, "%s/cube.ply", folder);
    if (status == CREASE_OK)
        status = crease_cloud_write(context, cloud, path);
    crease_cloud_free(cloud);
    for (size_t i = 0; i < sizeof samples / sizeof samples[0] && status == CREASE_OK; i++) {
        crease_sample_options options = crease_sample_options_default();
        options.across = samples[i].across, options.along = samples[i].along;
        options.roof = samples[i].roof;
        snprintf(path, sizeof path, "%s/%s", folder, samples[i].name);
        status = crease_shape_sample(context, &options, &cloud);
        if (status == CREASE_OK)
            status = crease_cloud_write(context, cloud, path);
        if (status == CREASE_OK)
            crease_cloud_free(cloud);
    }
    if (status == CREASE_OK)
        report_line(r, "wrote %s/cube.ply and %s/sample_*.ply", folder, folder);
    return status;
}

crease_status reproduce_run(crease_context *context, const settings *s, report *r)
{
    if (s->output_count != 1)
        return crease_context_fail(
            context, CREASE_ERROR_ARGUMENT, "give one folder to write into: -o FOLDER");
    if (s->input_count)
        return crease_context_fail(context, CREASE_ERROR_ARGUMENT,
            "'%s': this command reads nothing; it makes the paper's clouds itself", s->inputs[0]);
    const char *folder = s->outputs[0];
    crease_status status = make_folder(context, folder);
    if (status == CREASE_OK)
        status = write_clouds(context, folder, r);
    if (status == CREASE_OK)
        status = figures_write(context, folder, r);
    report_stage(r, "figures");
    if (status == CREASE_OK)
        status = study_write(context, s->seeds, folder, r);
    report_stage(r, "study");
    return status;
}
