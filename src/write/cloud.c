/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "write/cloud.h"

#include "read/number.h"

#include <string.h>

enum { PLY, PCD, XYZ, TXT, CSV, ASC, PTS, FORMAT_COUNT };

static const char *const extensions[FORMAT_COUNT] = {
    "ply", "pcd", "xyz", "txt", "csv", "asc", "pts"};

static const crease_text_style styles[FORMAT_COUNT] = {[XYZ] = {.separator = ' ', .comment = "# "},
    [TXT] = {.separator = ' ', .header = true, .comment = ""},
    [CSV] = {.separator = ',', .header = true, .comment = ""},
    [ASC] = {.separator = ' ', .header = true, .comment = ""},
    [PTS] = {.separator = ' ', .count = true, .comment = "# "}};

static bool is_taken(const crease_cloud *cloud, const char *name)
{
    static const char *const names[] = {
        "x", "y", "z", "nx", "ny", "nz", "normal_x", "normal_y", "normal_z"};
    const size_t count = crease_cloud_normals(cloud) ? sizeof names / sizeof names[0] : 3;
    for (size_t i = 0; i < count; i++)
        if (strcmp(names[i], name) == 0)
            return true;
    return false;
}

/* A name that every format can hold: it must read back as one name. */
static bool is_word(const char *name)
{
    double value = 0;
    const char *end = name + strlen(name);
    for (const char *at = name; at < end; at++)
        if ((*at >= 0 && *at <= ' ') || strchr(",;\"", *at))
            return false;
    return name < end && crease_number_parse(name, end, true, &value) != end;
}

crease_status crease_cloud_check_names(
    crease_context *context, const crease_cloud *cloud, const char *path)
{
    for (size_t i = 0; i < crease_cloud_field_count(cloud); i++) {
        const char *name = crease_cloud_field(cloud, i).name;
        if (is_taken(cloud, name))
            return crease_fail(context, CREASE_ERROR_ARGUMENT,
                "%s: a field is named '%s' as the coordinates or normals are; rename it", path,
                name);
        if (!is_word(name))
            return crease_fail(context, CREASE_ERROR_ARGUMENT,
                "%s: a field named '%s' would not read back; give it a name of letters", path,
                name);
    }
    return CREASE_OK;
}

crease_status crease_cloud_write(
    crease_context *context, const crease_cloud *cloud, const char *path)
{
    size_t format = 0;
    crease_output *output = NULL;
    crease_status status = crease_output_choose(context, path, extensions, FORMAT_COUNT, &format);
    if (status == CREASE_OK)
        status = crease_cloud_check_names(context, cloud, path);
    if (status == CREASE_OK)
        status = crease_output_open(context, path, &output);
    if (status != CREASE_OK)
        return status;
    if (format == PLY)
        crease_cloud_write_ply(output, cloud);
    else if (format == PCD)
        crease_cloud_write_pcd(output, cloud);
    else
        crease_cloud_write_text(output, cloud, &styles[format]);
    return crease_output_close(context, output, CREASE_OK);
}
