/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* PLY and PCD: two headers over the same records. */
#include "write/cloud.h"

#include <string.h>

static const char axes[] = "xyz";

/* ----------------------------------------------------------------------------------- records -- */

crease_type crease_cloud_normal_type(const crease_cloud *cloud)
{
    const double *normals = crease_cloud_normals(cloud);
    for (size_t i = 0; normals && i < 3 * crease_cloud_count(cloud); i++) {
        const double rounded = (double)(float)normals[i];
        if (rounded < normals[i] || rounded > normals[i])
            return CREASE_TYPE_FLOAT64;
    }
    return CREASE_TYPE_FLOAT32;
}

static void put_triple(crease_output *output, const double *values, crease_type type)
{
    for (int i = 0; i < 3; i++)
        if (type == CREASE_TYPE_FLOAT32)
            crease_output_binary_f32(output, (float)values[i]);
        else
            crease_output_binary_f64(output, values[i]);
}

static void put_value(crease_output *output, const crease_field *field, size_t point)
{
    const size_t size = crease_type_size(field->type);
    const unsigned char *value = (const unsigned char *)field->values + point * size;
    uint16_t two = 0;
    uint32_t four = 0;
    double eight = 0;
    switch (size) {
    case 1:
        crease_output_bytes(output, value, 1);
        break;
    case 2:
        memcpy(&two, value, 2);
        crease_output_binary_u16(output, two);
        break;
    case 4:
        memcpy(&four, value, 4);
        crease_output_binary_u32(output, four);
        break;
    default:
        memcpy(&eight, value, 8);
        crease_output_binary_f64(output, eight);
    }
}

void crease_cloud_write_records(
    crease_output *output, const crease_cloud *cloud, crease_type normal_type)
{
    const double *points = crease_cloud_points(cloud), *normals = crease_cloud_normals(cloud);
    const crease_type type = crease_cloud_coordinate_type(cloud);
    for (size_t i = 0; i < crease_cloud_count(cloud) && !crease_output_failed(output); i++) {
        put_triple(output, points + 3 * i, type);
        if (normals)
            put_triple(output, normals + 3 * i, normal_type);
        for (size_t j = 0; j < crease_cloud_field_count(cloud); j++) {
            const crease_field field = crease_cloud_field(cloud, j);
            put_value(output, &field, i);
        }
    }
}

/* --------------------------------------------------------------------------------------- ply -- */

static const char *ply_type(crease_type type)
{
    static const char *const names[] = {
        "char", "uchar", "short", "ushort", "int", "uint", "float", "double"};
    return names[type];
}

void crease_cloud_write_ply_header(
    crease_output *output, const crease_cloud *cloud, size_t count, crease_type normal_type)
{
    crease_output_format(output,
        "ply\nformat binary_little_endian 1.0\ncomment crease %s\nelement vertex %zu\n",
        crease_version(), count);
    const char *type = ply_type(crease_cloud_coordinate_type(cloud));
    for (int i = 0; i < 3; i++)
        crease_output_format(output, "property %s %c\n", type, axes[i]);
    type = ply_type(normal_type);
    for (int i = 0; i < 3 && crease_cloud_normals(cloud); i++)
        crease_output_format(output, "property %s n%c\n", type, axes[i]);
    for (size_t i = 0; i < crease_cloud_field_count(cloud); i++) {
        const crease_field field = crease_cloud_field(cloud, i);
        crease_output_format(output, "property %s ", ply_type(field.type));
        crease_output_text(output, field.name);
        crease_output_text(output, "\n");
    }
    crease_output_text(output, "end_header\n");
}

void crease_cloud_write_ply(crease_output *output, const crease_cloud *cloud)
{
    const crease_type normal_type = crease_cloud_normal_type(cloud);
    crease_cloud_write_ply_header(output, cloud, crease_cloud_count(cloud), normal_type);
    crease_cloud_write_records(output, cloud, normal_type);
}

/* --------------------------------------------------------------------------------------- pcd -- */

/* One line of the header: `word` and, for every column, what `put` writes of it. */
static void put_line(crease_output *output, const crease_cloud *cloud, const char *word,
    void (*put)(crease_output *output, const char *name, crease_type type))
{
    static const char *const points[] = {"x", "y", "z"};
    static const char *const normals[] = {"normal_x", "normal_y", "normal_z"};
    crease_output_text(output, word);
    for (int i = 0; i < 3; i++)
        put(output, points[i], crease_cloud_coordinate_type(cloud));
    for (int i = 0; i < 3 && crease_cloud_normals(cloud); i++)
        put(output, normals[i], crease_cloud_normal_type(cloud));
    for (size_t i = 0; i < crease_cloud_field_count(cloud); i++) {
        const crease_field field = crease_cloud_field(cloud, i);
        put(output, field.name, field.type);
    }
    crease_output_text(output, "\n");
}

static void put_name(crease_output *output, const char *name, crease_type type)
{
    (void)type;
    crease_output_text(output, " ");
    crease_output_text(output, name);
}

static void put_size(crease_output *output, const char *name, crease_type type)
{
    (void)name;
    crease_output_format(output, " %zu", crease_type_size(type));
}

static void put_type(crease_output *output, const char *name, crease_type type)
{
    (void)name;
    crease_output_format(output, " %c", "IUIUIUFF"[type]);
}

static void put_one(crease_output *output, const char *name, crease_type type)
{
    (void)name;
    (void)type;
    crease_output_text(output, " 1");
}

void crease_cloud_write_pcd(crease_output *output, const crease_cloud *cloud)
{
    crease_output_format(output, "# .PCD v0.7 - crease %s\nVERSION 0.7\n", crease_version());
    put_line(output, cloud, "FIELDS", put_name);
    put_line(output, cloud, "SIZE", put_size);
    put_line(output, cloud, "TYPE", put_type);
    put_line(output, cloud, "COUNT", put_one);
    const size_t count = crease_cloud_count(cloud);
    crease_output_format(output,
        "WIDTH %zu\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS %zu\nDATA binary\n", count, count);
    crease_cloud_write_records(output, cloud, crease_cloud_normal_type(cloud));
}
