/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "cad/shell.hpp"

#include "cad/border.hpp"
#include "cad/kernel.hpp"
#include "cad/occt.hpp"

#include <BRepGProp.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_Line.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>

#include <algorithm>
#include <cmath>
#include <deque>

namespace crease_cad
{

namespace
{

constexpr double LEAST_VOLUME = 1e-9; /* beside the area to the power 3/2 */

/* Makes the faces one by one; the edges are made once and then get a curve in the (u, v) plane for
 * each of their faces. */
class Assembly
{
  public:
    Assembly(const std::vector<Patch> &given, const Measure &measure)
        : patches(given), tolerance(measure.tolerance), borders(match_borders(given, measure))
    {
    }

    TopoDS_Shape build();

  private:
    void make_vertices();
    void make_edge(const Edge &edge);
    void make_faces();
    void add_curves_on_faces(const Edge &edge, TopoDS_Edge &shape);
    void make_wires();
    bool runs_forward(const Stretch &stretch) const;
    void orient();
    void orient_neighbours(size_t patch, std::deque<size_t> &queue);
    TopoDS_Shape shell_of(size_t number);

    const std::vector<Patch> &patches;
    double tolerance;
    Borders borders;
    BRep_Builder builder;
    std::vector<TopoDS_Vertex> vertices;
    std::vector<TopoDS_Edge> edges;
    std::vector<TopoDS_Face> faces;
    std::vector<size_t> shell;                 /* of each patch, from 1 */
    std::vector<bool> flipped;                 /* faces whose normal is turned round */
    std::vector<std::vector<size_t>> edges_of; /* of each patch */
};

gp_Pnt2d place_on(Side side, double t)
{
    switch (side) {
    case SIDE_V0:
        return gp_Pnt2d(t, 0.0);
    case SIDE_U1:
        return gp_Pnt2d(1.0, t);
    case SIDE_V1:
        return gp_Pnt2d(t, 1.0);
    default:
        return gp_Pnt2d(0.0, t);
    }
}

/* The straight line in the (u, v) plane that runs from a to b while t runs from first to last. */
Handle(Geom2d_Curve) line_between(const gp_Pnt2d &a, const gp_Pnt2d &b, double first, double last)
{
    const gp_Vec2d along(a, b);
    if (along.Magnitude() == last - first) {
        const gp_Dir2d direction(along);
        return new Geom2d_Line(a.Translated(gp_Vec2d(direction) * -first), direction);
    }
    TColgp_Array1OfPnt2d poles(1, 2);
    TColStd_Array1OfReal knots(1, 2);
    TColStd_Array1OfInteger times(1, 2);
    poles(1) = a, poles(2) = b;
    knots(1) = first, knots(2) = last;
    times.Init(2);
    return new Geom2d_BSplineCurve(poles, knots, times, 1);
}

void Assembly::make_vertices()
{
    for (const gp_XYZ &place : borders.vertices) {
        vertices.emplace_back();
        builder.MakeVertex(vertices.back(), gp_Pnt(place), tolerance);
    }
}

/* The edge's curve is that of its first stretch, cut to what is used. */
void Assembly::make_edge(const Edge &edge)
{
    const Stretch &stretch = borders.stretches[edge.stretches[0]];
    const Border &border = borders.borders[stretch.border];
    TopoDS_Edge shape;
    if (border.degenerate) {
        builder.MakeEdge(shape);
        builder.Degenerated(shape, true);
    } else {
        const Handle(Geom_BSplineCurve) curve =
            Handle(Geom_BSplineCurve)::DownCast(border.curve->Copy());
        if (stretch.from > 0.0 || stretch.to < 1.0)
            curve->Segment(stretch.from, stretch.to);
        builder.MakeEdge(shape, curve, tolerance);
    }
    builder.Add(shape, vertices[stretch.vertices[0]].Oriented(TopAbs_FORWARD));
    builder.Add(shape, vertices[stretch.vertices[1]].Oriented(TopAbs_REVERSED));
    add_curves_on_faces(edge, shape);
    edges.push_back(shape);
}

void Assembly::add_curves_on_faces(const Edge &edge, TopoDS_Edge &shape)
{
    const Stretch &first = borders.stretches[edge.stretches[0]];
    std::vector<Handle(Geom2d_Curve)> lines;
    for (const size_t i : edge.stretches) {
        const Stretch &stretch = borders.stretches[i];
        const Side side = borders.borders[stretch.border].side;
        const gp_Pnt2d from = place_on(side, stretch.from), to = place_on(side, stretch.to);
        lines.push_back(line_between(
            stretch.backward ? to : from, stretch.backward ? from : to, first.from, first.to));
    }
    const auto face_of = [&](size_t i) -> const TopoDS_Face & {
        return faces[borders.borders[borders.stretches[edge.stretches[i]].border].patch];
    };
    if (lines.size() == 2 && face_of(0).IsSame(face_of(1))) {
        const size_t forward = runs_forward(first) ? 0 : 1;
        builder.UpdateEdge(shape, lines[forward], lines[1 - forward], face_of(0), tolerance);
    } else {
        for (size_t i = 0; i < lines.size(); i++)
            builder.UpdateEdge(shape, lines[i], face_of(i), tolerance);
    }
    builder.Range(shape, first.from, first.to);
}

/* Whether a walk around the face, the face on the left, goes along the edge. */
bool Assembly::runs_forward(const Stretch &stretch) const
{
    const Side side = borders.borders[stretch.border].side;
    return (side == SIDE_V0 || side == SIDE_U1) != stretch.backward;
}

void Assembly::make_faces()
{
    for (const Patch &patch : patches) {
        faces.emplace_back();
        builder.MakeFace(faces.back(), surface_of(patch.net), tolerance);
    }
}

void Assembly::make_wires()
{
    std::vector<std::vector<const Stretch *>> walk(borders.borders.size());
    for (const Stretch &stretch : borders.stretches) {
        const Side side = borders.borders[stretch.border].side;
        std::vector<const Stretch *> &of_side = walk[stretch.border];
        of_side.insert(
            side == SIDE_V0 || side == SIDE_U1 ? of_side.end() : of_side.begin(), &stretch);
    }
    for (size_t i = 0; i < faces.size(); i++) {
        TopoDS_Wire wire;
        builder.MakeWire(wire);
        for (size_t side = 0; side < SIDE_COUNT; side++)
            for (const Stretch *stretch : walk[i * SIDE_COUNT + side])
                builder.Add(wire,
                    edges[stretch->edge].Oriented(
                        runs_forward(*stretch) ? TopAbs_FORWARD : TopAbs_REVERSED));
        wire.Closed(true);
        builder.Add(faces[i], wire);
    }
}

/* Two faces of one shell go along their common edge in opposite directions. */
void Assembly::orient_neighbours(size_t patch, std::deque<size_t> &queue)
{
    for (const size_t edge : edges_of[patch]) {
        const std::vector<size_t> &pair = borders.edges[edge].stretches;
        if (pair.size() != 2)
            continue;
        const Stretch &a = borders.stretches[pair[0]], &b = borders.stretches[pair[1]];
        const size_t p = borders.borders[a.border].patch, q = borders.borders[b.border].patch;
        const size_t other = p == patch ? q : p;
        const bool flip = flipped[patch] != (runs_forward(a) == runs_forward(b));
        if (shell[other] == 0) {
            shell[other] = shell[patch];
            flipped[other] = flip;
            queue.push_back(other);
        } else if (p != q && flipped[other] != flip) {
            throw Failure{CREASE_ERROR_NUMERIC,
                "surface " + std::to_string(patches[other].surface + 1) +
                    " closes a band with one side only, which CAD files cannot hold; leave a "
                    "surface out"};
        }
    }
}

void Assembly::orient()
{
    shell.assign(patches.size(), 0);
    flipped.assign(patches.size(), false);
    edges_of.resize(patches.size());
    for (const Stretch &stretch : borders.stretches)
        edges_of[borders.borders[stretch.border].patch].push_back(stretch.edge);
    size_t shells = 0;
    for (size_t i = 0; i < patches.size(); i++) {
        if (shell[i] != 0)
            continue;
        shell[i] = ++shells;
        for (std::deque<size_t> queue = {i}; !queue.empty(); queue.pop_front())
            orient_neighbours(queue.front(), queue);
    }
}

/* The shell, or the solid when it is closed, its faces turned outwards. */
TopoDS_Shape Assembly::shell_of(size_t number)
{
    TopoDS_Shell out;
    builder.MakeShell(out);
    for (size_t i = 0; i < faces.size(); i++)
        if (shell[i] == number)
            builder.Add(out, faces[i].Oriented(flipped[i] ? TopAbs_REVERSED : TopAbs_FORWARD));
    out.Closed(BRep_Tool::IsClosed(out));
    if (!out.Closed())
        return out;
    GProp_GProps area, volume(gp_Pnt(borders.vertices[0]));
    BRepGProp::SurfaceProperties(out, area);
    BRepGProp::VolumeProperties(out, volume);
    if (std::fabs(volume.Mass()) < LEAST_VOLUME * std::pow(area.Mass(), 1.5))
        throw Failure{CREASE_ERROR_NUMERIC,
            "surfaces lie on each other: the closed shell around "
            "them is empty; leave one out"};
    if (volume.Mass() < 0)
        out.Reverse();
    TopoDS_Solid solid;
    builder.MakeSolid(solid);
    builder.Add(solid, out);
    return solid;
}

TopoDS_Shape Assembly::build()
{
    make_faces();
    make_vertices();
    for (const Edge &edge : borders.edges)
        make_edge(edge);
    make_wires();
    orient();
    std::vector<TopoDS_Shape> parts;
    for (size_t left = faces.size(), number = 1; left > 0; number++) {
        left -= (size_t)std::count(shell.begin(), shell.end(), number);
        parts.push_back(shell_of(number));
    }
    if (parts.size() == 1)
        return parts[0];
    TopoDS_Compound compound;
    builder.MakeCompound(compound);
    for (const TopoDS_Shape &part : parts)
        builder.Add(compound, part);
    return compound;
}

} // namespace

TopoDS_Shape assemble(const std::vector<Patch> &patches, const Measure &measure)
{
    return Assembly(patches, measure).build();
}

} // namespace crease_cad
