/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Triangles of OpenCASCADE shapes. */
#ifndef CREASE_CAD_TESSELLATE_HPP
#define CREASE_CAD_TESSELLATE_HPP

#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>

#include <cstdint>
#include <vector>

namespace crease_cad
{

/* What makes a crease_mesh. Faces share no vertices, so that edges stay sharp; triangles are seen
 * counterclockwise from where the faces' normals point. */
struct Triangles {
    std::vector<double> vertices;    /* three each */
    std::vector<uint32_t> triangles; /* three each */
    std::vector<uint32_t> owners;    /* number of the face, from 0 */
};

/* Of the box around a shape. */
double diagonal(const TopoDS_Shape &shape);
/* Triangulates all faces to within the tolerance, a length; neighbouring faces have the same points
 * on their edges. 0: 1/100000 of the diagonal. Faces are numbered as TopExp finds them. Throws
 * Failure when a face cannot be triangulated. */
Triangles tessellate(const TopoDS_Shape &shape, double tolerance);
/* Triangulates the faces that can be. */
void tessellate_some(const TopoDS_Shape &shape, double tolerance);
bool is_tessellated(const TopoDS_Face &face);

} // namespace crease_cad

#endif
