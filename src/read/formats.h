/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The readers, one for each format, and how the right one is found. A reader gets a source that is
 * not empty; its status and message are those of crease_cloud_read. */
#ifndef CREASE_READ_FORMATS_H
#define CREASE_READ_FORMATS_H

#include "facets/facets.h"
#include "read/lines.h"
#include "read/source.h"

typedef crease_status crease_reader(crease_context *context, const crease_source *source,
    const crease_read_options *options, crease_cloud **out);

crease_reader crease_ply_read;
crease_reader crease_pcd_read;
crease_reader crease_xyz_read;
crease_reader crease_obj_read;
crease_reader crease_stl_read;
crease_reader crease_off_read;
crease_reader crease_las_read;

/* Adds the faces of a mesh whose vertices facets has already. Errors: those of the reader. */
typedef crease_status crease_faces_reader(
    crease_context *context, const crease_source *source, crease_facets *facets);

crease_faces_reader crease_ply_faces;
crease_faces_reader crease_obj_faces;
crease_faces_reader crease_stl_faces;
crease_faces_reader crease_off_faces;

/* Where the points of a file are, when they are rows of equal size, or lines, behind a header. */
typedef struct crease_layout {
    bool counted;            /* the header has the number of points */
    uint64_t count;          /* that number */
    size_t size;             /* bytes of each */
    size_t first;            /* byte of the first one: the header is before */
    size_t numeral[2];       /* PLY: bytes of the header where the count begins and ends */
    bool alone;              /* nothing follows the points */
    crease_row_test *is_row; /* of text; NULL: binary */
    size_t lead;             /* text: bytes that are put before some of its rows */
    size_t line;             /* text: number of the line of byte `first` */
    size_t columns;          /* text */
    bool asks;               /* text: only all rows tell what the columns are */
} crease_layout;

/* From a source that holds the header at least. Errors: FORMAT, TRUNCATED, UNSUPPORTED. */
crease_status crease_ply_layout(
    crease_context *context, const crease_source *head, crease_layout *out);
crease_status crease_xyz_layout(
    crease_context *context, const crease_source *head, crease_layout *out);
crease_status crease_las_layout(
    crease_context *context, const crease_source *head, crease_layout *out);
/* Makes the header of a LAS file one of so many points. */
void crease_las_set_count(char *header, const crease_layout *layout, uint32_t count);

/* A binary STL has no signature, but its size follows from its count of triangles. */
bool crease_stl_is_binary(const char *head, size_t head_size, size_t file_size);

typedef struct crease_format {
    const char *name;           /* "PLY" */
    const char *description;    /* "a CAD model (STEP)" */
    crease_reader *read;        /* NULL: no cloud */
    crease_faces_reader *faces; /* NULL: no mesh */
} crease_format;

/* The format of a file of which the first bytes are known: by signature first, by extension
 * second, by looking like rows of numbers third. NULL when nothing fits. */
const crease_format *crease_format_find(
    const char *path, const char *head, size_t head_size, size_t file_size);

/* Reads the cloud of a source in the format that it has. */
crease_status crease_source_read(crease_context *context, const crease_source *source,
    const crease_read_options *options, crease_cloud **out);
/* The faces of the same source, of which the cloud has all vertices: none where it is no mesh.
 * Errors: FORMAT, TRUNCATED, NO_MEMORY; there is nothing to free then. */
crease_status crease_source_faces(crease_context *context, const crease_source *source,
    const crease_cloud *cloud, crease_facets *out);

#endif
