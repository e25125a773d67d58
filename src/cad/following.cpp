/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The way that follows the topology of the points: nothing is intersected, so surfaces may be
 * tangent to each other, and what the points leave open stays open. */
#include "cad/brep.hpp"
#include "cad/closing.hpp"
#include "cad/ways.hpp"

#include <BRepCheck_Analyzer.hxx>
#include <BRep_Builder.hxx>
#include <BRep_TVertex.hxx>
#include <BRep_Tool.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Vertex.hxx>

#include <algorithm>

namespace crease_cad
{

/* Of vertices, in spacings. */
static constexpr double LEAST_REACH = 0.01, MOST_REACH = 0.5;
static constexpr double MOST_ALONE = 2.5; /* when one vertex mends a face */
static constexpr double WIDER = 1.5;      /* from try to try */

static int face_count(const TopoDS_Shape &shape)
{
    TopTools_IndexedMapOfShape faces;
    TopExp::MapShapes(shape, TopAbs_FACE, faces);
    return faces.Extent();
}

/* Lets the vertices of the faces that are not valid reach farther: where surfaces join at a small
 * angle, edges cross a little before they end. */
static bool widen_vertices(const TopoDS_Shape &shape, double least, double most)
{
    BRep_Builder builder;
    bool wider = false;
    for (TopExp_Explorer face(shape, TopAbs_FACE); face.More(); face.Next()) {
        if (BRepCheck_Analyzer(face.Current()).IsValid())
            continue;
        TopTools_IndexedMapOfShape vertices;
        TopExp::MapShapes(face.Current(), TopAbs_VERTEX, vertices);
        for (int i = 1; i <= vertices.Extent(); i++) {
            const TopoDS_Vertex vertex = TopoDS::Vertex(vertices(i));
            const double reach = std::max(least, WIDER * BRep_Tool::Tolerance(vertex));
            if (reach <= most) {
                builder.UpdateVertex(vertex, reach);
                wider = true;
            }
        }
    }
    return wider;
}

/* Lets one vertex of a face reach so far that the face is valid: where two edges come to it side by
 * side, as at a cusp, they cross well before. */
static bool widen_one(const TopoDS_Shape &face, double least, double most)
{
    TopTools_IndexedMapOfShape vertices;
    TopExp::MapShapes(face, TopAbs_VERTEX, vertices);
    for (double reach = least; reach <= most; reach *= WIDER)
        for (int i = 1; i <= vertices.Extent(); i++) {
            const Handle(BRep_TVertex) vertex =
                Handle(BRep_TVertex)::DownCast(vertices(i).TShape());
            const double before = vertex->Tolerance();
            if (before >= reach)
                continue;
            vertex->Tolerance(reach);
            if (BRepCheck_Analyzer(face).IsValid())
                return true;
            vertex->Tolerance(before);
        }
    return false;
}

static void widen_each(const TopoDS_Shape &shape, double least, double most)
{
    for (TopExp_Explorer face(shape, TopAbs_FACE); face.More(); face.Next())
        if (!BRepCheck_Analyzer(face.Current()).IsValid())
            widen_one(face.Current(), least, most);
}

/* What can be mended without taking or adding faces. */
static TopoDS_Shape mended(const TopoDS_Shape &shape, double spacing)
{
    bool valid = BRepCheck_Analyzer(shape).IsValid();
    if (!valid) {
        widen_each(shape, LEAST_REACH * spacing, MOST_ALONE * spacing);
        valid = BRepCheck_Analyzer(shape).IsValid();
    }
    while (!valid && widen_vertices(shape, LEAST_REACH * spacing, MOST_REACH * spacing))
        valid = BRepCheck_Analyzer(shape).IsValid();
    if (valid)
        return shape;
    const TopoDS_Shape fixed = healed(shape);
    const bool fine = !fixed.IsNull() && BRepCheck_Analyzer(fixed).IsValid() &&
        face_count(fixed) == face_count(shape) && is_closed(fixed) == is_closed(shape);
    return fine ? fixed : shape;
}

static std::string why_open(const crease_topology &topology)
{
    const auto open = std::count(topology.open, topology.open + topology.region_count, true);
    if (open == 0)
        return "";
    return std::to_string(open) + " of " + std::to_string(topology.region_count) +
        (topology.region_count == 1 ? " face" : " faces") + (open == 1 ? " has" : " have") +
        " no closed border";
}

Attempt follow_topology(const Job &job, double)
{
    const Brep brep = brep_of(job.topology(), job.inwards());
    if (brep.shape.IsNull())
        return {TopoDS_Shape(), why_open(job.topology())};
    return {mended(brep.shape, job.spacing), why_open(job.topology())};
}

} // namespace crease_cad
