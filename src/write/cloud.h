/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The writers of clouds, and what the binary ones share. */
#ifndef CREASE_WRITE_CLOUD_H
#define CREASE_WRITE_CLOUD_H

#include "write/output.h"

void crease_cloud_write_ply(crease_output *output, const crease_cloud *cloud);
/* The header of a PLY file of so many points like the cloud's; records of all of them follow. */
void crease_cloud_write_ply_header(
    crease_output *output, const crease_cloud *like, size_t count, crease_type normal_type);
void crease_cloud_write_pcd(crease_output *output, const crease_cloud *cloud);

typedef struct crease_text_style {
    char separator;
    bool count;          /* the number of points first */
    bool header;         /* names of the columns, also when they are only x y z */
    const char *comment; /* in front of the names */
} crease_text_style;

void crease_cloud_write_text(
    crease_output *output, const crease_cloud *cloud, const crease_text_style *style);

/* Type of the written normals: FLOAT32 where that loses nothing. */
crease_type crease_cloud_normal_type(const crease_cloud *cloud);
/* All points as packed records, little endian: coordinates, normals, fields. */
void crease_cloud_write_records(
    crease_output *output, const crease_cloud *cloud, crease_type normal_type);
/* Whether fields can be written under their names. Errors: ARGUMENT. */
crease_status crease_cloud_check_names(
    crease_context *context, const crease_cloud *cloud, const char *path);

#endif
