/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* crease fit: chooses between a sheet and a part. */
#include "fit.h"

#include "command.h"
#include "input.h"

static crease_status check(crease_context *context, const settings *s)
{
    crease_status status = targets_check(context, s, FIT_ALLOWED);
    if (status == CREASE_OK)
        status = target_check(context, s->creases, FIT_CREASES);
    if (status == CREASE_OK)
        status = target_check(context, s->points, TARGET_CLOUD);
    return status == CREASE_OK ? target_check(context, s->report, TARGET_REPORT) : status;
}

/* A part unless a sheet can follow the cloud, or options are set that only sheets have. */
static crease_status choose(
    crease_context *context, const settings *s, const crease_cloud *cloud, int *method)
{
    *method = s->method;
    if (s->method != METHOD_AUTOMATIC)
        return CREASE_OK;
    bool suits = true;
    crease_status status = CREASE_OK;
    if (!s->net_given && !s->rotation_given)
        status = crease_sheet_suits(context, cloud, &suits);
    *method = suits ? METHOD_SHEET : METHOD_PART;
    return status;
}

crease_status fit_run(crease_context *context, const settings *s, report *r)
{
    crease_cloud *cloud = NULL;
    int method = METHOD_AUTOMATIC;
    crease_status status = check(context, s);
    if (status == CREASE_OK)
        status = input_read(context, s, r, &cloud);
    if (status == CREASE_OK)
        status = choose(context, s, cloud, &method);
    if (status == CREASE_OK) {
        cJSON_AddStringToObject(r->root, "method", fit_method_names[method]);
        settings chosen = *s;
        chosen.method = method;
        status = method == METHOD_PART || method == METHOD_SHELL
            ? fit_part(context, &chosen, r, cloud)
            : fit_sheet(context, &chosen, r, cloud);
    }
    crease_cloud_free(cloud);
    return status;
}
