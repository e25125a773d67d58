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
    size_t wire_edges;  /**< edges on no face */
    size_t sharp_edges; /**< edges between two faces that meet at more than 10 degrees */
    size_t bspline_faces, plane_faces, other_faces;
    bool valid;                   /**< OpenCASCADE's BRepCheck finds no fault */
    double area, volume;          /**< volume 0 for open shells */
    double lowest[3], highest[3]; /**< bounds, within the tolerance */
    double tolerance;             /**< largest tolerance of any vertex or edge */
} crease_cad_info;

/** Writes surfaces as faces that share the edges along which they meet: STEP (AP242), IGES or BREP
 * by extension (.step .stp .igs .iges .brep). Borders that are the same curve with the same
 * parameter up to scale and direction, whole or from knot to knot, become one edge; nothing is
 * approximated. A closed shell is written as a solid with its faces turned outwards.
 * CAD programs expect no crease inside a face: a surface is cut where a knot's multiplicity reaches
 * the degree, and at control rows that stand as often as the degree; where such rows leave no
 * derivative at the new border, the span beside it gets an equivalent parameter that has one.
 * Parameters of faces run from 0 to 1. Lengths are written as they are and called millimetres. The
 * same surfaces give the same bytes under the same file name.
 * Errors: ARGUMENT (unknown extension, no surface, order 1), CANNOT_WRITE, NUMERIC (nothing is left
 * to write, a shell with one side, OpenCASCADE finds fault: the sentence says with which face). */
CREASE_API crease_status crease_cad_write(
    crease_context *context, const crease_surface *const *surfaces, size_t count, const char *path);

/** Writes curves, such as creases, as edges in space: STEP (AP242), IGES or BREP by extension. Each
 * edge is the curve itself, not an approximation; it is cut only where CAD programs expect no kink:
 * where a knot's multiplicity reaches the degree. Parameters run from 0 to 1. Curves whose ends are
 * the same point share a vertex, except in IGES, whose curves know none. Units and bytes as in
 * crease_cad_write().
 * Errors: ARGUMENT (unknown extension, no curve, order 1), CANNOT_WRITE, NUMERIC (all curves have
 * shrunk to points, OpenCASCADE finds fault). */
CREASE_API crease_status crease_cad_curves_write(
    crease_context *context, const crease_curve *const *curves, size_t count, const char *path);

/** Reads a CAD file and tells what it holds. OpenCASCADE breaks down over some damaged files, so it
 * reads in a process of its own (fork), which is gone when the call returns.
 * Errors: NO_SUCH_FILE, CANNOT_READ, FORMAT, TRUNCATED, CANCELLED (that process was interrupted),
 * NO_MEMORY. */
CREASE_API crease_status crease_cad_info_read(
    crease_context *context, const char *path, crease_cad_info *out);

/** A CAD file as triangles: what it takes to compare it with a cloud, or to show it. */
typedef struct crease_cad_model crease_cad_model;

/** A face of a CAD file. */
typedef struct crease_cad_face {
    crease_region_type type; /**< extrusions, revolutions and splines are free forms */
    double area;             /**< in the squared unit of the file */
} crease_cad_face;

/** Reads a CAD file, in the unit of the file, and triangulates its faces so that the triangles stay
 * within the tolerance (a length) of them. tolerance 0: 1/100000 of the diagonal. Reads in a
 * process of its own, as crease_cad_info_read() does. Errors: as there, and NUMERIC (a face that
 * cannot be triangulated). */
CREASE_API crease_status crease_cad_model_read(
    crease_context *context, const char *path, double tolerance, crease_cad_model **out);
CREASE_API void crease_cad_model_free(crease_cad_model *model);
/** The triangles; their owners are the numbers of the faces. */
CREASE_API const crease_mesh *crease_cad_model_mesh(const crease_cad_model *model);
CREASE_API size_t crease_cad_model_face_count(const crease_cad_model *model);
/** Face number index, below the count, in the order of the file. */
CREASE_API crease_cad_face crease_cad_model_face(const crease_cad_model *model, size_t index);

#ifdef __cplusplus
}
#endif

#endif
