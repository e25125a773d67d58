/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Full turns are built by hand as OpenCASCADE's own primitives are: one wire of rim, seam, other
 * rim and seam again; a pole is an edge without length. */
#include "cad/brep.hpp"

#include "cad/closing.hpp"
#include "cad/kernel.hpp"
#include "cad/space_curve.hpp"

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Line.hxx>
#include <ShapeFix_Shell.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>

#include <algorithm>
#include <cmath>

namespace crease_cad
{

namespace
{

constexpr double TOLERANCE = 1e-7;
constexpr double SLACK = 1.05;        /* of tolerances, over the gaps measured */
constexpr double VERTEX_SLACK = 1.01; /* of a vertex, over its edges */
constexpr double SPREAD_SLACK = 1.2;
constexpr size_t LEAST_SAMPLES = 12, MOST_SAMPLES = 400;

struct VertexShape {
    gp_XYZ place;
    TopoDS_Vertex shape;
    double tolerance;
};

struct EdgeShape {
    SpaceCurve space;
    TopoDS_Edge shape; /* null when no curve goes along its points */
    size_t samples;
    double tolerance;
};

class Assembly
{
  public:
    Assembly(const crease_topology &topology, const Scaling &scaling);
    Brep build();

  private:
    void make_vertices();
    void make_edge(const crease_edge &edge);
    void make_edges();
    bool has_edges(const crease_face &face) const;
    TopoDS_Face make_face(const crease_face &face);
    void add_patch(const crease_face &face, TopoDS_Face &out);
    void add_band(const crease_face &face, TopoDS_Face &out);
    void add_cap(const crease_face &face, TopoDS_Face &out);
    void add_holes(const crease_face &face, size_t first, TopoDS_Face &out);
    void add_loop(const crease_face &face, const crease_loop &loop, TopoDS_Wire &wire);
    TopoDS_Edge make_seam(const crease_face &face, const int32_t vertices[2]);
    TopoDS_Edge make_pole(const crease_face &face, int32_t apex, double v);
    int32_t add_vertex(const gp_XYZ &place);
    void reach(VertexShape &vertex, const gp_XYZ &place);
    void set_tolerances();
    double height_at(const crease_face &face, int32_t vertex) const;

    const crease_topology &topology;
    Scaling scaling;
    BRep_Builder builder;
    std::vector<Sheet> sheets;
    std::vector<VertexShape> vertices;
    std::vector<EdgeShape> edges;
};

Assembly::Assembly(const crease_topology &from, const Scaling &by) : topology(from), scaling(by)
{
    for (size_t i = 0; i < topology.region_count; i++)
        sheets.emplace_back(topology.charts[i], scaling);
}

/* --------------------------------------------------------------------- vertices and edges -- */

int32_t Assembly::add_vertex(const gp_XYZ &place)
{
    VertexShape vertex = {place, TopoDS_Vertex(), TOLERANCE};
    builder.MakeVertex(vertex.shape, gp_Pnt(place), TOLERANCE);
    vertices.push_back(vertex);
    return (int32_t)vertices.size() - 1;
}

void Assembly::make_vertices()
{
    for (size_t i = 0; i < topology.vertex_count; i++) {
        const crease_vertex &from = topology.vertices[i];
        VertexShape &vertex = vertices[(size_t)add_vertex(scaling(from.place))];
        vertex.tolerance = std::max(TOLERANCE, SPREAD_SLACK * from.spread * scaling.factor);
    }
}

/* Widens a vertex so that it reaches a place. */
void Assembly::reach(VertexShape &vertex, const gp_XYZ &place)
{
    vertex.tolerance = std::max(vertex.tolerance, SLACK * (place - vertex.place).Modulus());
}

void Assembly::make_edge(const crease_edge &from)
{
    EdgePoints points = {{}, from.closed, from.smooth, topology.spacing * scaling.factor};
    for (size_t i = 0; i < from.count; i++)
        points.places.push_back(scaling(from.points + 3 * i));
    EdgeShape edge = {crease_edge_is_rim(&from)
            ? space_curve(points)
            : space_curve(points, sheets[from.regions[0]], sheets[from.regions[1]]),
        TopoDS_Edge(), std::clamp(2 * from.count, LEAST_SAMPLES, MOST_SAMPLES), TOLERANCE};
    builder.MakeEdge(edge.shape, edge.space.curve, TOLERANCE);
    builder.Range(edge.shape, edge.space.first, edge.space.last);
    for (int end = 0; end < 2; end++) {
        VertexShape &vertex = vertices[(size_t)from.vertices[end]];
        reach(vertex, edge.space.at(end ? edge.space.last : edge.space.first));
        builder.Add(edge.shape, vertex.shape.Oriented(end ? TopAbs_REVERSED : TopAbs_FORWARD));
    }
    edges.push_back(edge);
}

void Assembly::make_edges()
{
    for (size_t i = 0; i < topology.edge_count; i++) {
        try {
            make_edge(topology.edges[i]);
        } catch (const Standard_Failure &) {
            edges.push_back({{nullptr, 0.0, 0.0}, TopoDS_Edge(), 0, TOLERANCE});
        }
    }
}

bool Assembly::has_edges(const crease_face &face) const
{
    for (size_t i = 0; i < face.loop_count; i++)
        for (size_t k = 0; k < face.loops[i].count; k++)
            if (edges[face.loops[i].halves[k].edge].shape.IsNull())
                return false;
    return true;
}

/* ------------------------------------------------------------------------------- faces -- */

double Assembly::height_at(const crease_face &face, int32_t vertex) const
{
    const gp_XY uv = sheets[face.region].at(vertices[(size_t)vertex].place);
    return face.direction == 0 ? uv.Y() : uv.X();
}

void Assembly::add_loop(const crease_face &face, const crease_loop &loop, TopoDS_Wire &wire)
{
    const Sheet &sheet = sheets[face.region];
    gp_XY at(loop.uv[0], loop.uv[1]);
    for (size_t i = 0; i < loop.count; i++) {
        const crease_half half = loop.halves[i];
        EdgeShape &edge = edges[half.edge];
        const FlatCurve flat = flat_curve(edge.space, sheet, edge.samples, at, half.reversed);
        at = half.reversed ? flat.begin : flat.end;
        edge.tolerance = std::max(edge.tolerance, SLACK * flat.gap);
        if (sheet.type() != CREASE_REGION_PLANE)
            builder.UpdateEdge(edge.shape, flat.curve, sheet.surface, TopLoc_Location(), TOLERANCE);
        builder.Add(wire, edge.shape.Oriented(half.reversed ? TopAbs_REVERSED : TopAbs_FORWARD));
    }
}

void Assembly::add_holes(const crease_face &face, size_t first, TopoDS_Face &out)
{
    for (size_t i = first; i < face.loop_count; i++) {
        TopoDS_Wire wire;
        builder.MakeWire(wire);
        add_loop(face, face.loops[i], wire);
        wire.Closed(true);
        builder.Add(out, wire);
    }
}

/* Along the parameter that does not run round, where the other one is 0 and a whole turn. */
TopoDS_Edge Assembly::make_seam(const crease_face &face, const int32_t ends[2])
{
    const Sheet &sheet = sheets[face.region];
    const bool upright = face.direction == 0;
    const Handle(Geom_Curve) iso = upright ? sheet.surface->UIso(0.0) : sheet.surface->VIso(0.0);
    const gp_Dir2d along(upright ? 0.0 : 1.0, upright ? 1.0 : 0.0);
    const gp_Pnt2d far(upright ? TURN : 0.0, upright ? 0.0 : TURN);
    const Handle(Geom2d_Line) low = new Geom2d_Line(gp_Pnt2d(0.0, 0.0), along);
    const Handle(Geom2d_Line) high = new Geom2d_Line(far, along);
    TopoDS_Edge seam;
    builder.MakeEdge(seam, iso, TOLERANCE);
    builder.UpdateEdge(seam, upright ? high : low, upright ? low : high, sheet.surface,
        TopLoc_Location(), TOLERANCE);
    const double range[2] = {height_at(face, ends[0]), height_at(face, ends[1])};
    builder.Range(seam, range[0], range[1]);
    for (int end = 0; end < 2; end++) {
        VertexShape &vertex = vertices[(size_t)ends[end]];
        reach(vertex, iso->Value(range[end]).XYZ());
        builder.Add(seam, vertex.shape.Oriented(end ? TopAbs_REVERSED : TopAbs_FORWARD));
    }
    return seam;
}

void Assembly::add_patch(const crease_face &face, TopoDS_Face &out)
{
    add_holes(face, 0, out);
}

void Assembly::add_band(const crease_face &face, TopoDS_Face &out)
{
    const TopoDS_Edge seam = make_seam(face, face.seam);
    TopoDS_Wire wire;
    builder.MakeWire(wire);
    add_loop(face, face.loops[0], wire);
    builder.Add(wire, seam.Oriented(TopAbs_FORWARD));
    add_loop(face, face.loops[1], wire);
    builder.Add(wire, seam.Oriented(TopAbs_REVERSED));
    wire.Closed(true);
    builder.Add(out, wire);
    add_holes(face, 2, out);
}

/* All values of u at one v, which are one place. */
TopoDS_Edge Assembly::make_pole(const crease_face &face, int32_t apex, double v)
{
    const TopoDS_Vertex &vertex = vertices[(size_t)apex].shape;
    TopoDS_Edge pole;
    builder.MakeEdge(pole);
    builder.UpdateEdge(pole, new Geom2d_Line(gp_Pnt2d(0.0, v), gp_Dir2d(1.0, 0.0)),
        sheets[face.region].surface, TopLoc_Location(), TOLERANCE);
    builder.Degenerated(pole, true);
    builder.Range(pole, 0.0, TURN);
    builder.Add(pole, vertex.Oriented(TopAbs_FORWARD));
    builder.Add(pole, vertex.Oriented(TopAbs_REVERSED));
    return pole;
}

void Assembly::add_cap(const crease_face &face, TopoDS_Face &out)
{
    const Sheet &sheet = sheets[face.region];
    const double v = sheet.type() == CREASE_REGION_SPHERE
        ? (face.upper ? TURN / 4.0 : -TURN / 4.0)
        : -sheet.radius() / std::sin(sheet.half_angle());
    const int32_t apex = add_vertex(sheet.surface->Value(0.0, v).XYZ());
    const int32_t ends[2] = {face.upper ? face.seam[0] : apex, face.upper ? apex : face.seam[0]};
    const TopoDS_Edge seam = make_seam(face, ends), pole = make_pole(face, apex, v);
    TopoDS_Wire wire;
    builder.MakeWire(wire);
    if (face.upper)
        add_loop(face, face.loops[0], wire);
    else
        builder.Add(wire, pole.Oriented(TopAbs_FORWARD));
    builder.Add(wire, seam.Oriented(TopAbs_FORWARD));
    if (face.upper)
        builder.Add(wire, pole.Oriented(TopAbs_REVERSED));
    else
        add_loop(face, face.loops[0], wire);
    builder.Add(wire, seam.Oriented(TopAbs_REVERSED));
    wire.Closed(true);
    builder.Add(out, wire);
    add_holes(face, 1, out);
}

TopoDS_Face Assembly::make_face(const crease_face &face)
{
    TopoDS_Face out;
    if (face.kind == CREASE_FACE_WHOLE)
        return BRepBuilderAPI_MakeFace(sheets[face.region].surface, TOLERANCE);
    builder.MakeFace(out, sheets[face.region].surface, TOLERANCE);
    if (face.kind == CREASE_FACE_PATCH)
        add_patch(face, out);
    else if (face.kind == CREASE_FACE_BAND)
        add_band(face, out);
    else
        add_cap(face, out);
    return out;
}

/* ------------------------------------------------------------------------------- shapes -- */

void Assembly::set_tolerances()
{
    for (size_t i = 0; i < topology.edge_count; i++) {
        if (edges[i].shape.IsNull())
            continue;
        builder.UpdateEdge(edges[i].shape, edges[i].tolerance);
        for (const int32_t end : topology.edges[i].vertices) {
            VertexShape &vertex = vertices[(size_t)end];
            vertex.tolerance = std::max(vertex.tolerance, VERTEX_SLACK * edges[i].tolerance);
        }
    }
    for (const VertexShape &vertex : vertices)
        builder.UpdateVertex(vertex.shape, vertex.tolerance);
}

/* Faces as solids where they close, as shells otherwise, turned so that neighbours agree. */
TopoDS_Shape joined(const std::vector<TopoDS_Face> &faces)
{
    BRep_Builder builder;
    TopoDS_Shell shell;
    builder.MakeShell(shell);
    for (const TopoDS_Face &face : faces)
        builder.Add(shell, face);
    ShapeFix_Shell fix;
    fix.FixFaceOrientation(shell);
    const TopoDS_Shape fixed = fix.Shape();
    std::vector<TopoDS_Shell> shells;
    for (TopExp_Explorer it(fixed, TopAbs_SHELL); it.More(); it.Next())
        shells.push_back(TopoDS::Shell(it.Current()));
    const bool closed = std::all_of(shells.begin(), shells.end(),
        [](const TopoDS_Shell &part) { return BRep_Tool::IsClosed(part); });
    return closed && !shells.empty() ? solids_of(shells) : fixed;
}

Brep Assembly::build()
{
    Brep out = {TopoDS_Shape(), {}, {}, 0.0};
    make_vertices();
    make_edges();
    for (size_t i = 0; i < topology.face_count; i++) {
        if (!has_edges(topology.faces[i]))
            continue;
        try {
            out.faces.push_back(make_face(topology.faces[i]));
            out.regions.push_back(topology.faces[i].region);
        } catch (const Standard_Failure &) { /* one face less */
        }
    }
    set_tolerances();
    for (const EdgeShape &edge : edges)
        out.tolerance = std::max(out.tolerance, edge.tolerance / scaling.factor);
    if (!out.faces.empty())
        out.shape = joined(out.faces);
    return out;
}

} // namespace

Brep brep_of(const crease_topology &topology, const Scaling &scaling)
{
    return Assembly(topology, scaling).build();
}

} // namespace crease_cad
