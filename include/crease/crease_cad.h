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

#ifdef __cplusplus
}
#endif

#endif
