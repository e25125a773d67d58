/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "cad/tessellate.hpp"

#include "cad/kernel.hpp"

#include <BRepBndLib.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>

#include <cmath>
#include <utility>

namespace crease_cad
{

static constexpr double FINE = 1e-5;          /* of the diagonal */
static constexpr double GREATEST_ANGLE = 0.3; /* between neighbouring segments of an edge */

static void add_triangles(const Poly_Triangulation &mesh, bool reversed, Triangles &out)
{
    const uint32_t before = (uint32_t)(out.vertices.size() / 3) - (uint32_t)mesh.NbNodes();
    for (int i = 1; i <= mesh.NbTriangles(); i++) {
        int numbers[3];
        mesh.Triangle(i).Get(numbers[0], numbers[1], numbers[2]);
        if (reversed)
            std::swap(numbers[1], numbers[2]);
        for (const int number : numbers)
            out.triangles.push_back(before + (uint32_t)(number - 1));
    }
}

static void add_face(const TopoDS_Face &face, uint32_t owner, Triangles &out)
{
    TopLoc_Location location;
    const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, location);
    if (mesh.IsNull())
        throw Failure{CREASE_ERROR_NUMERIC,
            "face " + std::to_string(owner + 1) +
                " cannot be triangulated; mend it in a CAD program"};
    for (int i = 1; i <= mesh->NbNodes(); i++) {
        const gp_Pnt place = mesh->Node(i).Transformed(location.Transformation());
        for (int c = 1; c <= 3; c++)
            out.vertices.push_back(place.Coord(c));
    }
    out.owners.resize(out.owners.size() + (size_t)mesh->NbTriangles(), owner);
    add_triangles(*mesh, face.Orientation() == TopAbs_REVERSED, out);
}

double diagonal(const TopoDS_Shape &shape)
{
    Bnd_Box box;
    BRepBndLib::Add(shape, box, false);
    return box.IsVoid() ? 0.0 : std::sqrt(box.SquareExtent());
}

void tessellate_some(const TopoDS_Shape &shape, double tolerance)
{
    const double within = tolerance > 0.0 ? tolerance : FINE * diagonal(shape);
    BRepMesh_IncrementalMesh(shape, within, false, GREATEST_ANGLE, true);
}

bool is_tessellated(const TopoDS_Face &face)
{
    TopLoc_Location location;
    return !BRep_Tool::Triangulation(face, location).IsNull();
}

Triangles tessellate(const TopoDS_Shape &shape, double tolerance)
{
    tessellate_some(shape, tolerance);
    TopTools_IndexedMapOfShape faces;
    TopExp::MapShapes(shape, TopAbs_FACE, faces);
    Triangles out;
    for (int i = 1; i <= faces.Extent(); i++)
        add_face(TopoDS::Face(faces(i)), (uint32_t)(i - 1), out);
    return out;
}

} // namespace crease_cad
