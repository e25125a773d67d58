/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "cad/closing.hpp"

#include "cad/kernel.hpp"

#include <BRepCheck_Analyzer.hxx>
#include <BRepClass3d_SolidClassifier.hxx>
#include <BRepGProp.hxx>
#include <BRepLib.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Precision.hxx>
#include <ShapeUpgrade_UnifySameDomain.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <TopoDS_Wire.hxx>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace crease_cad
{

static constexpr double LEAST_VOID = 1e-3; /* of the volume around it */

double volume_of(const TopoDS_Shape &shape, double error)
{
    GProp_GProps volume;
    if (error > 0.0)
        BRepGProp::VolumeProperties(shape, volume, error);
    else
        BRepGProp::VolumeProperties(shape, volume);
    return volume.Mass();
}

double area_of(const TopoDS_Shape &shape, double error)
{
    GProp_GProps area;
    if (error > 0.0)
        BRepGProp::SurfaceProperties(shape, area, error);
    else
        BRepGProp::SurfaceProperties(shape, area);
    return std::fabs(area.Mass());
}

static bool bounds(const TopoDS_Shape &edge)
{
    return edge.Orientation() == TopAbs_FORWARD || edge.Orientation() == TopAbs_REVERSED;
}

/* The wire without edges that end inside the face; null when nothing is left. */
static TopoDS_Wire cleaned_wire(const TopoDS_Shape &given)
{
    BRep_Builder builder;
    TopoDS_Wire wire;
    bool any = false;
    for (TopoDS_Iterator edge(given.Oriented(TopAbs_FORWARD)); edge.More(); edge.Next()) {
        if (!bounds(edge.Value()))
            continue;
        if (!any)
            builder.MakeWire(wire);
        builder.Add(wire, edge.Value());
        any = true;
    }
    if (!any)
        return TopoDS_Wire();
    wire.Closed(BRep_Tool::IsClosed(wire));
    return TopoDS::Wire(wire.Oriented(given.Orientation()));
}

/* The traces of other faces that end inside a face are no borders of it. */
static TopoDS_Face cleaned(const TopoDS_Face &face)
{
    BRep_Builder builder;
    TopoDS_Face out = TopoDS::Face(face.EmptyCopied());
    out.Orientation(TopAbs_FORWARD);
    for (TopoDS_Iterator part(face.Oriented(TopAbs_FORWARD)); part.More(); part.Next()) {
        if (part.Value().ShapeType() != TopAbs_WIRE)
            continue;
        if (const TopoDS_Wire wire = cleaned_wire(part.Value()); !wire.IsNull())
            builder.Add(out, wire);
    }
    out.Orientation(face.Orientation());
    return out;
}

static size_t root_of(std::vector<size_t> &parent, size_t item)
{
    while (parent[item] != item)
        item = parent[item] = parent[parent[item]];
    return item;
}

/* Shells of faces that share edges, in the order of their first faces. */
static std::vector<TopoDS_Shell> connected(const std::vector<TopoDS_Face> &faces)
{
    BRep_Builder builder;
    TopoDS_Compound all;
    builder.MakeCompound(all);
    TopTools_IndexedMapOfShape numbers;
    for (const TopoDS_Face &face : faces) {
        builder.Add(all, face);
        numbers.Add(face);
    }
    TopTools_IndexedDataMapOfShapeListOfShape around;
    TopExp::MapShapesAndAncestors(all, TopAbs_EDGE, TopAbs_FACE, around);
    std::vector<size_t> parent(faces.size());
    std::iota(parent.begin(), parent.end(), (size_t)0);
    for (int i = 1; i <= around.Extent(); i++)
        for (const TopoDS_Shape &face : around(i)) {
            const size_t a = root_of(parent, (size_t)numbers.FindIndex(around(i).First()) - 1);
            const size_t b = root_of(parent, (size_t)numbers.FindIndex(face) - 1);
            parent[std::max(a, b)] = std::min(a, b);
        }
    std::vector<TopoDS_Shell> shells;
    std::vector<size_t> shell_at(faces.size());
    for (size_t i = 0; i < faces.size(); i++) {
        const size_t root = root_of(parent, i);
        if (root == i) {
            shell_at[i] = shells.size();
            shells.emplace_back();
            builder.MakeShell(shells.back());
        }
        builder.Add(shells[shell_at[root]], faces[i]);
    }
    for (TopoDS_Shell &shell : shells)
        shell.Closed(BRep_Tool::IsClosed(shell));
    return shells;
}

static TopoDS_Shape united(const TopoDS_Shape &shape)
{
    ShapeUpgrade_UnifySameDomain unify(shape, true, true, false);
    unify.Build();
    return unify.Shape();
}

static std::vector<TopoDS_Face> all_cleaned(const std::vector<TopoDS_Face> &faces)
{
    std::vector<TopoDS_Face> out;
    for (const TopoDS_Face &face : faces)
        out.push_back(cleaned(face));
    return out;
}

TopoDS_Shape solid_of(const std::vector<TopoDS_Face> &faces)
{
    struct Part {
        TopoDS_Shell shell;
        double volume;
    };
    std::vector<Part> parts;
    for (const TopoDS_Shell &shell : connected(all_cleaned(faces)))
        parts.push_back({shell, volume_of(shell)});
    if (parts.empty())
        throw Failure{CREASE_ERROR_NUMERIC, "no cell of the arrangement is inside"};
    std::stable_sort(parts.begin(), parts.end(),
        [](const Part &a, const Part &b) { return std::fabs(a.volume) > std::fabs(b.volume); });
    BRep_Builder builder;
    TopoDS_Solid solid;
    builder.MakeSolid(solid);
    for (size_t i = 0; i < parts.size(); i++)
        if (i == 0 || parts[i].volume < -LEAST_VOID * std::fabs(parts[0].volume))
            builder.Add(solid, parts[i].shell);
    return united(solid);
}

static TopoDS_Solid oriented_solid(TopoDS_Shell shell)
{
    BRep_Builder builder;
    TopoDS_Solid solid;
    shell.Closed(true);
    builder.MakeSolid(solid);
    builder.Add(solid, shell);
    BRepLib::OrientClosedSolid(solid);
    return solid;
}

static bool is_within(const TopoDS_Solid &inner, const TopoDS_Solid &outer)
{
    const TopoDS_Vertex vertex = TopoDS::Vertex(TopExp_Explorer(inner, TopAbs_VERTEX).Current());
    const BRepClass3d_SolidClassifier where(outer, BRep_Tool::Pnt(vertex), Precision::Confusion());
    return where.State() == TopAbs_IN;
}

TopoDS_Shape solids_of(const std::vector<TopoDS_Shell> &shells)
{
    struct Body {
        TopoDS_Solid solid, with_voids;
        double volume;
        int depth;     /* how many others it is within */
        size_t around; /* the smallest of them */
    };
    BRep_Builder builder;
    std::vector<Body> bodies;
    for (const TopoDS_Shell &shell : shells) {
        const TopoDS_Solid solid = oriented_solid(shell);
        bodies.push_back({solid, TopoDS::Solid(solid.EmptyCopied()), volume_of(solid), 0, 0});
    }
    std::stable_sort(bodies.begin(), bodies.end(),
        [](const Body &a, const Body &b) { return a.volume > b.volume; });
    TopoDS_Compound compound;
    builder.MakeCompound(compound);
    for (size_t i = 0; i < bodies.size(); i++) {
        for (size_t j = 0; j < i; j++)
            if (is_within(bodies[i].solid, bodies[j].solid)) {
                bodies[i].depth++;
                bodies[i].around = j;
            }
        const bool is_void = bodies[i].depth % 2 == 1;
        Body &whole = bodies[is_void ? bodies[i].around : i];
        const TopoDS_Shape shell = TopoDS_Iterator(bodies[i].solid).Value();
        builder.Add(whole.with_voids, is_void ? shell.Reversed() : shell);
    }
    size_t solids = 0;
    for (const Body &body : bodies)
        if (body.depth % 2 == 0) {
            builder.Add(compound, body.with_voids);
            solids++;
        }
    return solids == 1 ? TopoDS_Shape(bodies[0].with_voids) : TopoDS_Shape(compound);
}

TopoDS_Shape shells_of(const std::vector<TopoDS_Face> &faces)
{
    const std::vector<TopoDS_Shell> shells = connected(all_cleaned(faces));
    if (shells.size() == 1)
        return united(shells[0]);
    BRep_Builder builder;
    TopoDS_Compound compound;
    builder.MakeCompound(compound);
    for (const TopoDS_Shell &shell : shells)
        builder.Add(compound, united(shell));
    return compound;
}

bool is_closed(const TopoDS_Shape &shape)
{
    TopTools_IndexedDataMapOfShapeListOfShape around;
    TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, around);
    for (int i = 1; i <= around.Extent(); i++) {
        const TopoDS_Edge edge = TopoDS::Edge(around.FindKey(i));
        if (BRep_Tool::Degenerated(edge))
            continue;
        const int count = around(i).Extent();
        if (count > 2 || count == 0)
            return false;
        if (count == 1 && !BRep_Tool::IsClosed(edge, TopoDS::Face(around(i).First())))
            return false;
    }
    return around.Extent() > 0;
}

bool is_sound(const TopoDS_Shape &shape)
{
    return !shape.IsNull() && is_closed(shape) && BRepCheck_Analyzer(shape).IsValid() &&
        volume_of(shape) > 0.0;
}

} // namespace crease_cad
