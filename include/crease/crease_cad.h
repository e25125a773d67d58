/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/** @file crease_cad.h
 * CAD files through OpenCASCADE, behind a C interface (library libcrease-cad).
 */
#ifndef CREASE_CREASE_CAD_H
#define CREASE_CREASE_CAD_H

#include "crease/crease.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What a CAD file holds. Lengths in the unit of the file. */
typedef struct crease_cad_info {
    char format[16]; /**< "STEP", "IGES" or "BREP" */
    char schema[64]; /**< STEP schema, e.g. "AP242", else empty */
    size_t solids, shells, closed_shells, faces, edges, vertices;
    size_t free_edges;  /**< edges on one face only */
    size_t sharp_edges; /**< edges between two faces that meet at more than 10 degrees */
    size_t bspline_faces, plane_faces, other_faces;
    bool valid;          /**< OpenCASCADE's BRepCheck finds no fault */
    double area, volume; /**< volume 0 for open shells */
    double lowest[3], highest[3];
    double tolerance; /**< largest tolerance of any vertex or edge */
} crease_cad_info;

/** Writes surfaces as one shell of faces that share the edges along which they meet: STEP (AP242),
 * IGES or BREP by extension (.step .stp .igs .iges .brep). Surfaces that share border control
 * points share edges exactly; nothing is approximated. A closed shell is written as a solid.
 * Errors: ARGUMENT (unknown extension, no surface), CANNOT_WRITE, NUMERIC (OpenCASCADE refused). */
CREASE_API crease_status crease_cad_write(
    crease_context *context, const crease_surface *const *surfaces, size_t count, const char *path);

/** Reads a CAD file and tells what it holds. Errors: NO_SUCH_FILE, CANNOT_READ, FORMAT. */
CREASE_API crease_status crease_cad_info_read(
    crease_context *context, const char *path, crease_cad_info *out);

#ifdef __cplusplus
}
#endif

#endif
