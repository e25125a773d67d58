/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "input.h"

crease_status input_path(
    crease_context *context, const settings *s, const char *what, const char **out)
{
    if (s->input_count == 0)
        return crease_context_fail(
            context, CREASE_ERROR_ARGUMENT, "an argument is missing: %s", what);
    *out = s->inputs[s->input_count - 1];
    return CREASE_OK;
}

cJSON *input_describe_parts(
    report *r, size_t count, const double lowest[3], const double highest[3])
{
    cJSON *object = cJSON_AddObjectToObject(r->root, "cloud");
    cJSON_AddNumberToObject(object, "points", (double)count);
    report_vector(object, "lowest", lowest);
    report_vector(object, "highest", highest);
    return object;
}

void input_describe(report *r, const crease_cloud *cloud)
{
    double lowest[3], highest[3];
    crease_cloud_bounds(cloud, lowest, highest);
    cJSON *object = input_describe_parts(r, crease_cloud_count(cloud), lowest, highest);
    cJSON_AddBoolToObject(object, "normals", crease_cloud_normals(cloud) != NULL);
    cJSON *fields = cJSON_AddArrayToObject(object, "fields");
    for (size_t i = 0; i < crease_cloud_field_count(cloud); i++)
        cJSON_AddItemToArray(fields, cJSON_CreateString(crease_cloud_field(cloud, i).name));
}

crease_status input_read(crease_context *context, const settings *s, report *r, crease_cloud **out)
{
    const char *path = NULL;
    *out = NULL;
    crease_status status =
        input_path(context, s, "the file to read, or - for standard input", &path);
    if (status == CREASE_OK)
        status = crease_cloud_read(context, path, &s->read, out);
    if (status != CREASE_OK)
        return status;
    input_describe(r, *out);
    report_stage(r, "read");
    report_line(r, "%s: %zu points", path, crease_cloud_count(*out));
    return CREASE_OK;
}
