/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/** @file crease_trim.h
 * Sheets that end where their points do: faces, loops and edges in the parameters of the sheet.
 */
#ifndef CREASE_CREASE_TRIM_H
#define CREASE_CREASE_TRIM_H

#include "crease/crease.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A sheet as far as its points go: faces in the pieces between its knot lines, trimmed to the
 * border of the points and to their holes, that share the edges along those lines. */
typedef struct crease_trim crease_trim;

/** An edge of a trimmed sheet. */
typedef struct crease_trim_edge {
    const crease_curve *curve; /**< in the parameters of the sheet: its x is u, y is v, z is 0;
                                    straight ones have order 2; its domain is 0..1 */
    uint32_t vertices[2];      /**< numbers of the vertices at its ends; the same twice: closed */
    int32_t faces[2]; /**< numbers of the faces on its left and right, u running to the right
                           and v upwards; -1: none, it is on the border */
} crease_trim_edge;

/** An edge as a loop passes it. */
typedef struct crease_trim_half {
    uint32_t edge;
    bool reversed;
} crease_trim_half;

/** Trims a sheet. A disc of 2.5 spacings (more where points are sparse) is rolled along the points
 * in the plane of u and v, both scaled to mean lengths on the surface; bays and holes that it does
 * not fit into are none (see docs/sheets.md). What it touches becomes smooth lines with corners;
 * where the points reach a side of the sheet within a spacing, that side is the border. If no
 * border is found, and for the paper's algorithm, the whole sheet remains. O(n log n). Errors:
 * NO_MEMORY, CANCELLED, NUMERIC.
 * Based on: Edelsbrunner, Kirkpatrick, Seidel. On the shape of a set of points in the plane. 1983.
 */
CREASE_API crease_status crease_sheet_trim(
    crease_context *context, const crease_sheet *sheet, crease_trim **out);
CREASE_API void crease_trim_free(crease_trim *trim);
/** Whether nothing was cut off: the faces are those of crease_sheet_faces(). */
CREASE_API bool crease_trim_is_whole(const crease_trim *trim);
CREASE_API size_t crease_trim_vertex_count(const crease_trim *trim);
/** u, v of all vertices, count x 2. */
CREASE_API const double *crease_trim_vertices(const crease_trim *trim);
CREASE_API size_t crease_trim_edge_count(const crease_trim *trim);
/** Edge number index, below the count. */
CREASE_API crease_trim_edge crease_trim_edge_at(const crease_trim *trim, size_t index);
CREASE_API size_t crease_trim_face_count(const crease_trim *trim);
/** The smooth surface that a face lies on: a piece of the sheet with the same parameters. */
CREASE_API const crease_surface *crease_trim_surface(const crease_trim *trim, size_t face);
/** Loops of a face: the first one goes around it, the others around its holes. */
CREASE_API size_t crease_trim_loop_count(const crease_trim *trim, size_t face);
/** The edges of a loop in order, the face on its left in u and v. *count: how many. */
CREASE_API const crease_trim_half *crease_trim_loop(
    const crease_trim *trim, size_t face, size_t loop, size_t *count);
/** The crease lines of the sheet as far as they are edges of two faces, curves in space. */
CREASE_API size_t crease_trim_crease_count(const crease_trim *trim);
CREASE_API const crease_curve *const *crease_trim_creases(const crease_trim *trim);

#ifdef __cplusplus
}
#endif

#endif
