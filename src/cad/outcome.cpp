/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "cad/outcome.hpp"

#include "cad/apart.hpp"
#include "cad/bicubic.hpp"
#include "cad/closing.hpp"
#include "cad/edge_curve.hpp"
#include "cad/kernel.hpp"
#include "cad/naming.hpp"
#include "cad/turn.hpp"

#include <BRepBuilderAPI_Transform.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRep_Tool.hxx>
#include <BinTools.hxx>
#include <GProp_GProps.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>

#include <sstream>

namespace crease_cad
{

static constexpr double INTEGRAL_ERROR = 1e-7; /* relative, of areas and volumes */

static std::vector<char> bytes_of(const TopoDS_Shape &shape)
{
    std::ostringstream stream;
    BinTools::Write(shape, stream, false, false, BinTools_FormatVersion_CURRENT);
    const std::string text = stream.str();
    return {text.begin(), text.end()};
}

TopoDS_Shape shape_from(const std::vector<char> &bytes)
{
    std::istringstream stream(std::string(bytes.begin(), bytes.end()));
    TopoDS_Shape shape;
    BinTools::Read(shape, stream);
    if (shape.IsNull())
        throw Failure{CREASE_ERROR_NUMERIC, "OpenCASCADE cannot read its own shape"};
    return shape;
}

static size_t count_of(const TopoDS_Shape &shape, TopAbs_ShapeEnum kind)
{
    TopTools_IndexedMapOfShape found;
    TopExp::MapShapes(shape, kind, found);
    return (size_t)found.Extent();
}

static Summary summarise(const TopoDS_Shape &shape)
{
    Summary out = {};
    out.closed = is_closed(shape);
    out.together = count_of(shape, TopAbs_SHELL) == 1 || count_of(shape, TopAbs_FACE) == 1;
    out.solids = out.closed ? (uint32_t)count_of(shape, TopAbs_SOLID) : 0;
    if (out.solids > 0)
        out.volume = std::max(0.0, volume_of(shape, INTEGRAL_ERROR));
    return out;
}

static std::vector<FaceFact> facts_of_faces(
    const Job &job, const TopoDS_Shape &shape, const Triangles &triangles)
{
    TopTools_IndexedMapOfShape faces;
    TopExp::MapShapes(shape, TopAbs_FACE, faces);
    const std::vector<uint32_t> carriers =
        carriers_of_faces(job, triangles, (size_t)faces.Extent());
    std::vector<FaceFact> facts;
    for (int i = 1; i <= faces.Extent(); i++)
        facts.push_back({carriers[(size_t)i - 1], area_of(faces(i), INTEGRAL_ERROR)});
    return facts;
}

static double length_of(const TopoDS_Edge &edge)
{
    GProp_GProps length;
    BRepGProp::LinearProperties(edge, length);
    return length.Mass();
}

static EdgeFact fact_of(const TopoDS_Edge &edge, const TopTools_ListOfShape &around,
    const TopTools_IndexedMapOfShape &faces)
{
    EdgeFact fact = {{UINT32_MAX, UINT32_MAX}, 0, 0, length_of(edge), 0.0};
    if (around.IsEmpty())
        return fact;
    const TopoDS_Face one = TopoDS::Face(around.First()), other = TopoDS::Face(around.Last());
    fact.faces[0] = (uint32_t)faces.FindIndex(one) - 1;
    if (one.IsSame(other) && !BRep_Tool::IsClosed(edge, one))
        return fact;
    fact.faces[1] = (uint32_t)faces.FindIndex(other) - 1;
    if (one.IsSame(other)) {
        fact.smooth = 1;
        fact.angle = 180.0;
        return fact;
    }
    const std::optional<Turn> turn = turn_at(edge, one, other);
    fact.smooth = !is_sharp(turn);
    fact.angle = !turn ? 180.0 : turn->convex ? 180.0 - turn->angle : 180.0 + turn->angle;
    return fact;
}

static void add_edges(const TopoDS_Shape &shape, Outcome &out)
{
    TopTools_IndexedMapOfShape faces;
    TopExp::MapShapes(shape, TopAbs_FACE, faces);
    TopTools_IndexedDataMapOfShapeListOfShape around;
    TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, around);
    for (int i = 1; i <= around.Extent(); i++) {
        const TopoDS_Edge edge = TopoDS::Edge(around.FindKey(i));
        if (BRep_Tool::Degenerated(edge))
            continue;
        EdgeFact fact = fact_of(edge, around(i), faces);
        fact.pole_count = (uint32_t)add_cubic_curve(edge, out.poles, out.knots);
        out.edges.push_back(fact);
    }
}

static TopoDS_Shape moved_outward(const Job &job, const TopoDS_Shape &shape)
{
    return BRepBuilderAPI_Transform(shape, job.outward, true).Shape();
}

/* Names the faces before they are moved: there the carriers are at hand. B-splines are the same
 * shape, but take much longer to measure. */
Outcome measure(const Job &job, const Attempt &attempt, bool as_bsplines)
{
    if (attempt.shape.IsNull() || !TopExp_Explorer(attempt.shape, TopAbs_FACE).More())
        throw Failure{CREASE_ERROR_NUMERIC, attempt.why.empty() ? "no face came out" : attempt.why};
    const TopoDS_Shape &inside = attempt.shape;
    Outcome out = {};
    out.why = attempt.why;
    out.triangles = tessellate(inside, MESH_TOLERANCE * job.diagonal);
    out.faces = facts_of_faces(job, inside, out.triangles);
    const double scale = job.outward.ScaleFactor();
    for (FaceFact &face : out.faces)
        face.area *= scale * scale;
    for (size_t v = 0; v < out.triangles.vertices.size(); v += 3) {
        double *const at = out.triangles.vertices.data() + v;
        job.outward.Transforms(at[0], at[1], at[2]);
    }
    const TopoDS_Shape shape = moved_outward(job, inside);
    out.summary = summarise(shape);
    add_edges(shape, out);
    const TopoDS_Shape final_shape = as_bsplines ? bicubic(shape) : shape;
    out.summary.valid = BRepCheck_Analyzer(final_shape).IsValid();
    out.shape = bytes_of(final_shape);
    return out;
}

/* ------------------------------------------------------------------------------------- bytes -- */

template <typename Item> static void put(std::vector<char> &bytes, const std::vector<Item> &items)
{
    const size_t count = items.size();
    append(bytes, &count, 1);
    append(bytes, items.data(), count);
}

template <typename Item> static void get(const char *&from, std::vector<Item> &items)
{
    const size_t count = take<size_t>(from, 1)[0];
    items = take<Item>(from, count);
}

std::vector<char> pack(const Outcome &outcome)
{
    std::vector<char> bytes;
    append(bytes, &outcome.summary, 1);
    put(bytes, std::vector<char>(outcome.why.begin(), outcome.why.end()));
    put(bytes, outcome.shape);
    put(bytes, outcome.triangles.vertices);
    put(bytes, outcome.triangles.triangles);
    put(bytes, outcome.triangles.owners);
    put(bytes, outcome.faces);
    put(bytes, outcome.edges);
    put(bytes, outcome.poles);
    put(bytes, outcome.knots);
    return bytes;
}

Outcome unpack(const std::vector<char> &bytes)
{
    const char *from = bytes.data();
    Outcome out = {};
    out.summary = take<Summary>(from, 1)[0];
    std::vector<char> why;
    get(from, why);
    out.why.assign(why.begin(), why.end());
    get(from, out.shape);
    get(from, out.triangles.vertices);
    get(from, out.triangles.triangles);
    get(from, out.triangles.owners);
    get(from, out.faces);
    get(from, out.edges);
    get(from, out.poles);
    get(from, out.knots);
    return out;
}

} // namespace crease_cad
