/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* crease fit: chooses between a sheet, a shell and a part. */
#include "fit.h"

#include "cad.h"
#include "engine.h"

#include "command.h"
#include "input.h"
#include "limit.h"

#include "crease/crease_stream.h"

/* With fewer points there are no regions to speak of. */
enum { LEAST_FOR_SHELL = 500 };

static crease_status check(crease_context *context, const settings *s)
{
    crease_status status = targets_check(context, s, FIT_ALLOWED);
    if (status == CREASE_OK)
        status = target_check(context, s->creases, FIT_CREASES);
    if (status == CREASE_OK)
        status = target_check(context, s->points, TARGET_CLOUD);
    return status == CREASE_OK ? target_check(context, s->report, TARGET_REPORT) : status;
}

/* What the choice of a method has come to. */
typedef struct choice {
    int method;
    fit_ready ready; /* a sheet that was fitted to find out, if any */
    bool doubtful;   /* the sheet is taken if the method comes to nothing */
    bool streamed;   /* the sheet is of more points than the cloud has: */
    deviation_summary of_all;
} choice;

#ifdef CREASE_HAVE_CAD
/* Whether the sheet can end where the points do, if it is to. */
static crease_status can_end(
    crease_context *context, const settings *s, fit_ready *ready, bool *can)
{
    if (s->no_trim)
        return CREASE_OK;
    crease_status status = crease_sheet_trim(context, ready->sheet, &ready->trim);
    ready->whole = status == CREASE_OK && crease_trim_is_whole(ready->trim);
    if (status == CREASE_OK && !ready->whole)
        status = cad_trim_mesh(context, ready->trim, NULL, can);
    if (status != CREASE_OK || ready->whole || !*can) {
        crease_trim_free(ready->trim);
        ready->trim = NULL;
    }
    return status;
}

/* A sheet if its lines carry the creases of the cloud and it can be trimmed, else a shell. */
static crease_status sheet_or_shell(
    crease_context *context, const settings *s, const crease_cloud *cloud, choice *out)
{
    crease_regions *regions = NULL;
    crease_network *network = NULL;
    bool carries = true;
    crease_regions_options united = s->regions;
    united.united = true;
    crease_status status = crease_regions_find(context, cloud, &united, &regions);
    if (status == CREASE_OK)
        status = crease_network_find(context, regions, NULL, &network);
    if (status == CREASE_OK)
        status = crease_sheet_fit(context, cloud, &s->sheet, &out->ready.sheet);
    if (status == CREASE_OK)
        status = crease_sheet_carries(context, out->ready.sheet, regions, network, &carries);
    if (status == CREASE_OK && carries)
        status = can_end(context, s, &out->ready, &carries);
    out->method = carries ? METHOD_SHEET : METHOD_SHELL;
    out->doubtful = !carries;
    crease_network_free(network);
    crease_regions_free(regions);
    return status;
}
#endif

/* A part unless a sheet can follow the cloud, or options are set that only sheets have. */
static crease_status choose(
    crease_context *context, const settings *s, const crease_cloud *cloud, choice *out)
{
    bool suits = true;
    crease_status status = CREASE_OK;
    out->method = s->method;
    if (out->streamed)
        out->method = METHOD_SHEET;
    if (s->method != METHOD_AUTOMATIC || out->streamed)
        return CREASE_OK;
    const bool set = s->net_given || s->rotation_given;
    if (!set)
        status = crease_sheet_suits(context, cloud, &suits);
    out->method = suits ? METHOD_SHEET : METHOD_PART;
#ifdef CREASE_HAVE_CAD
    if (status == CREASE_OK && suits && !set && crease_cloud_count(cloud) >= LEAST_FOR_SHELL)
        status = sheet_or_shell(context, s, cloud, out);
#endif
    return status;
}

static crease_status fit(crease_context *context, const settings *s, report *r,
    const crease_cloud *cloud, choice *chosen)
{
    settings now = *s;
    bool instead = false;
    now.method = chosen->method;
    if (now.method == METHOD_PART || now.method == METHOD_SHELL) {
        const crease_status status = fit_part(
            context, &now, r, cloud, chosen->doubtful ? chosen->ready.sheet : NULL, &instead);
        if (status != CREASE_OK || !instead)
            return status;
        now.method = METHOD_SHEET;
    }
    return fit_sheet(
        context, &now, r, cloud, &chosen->ready, chosen->streamed ? &chosen->of_all : NULL);
}

/* A sample of the points when all of them are more than --memory allows. */
static crease_status read_sample(
    crease_context *context, const settings *s, report *r, crease_cloud **out)
{
    const char *const path = s->inputs[s->input_count - 1];
    size_t total = 0;
    const crease_status status =
        crease_cloud_read_sample(context, path, &s->read, limit_left(s) / LIMIT_FIT, out, &total);
    if (status != CREASE_OK)
        return status;
    input_describe(r, *out);
    cJSON_AddNumberToObject(r->root, "sampled_from", (double)total);
    report_stage(r, "read");
    report_line(r, "%s: %zu points are larger than --memory: fitted to a sample of %zu of them",
        path, total, crease_cloud_count(*out));
    return CREASE_OK;
}

/* A sheet of a prescribed net: the memory that it takes does not grow with the points. */
static crease_status fit_streamed(
    crease_context *context, const settings *s, report *r, crease_cloud **out, choice *chosen)
{
    const char *const path = s->inputs[s->input_count - 1];
    crease_fit_stream_options options = crease_fit_stream_options_default();
    crease_fit_stream_summary summary;
    options.sheet = s->sheet;
    options.read = s->read;
    options.memory = limit_left(s);
    const crease_status status =
        engine_fit_stream(context, path, &options, &summary, out, &chosen->ready.sheet);
    if (status != CREASE_OK)
        return status;
    chosen->streamed = true;
    chosen->of_all = (deviation_summary){summary.mean, summary.rms, summary.p95, summary.most};
    input_describe_parts(r, summary.count, summary.lowest, summary.highest);
    cJSON_AddNumberToObject(r->root, "sampled", (double)summary.sampled);
    report_line(r,
        "%s: %zu points, in parts; creases and border are those of a sample of %zu of them", path,
        summary.count, summary.sampled);
    return CREASE_OK;
}

static crease_status read_points(
    crease_context *context, const settings *s, report *r, crease_cloud **out, choice *chosen)
{
    bool larger = false;
    crease_status status = limit_exceeded(context, s, LIMIT_FIT, &larger);
    if (status == CREASE_OK && larger && s->net_given &&
        (s->method == METHOD_AUTOMATIC || s->method == METHOD_SHEET))
        return fit_streamed(context, s, r, out, chosen);
    if (status != CREASE_OK || larger)
        return status == CREASE_OK ? read_sample(context, s, r, out) : status;
    status = input_read(context, s, r, out);
    return status == CREASE_OK ? limit_check(context, s, crease_cloud_count(*out), LIMIT_FIT)
                               : status;
}

crease_status fit_run(crease_context *context, const settings *s, report *r)
{
    crease_cloud *cloud = NULL;
    choice chosen = {.method = METHOD_AUTOMATIC};
    crease_status status = check(context, s);
    if (status == CREASE_OK)
        status = read_points(context, s, r, &cloud, &chosen);
    if (status == CREASE_OK)
        status = choose(context, s, cloud, &chosen);
    if (status == CREASE_OK)
        status = fit(context, s, r, cloud, &chosen);
    fit_ready_free(&chosen.ready);
    crease_cloud_free(cloud);
    return status;
}
