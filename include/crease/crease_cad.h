/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/** @file crease_cad.h
 * CAD files through OpenCASCADE, behind a C interface (library libcrease-cad).
 */
#ifndef CREASE_CREASE_CAD_H
#define CREASE_CREASE_CAD_H

#include "crease/crease.h"
#include "crease/crease_trim.h"

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

/** Writes a trimmed sheet: STEP (AP242), IGES or BREP by extension. Faces lie on the smooth pieces
 * of the sheet and share their edges along knot lines, which are these lines themselves; other
 * edges are cubic curves within a ten-millionth of the sheet's size of it, as a rule. Units and
 * bytes as in crease_cad_write(). Errors: ARGUMENT (unknown extension), CANNOT_WRITE, NUMERIC
 * (OpenCASCADE finds fault with it). */
CREASE_API crease_status crease_cad_trim_write(
    crease_context *context, const crease_trim *trim, const char *path);
/** Triangles within the tolerance (a length) of a trimmed sheet; their owners are the numbers of
 * its faces, which share places along their edges, but no vertices. tolerance 0: 1/2000 of the
 * diagonal. out NULL: only finds out whether there is fault. Errors: ARGUMENT, NUMERIC (as above,
 * or a face that cannot be triangulated), NO_MEMORY. */
CREASE_API crease_status crease_cad_trim_mesh(
    crease_context *context, const crease_trim *trim, double tolerance, crease_mesh **out);

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

/* ------------------------------------------------------------------------------------ parts -- */

/** A part: faces on the surfaces of its regions, trimmed by the edges that they share. */
typedef struct crease_part crease_part;

/** What became of a part, best first. */
typedef enum crease_part_state {
    CREASE_PART_SOLID, /**< closed shells around a volume, valid: one solid, or several apart */
    CREASE_PART_SHELL, /**< valid faces that share edges, some of them free */
    CREASE_PART_FACES  /**< faces of which some share no edges, or that are not valid together */
} crease_part_state;

typedef struct crease_part_options {
    bool bspline_faces; /**< every face as a bicubic (rational where it must be) B-spline surface;
                             default false: planes, cylinders ... as such */
    bool open;          /**< the points are of a surface that ends at a border: faces end where the
                             points do, and the shell is open; default false: they are of a closed
                             body */
} crease_part_options;

/** A face of a part. Lengths in the unit of the cloud. */
typedef struct crease_part_face {
    uint32_t region;    /**< number of the region whose surface it lies on; of several on one
                             surface the largest */
    size_t point_count; /**< points with a region that are nearest to it */
    double area;
    double mean, rms, p95, most; /**< their distances from it: mean signed, 95 % below p95 */
} crease_part_face;

/** An edge of a part. */
typedef struct crease_part_edge {
    uint32_t faces[2]; /**< numbers of the faces that share it; the same twice: a seam; second
                            UINT32_MAX: free */
    bool smooth;       /**< its faces join at less than 10 degrees */
    double length;
    double angle; /**< mean dihedral angle of its faces, through the material: 180 = flat, below 180
                       convex; of an open shell the smaller one; 0 when free */
} crease_part_edge;

CREASE_API crease_part_options crease_part_options_default(void);
/** Builds the part that the points lie on. The surfaces of the regions are extended and intersected
 * all at once; the points say which of the cells between them are inside, and what bounds those
 * cells is the part. Fillets between planes are recognised and rolled along the edges that they
 * replace. Nothing passes for a solid unless OpenCASCADE finds it valid and closed and the points
 * lie on it: otherwise the faces that the points support become an open shell, or at last faces
 * side by side; never nothing. OpenCASCADE's work is done in processes of their own (fork); how
 * many intersections it may look at is counted, so that the result does not depend on the machine's
 * speed, unless one of these processes takes more than 30 seconds of the processor and is ended.
 * Not for several threads at the same time.
 * regions: of this cloud; network: of these regions, or NULL; options may be NULL.
 * Errors: ARGUMENT (the regions are not of this cloud), NO_MEMORY, NUMERIC (not even faces come
 * out), CANCELLED (such a process was interrupted). */
CREASE_API crease_status crease_part_build(crease_context *context, const crease_cloud *cloud,
    const crease_regions *regions, const crease_network *network,
    const crease_part_options *options, crease_part **out);
CREASE_API void crease_part_free(crease_part *part);
CREASE_API crease_part_state crease_part_state_of(const crease_part *part);
/** A sentence that says what is missing, and why; "" for a solid that lacks nothing. */
CREASE_API const char *crease_part_message(const crease_part *part);
/** How many bodies lie side by side in the cloud, each a solid of its own; a void belongs to the
 * solid around it. 0 unless the part is solid. */
CREASE_API size_t crease_part_solid_count(const crease_part *part);
/** The volume of all solids; 0 unless the part is solid. */
CREASE_API double crease_part_volume(const crease_part *part);
/** The regions by whose numbers the faces call theirs: those given, or, when these leave faces open
 * and regions that join without an angle close once they are united, such ones, or those with
 * planes that no point shows; they belong to the part. The given ones must live as long as they are
 * asked for here. */
CREASE_API const crease_regions *crease_part_regions(const crease_part *part);
/** How many of these regions, the last ones, are planes of faces that no point shows, as a wall in
 * the shadow of a scan: their neighbours say where they are. O(1). */
CREASE_API size_t crease_part_unseen_count(const crease_part *part);
CREASE_API size_t crease_part_face_count(const crease_part *part);
/** Face number index, below the count. */
CREASE_API crease_part_face crease_part_face_at(const crease_part *part, size_t index);
CREASE_API size_t crease_part_edge_count(const crease_part *part);
/** Edge number index, below the count. */
CREASE_API crease_part_edge crease_part_edge_at(const crease_part *part, size_t index);
/** A cubic curve for each edge, in their order, within a millionth of the edge's size or so. */
CREASE_API const crease_curve *const *crease_part_curves(const crease_part *part);
/** Triangles within 1/10000 of the diagonal of the faces; their owners are the numbers of the
 * faces. */
CREASE_API const crease_mesh *crease_part_mesh(const crease_part *part);
/** Signed distance of every point of the cloud from the part, positive outside; on open shells
 * positive on the side of the faces' normals. */
CREASE_API const double *crease_part_deviations(const crease_part *part);
/** Number of the nearest face for every point of the cloud. */
CREASE_API const int32_t *crease_part_nearest_faces(const crease_part *part);
/** Writes the part: STEP (AP242), IGES or BREP by extension. Units and bytes as in
 * crease_cad_write(). Errors: ARGUMENT (unknown extension), CANNOT_WRITE, NUMERIC, NO_MEMORY. */
CREASE_API crease_status crease_part_write(
    crease_context *context, const crease_part *part, const char *path);

#ifdef __cplusplus
}
#endif

#endif
