/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* crease example: clouds to try the other commands on. */
#include "command.h"
#include "input.h"
#include "target.h"

#include <string.h>

static crease_status make_cube(crease_context *context, const settings *s, crease_cloud **out)
{
    if (s->noise >= 0 || s->count)
        return crease_context_fail(context, CREASE_ERROR_ARGUMENT,
            "the cube is the paper's: it takes neither --noise nor --count");
    return crease_shape_cube(context, 32, out);
}

static crease_status make_sample(crease_context *context, const settings *s, crease_cloud **out)
{
    crease_sample_options options = crease_sample_options_default();
    if (s->count)
        return crease_context_fail(
            context, CREASE_ERROR_ARGUMENT, "the sample has 51 points: it takes no --count");
    if (s->noise >= 0)
        options.noise = s->noise;
    return crease_shape_sample(context, &options, out);
}

static crease_status make_panel(crease_context *context, const settings *s, crease_cloud **out)
{
    crease_panel_options options = crease_panel_options_default();
    if (s->noise >= 0)
        options.noise = s->noise;
    if (s->count)
        options.count = (size_t)s->count;
    return crease_shape_panel(context, &options, out);
}

static crease_status make_bracket(crease_context *context, const settings *s, crease_cloud **out)
{
    crease_bracket_options options = crease_bracket_options_default();
    if (s->noise >= 0)
        options.noise = s->noise;
    if (s->count)
        options.count = (size_t)s->count;
    return crease_shape_bracket(context, &options, out);
}

static const struct {
    const char *name;
    crease_status (*make)(crease_context *, const settings *, crease_cloud **);
} examples[] = {
    {"cube", make_cube}, {"sample", make_sample}, {"panel", make_panel}, {"bracket", make_bracket}};

static crease_status make(crease_context *context, const settings *s, crease_cloud **out)
{
    const char *name = NULL;
    const crease_status status = input_path(context, s, "cube, sample, panel or bracket", &name);
    if (status != CREASE_OK)
        return status;
    for (size_t i = 0; i < sizeof examples / sizeof examples[0]; i++)
        if (strcmp(examples[i].name, name) == 0)
            return examples[i].make(context, s, out);
    return crease_context_fail(context, CREASE_ERROR_ARGUMENT,
        "there is no example '%s'; it is cube, sample, panel or bracket", name);
}

crease_status example_run(crease_context *context, const settings *s, report *r)
{
    crease_cloud *cloud = NULL;
    crease_status status = targets_check(context, s, TARGET_CLOUD);
    if (status == CREASE_OK && s->output_count == 0)
        status = crease_context_fail(
            context, CREASE_ERROR_ARGUMENT, "-o FILE is missing: where the cloud goes");
    if (status == CREASE_OK)
        status = make(context, s, &cloud);
    if (status == CREASE_OK)
        input_describe(r, cloud);
    for (size_t i = 0; i < s->output_count && status == CREASE_OK; i++) {
        status = crease_cloud_write(context, cloud, s->outputs[i]);
        if (status == CREASE_OK)
            report_line(r, "wrote %s: %zu points", s->outputs[i], crease_cloud_count(cloud));
    }
    crease_cloud_free(cloud);
    return status;
}
