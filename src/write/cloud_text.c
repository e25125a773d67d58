/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "write/cloud.h"

static void put_number(crease_output *output, double value, crease_type type)
{
    if (type == CREASE_TYPE_FLOAT32)
        crease_output_float(output, (float)value);
    else
        crease_output_double(output, value);
}

static void put_triple(
    crease_output *output, const double *values, crease_type type, char separator)
{
    for (int i = 0; i < 3; i++) {
        if (i)
            crease_output_bytes(output, &separator, 1);
        put_number(output, values[i], type);
    }
}

static void put_names(
    crease_output *output, const crease_cloud *cloud, const crease_text_style *style)
{
    const char s = style->separator;
    crease_output_format(output, "%sx%cy%cz", style->comment, s, s);
    if (crease_cloud_normals(cloud))
        crease_output_format(output, "%cnx%cny%cnz", s, s, s);
    for (size_t i = 0; i < crease_cloud_field_count(cloud); i++) {
        crease_output_bytes(output, &s, 1);
        crease_output_text(output, crease_cloud_field(cloud, i).name);
    }
    crease_output_text(output, "\n");
}

static void put_point(
    crease_output *output, const crease_cloud *cloud, size_t point, crease_type normal_type, char s)
{
    const double *normals = crease_cloud_normals(cloud);
    put_triple(
        output, crease_cloud_points(cloud) + 3 * point, crease_cloud_coordinate_type(cloud), s);
    if (normals) {
        crease_output_bytes(output, &s, 1);
        put_triple(output, normals + 3 * point, normal_type, s);
    }
    for (size_t i = 0; i < crease_cloud_field_count(cloud); i++) {
        const crease_field field = crease_cloud_field(cloud, i);
        crease_output_bytes(output, &s, 1);
        put_number(output, crease_field_value(&field, point), field.type);
    }
    crease_output_text(output, "\n");
}

void crease_cloud_write_text(
    crease_output *output, const crease_cloud *cloud, const crease_text_style *style)
{
    const bool plain = !crease_cloud_normals(cloud) && !crease_cloud_field_count(cloud);
    const crease_type normal_type = crease_cloud_normal_type(cloud);
    const size_t count = crease_cloud_count(cloud);
    if (style->count)
        crease_output_format(output, "%zu\n", count);
    if (style->header || !plain)
        put_names(output, cloud, style);
    for (size_t i = 0; i < count && !crease_output_failed(output); i++)
        put_point(output, cloud, i, normal_type, style->separator);
}
