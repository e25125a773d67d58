/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Every face lies on its smooth piece, whose parameters run from 0 to 1 here. */
#include "cad/trimmed.hpp"

#include "cad/format.hpp"
#include "cad/kernel.hpp"
#include "cad/net.hpp"
#include "cad/occt.hpp"
#include "cad/tessellate.hpp"
#include "crease/crease_cad.h"

#include <BRepCheck_Analyzer.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <GeomAPI_Interpolate.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TColgp_Array1OfPnt2d.hxx>
#include <TColgp_HArray1OfPnt.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Vertex.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Pnt2d.hxx>

#include <algorithm>
#include <cmath>
#include <map>

namespace crease_cad::trimmed
{

static constexpr double COARSE = 1.0 / 2000.0; /* of the diagonal: meshes are as near as that */

namespace
{

constexpr int LEAST_SAMPLES = 16, MOST_SAMPLES = 1024;
constexpr double CLOSE = 1e-7; /* of the size: a cubic that is as near to the surface will do */
constexpr double SLACK = 1.2;  /* of tolerances, over the gaps measured */

/* A smooth piece of the sheet, over [0, 1]. */
struct Piece {
    Handle(Geom_BSplineSurface) surface;
    double low[2], length[2]; /* of its parameters in the sheet */

    gp_Pnt2d at(const gp_Pnt2d &uv) const
    {
        return gp_Pnt2d((uv.X() - low[0]) / length[0], (uv.Y() - low[1]) / length[1]);
    }
};

struct EdgeShape {
    TopoDS_Edge shape;
    double first, last; /* its parameters */
    double tolerance;
};

class Assembly
{
  public:
    explicit Assembly(const crease_trim *trim);
    TopoDS_Shape build();

  private:
    const Piece &piece_of(int32_t face) const;
    Piece make_piece(const crease_surface *surface);
    void make_vertices();
    void make_edge(const crease_trim_edge &edge);
    EdgeShape iso_edge(const crease_trim_edge &edge, int constant);
    EdgeShape border_edge(const crease_trim_edge &edge);
    Handle(Geom2d_BSplineCurve)
        flat_curve(const crease_trim_edge &edge, const EdgeShape &shape, const Piece &piece) const;
    void make_face(size_t number);
    void set_tolerances();
    std::vector<std::vector<size_t>> shells() const;

    const crease_trim *trim;
    BRep_Builder builder;
    Measure measure;
    std::map<const crease_surface *, Piece> pieces;
    std::vector<TopoDS_Vertex> vertices;
    std::vector<gp_Pnt> places;
    std::vector<double> reach; /* tolerances of the vertices */
    std::vector<EdgeShape> edges;
    std::vector<TopoDS_Face> faces;
};

Assembly::Assembly(const crease_trim *from) : trim(from)
{
    std::vector<Net> nets;
    for (size_t i = 0; i < crease_trim_face_count(trim); i++)
        nets.push_back(net_of(crease_trim_surface(trim, i)));
    measure = measure_of(nets);
}

Piece Assembly::make_piece(const crease_surface *surface)
{
    Net net = net_of(surface);
    Piece piece;
    for (int d = 0; d < 2; d++) {
        std::vector<double> &knots = net.knots[d];
        piece.low[d] = knots.front();
        piece.length[d] = knots.back() - knots.front();
        for (double &knot : knots)
            knot = (knot - piece.low[d]) / piece.length[d];
    }
    piece.surface = surface_of(net);
    return piece;
}

const Piece &Assembly::piece_of(int32_t face) const
{
    return pieces.at(crease_trim_surface(trim, (size_t)face));
}

void Assembly::make_vertices()
{
    const size_t count = crease_trim_vertex_count(trim);
    const double *const uv = crease_trim_vertices(trim);
    std::vector<const Piece *> on(count, nullptr);
    for (size_t i = 0; i < crease_trim_edge_count(trim); i++) {
        const crease_trim_edge edge = crease_trim_edge_at(trim, i);
        for (const uint32_t vertex : edge.vertices)
            on[vertex] = &piece_of(std::max(edge.faces[0], edge.faces[1]));
    }
    for (size_t i = 0; i < count; i++) {
        const gp_Pnt2d at = on[i]->at(gp_Pnt2d(uv[2 * i], uv[2 * i + 1]));
        places.push_back(on[i]->surface->Value(at.X(), at.Y()));
        vertices.emplace_back();
        builder.MakeVertex(vertices.back(), places.back(), measure.tolerance);
        reach.push_back(measure.tolerance);
    }
}

/* ------------------------------------------------------------------------------------ edges -- */

gp_Pnt2d control_point(const crease_curve *curve, size_t i)
{
    const double *const p = crease_curve_control_points(curve) + 3 * i;
    return gp_Pnt2d(p[0], p[1]);
}

/* The parameter that is constant along a straight edge, or -1. */
int constant_along(const crease_trim_edge &edge)
{
    if (crease_curve_order(edge.curve) != 2 || crease_curve_count(edge.curve) != 2)
        return -1;
    const gp_Pnt2d a = control_point(edge.curve, 0), b = control_point(edge.curve, 1);
    return a.X() == b.X() ? 0 : a.Y() == b.Y() ? 1 : -1;
}

/* A piece of a parameter line of the surface: nothing is approximated. */
EdgeShape Assembly::iso_edge(const crease_trim_edge &edge, int constant)
{
    const Piece &piece = piece_of(std::max(edge.faces[0], edge.faces[1]));
    const gp_Pnt2d a = piece.at(control_point(edge.curve, 0));
    const gp_Pnt2d b = piece.at(control_point(edge.curve, 1));
    Handle(Geom_BSplineCurve) curve = Handle(Geom_BSplineCurve)::DownCast(
        constant == 0 ? piece.surface->UIso(a.X()) : piece.surface->VIso(a.Y()));
    double first = constant == 0 ? a.Y() : a.X(), last = constant == 0 ? b.Y() : b.X();
    if (first > last) {
        curve->Reverse(); /* from t to 1 - t */
        first = 1.0 - first;
        last = 1.0 - last;
    }
    if (first > 0.0 || last < 1.0)
        curve->Segment(first, last);
    EdgeShape out = {TopoDS_Edge(), first, last, measure.tolerance};
    builder.MakeEdge(out.shape, curve, measure.tolerance);
    return out;
}

/* The place of a border and the direction in which it goes on. */
struct Passage {
    gp_Pnt place;
    gp_Vec along;
};

Passage pass(const crease_curve *curve, const Piece &piece, double t)
{
    double at[6];
    crease_curve_evaluate(curve, t, t > 0.5 ? CREASE_SIDE_LEFT : CREASE_SIDE_RIGHT, 1, at);
    const gp_Pnt2d uv = piece.at(gp_Pnt2d(at[0], at[1]));
    Passage out;
    gp_Vec u, v;
    piece.surface->D1(uv.X(), uv.Y(), out.place, u, v);
    out.along = u * (at[3] / piece.length[0]) + v * (at[4] / piece.length[1]);
    return out;
}

Handle(Geom_BSplineCurve)
    cubic_along(const crease_curve *curve, const Piece &piece, int samples, double length)
{
    Handle(TColgp_HArray1OfPnt) through = new TColgp_HArray1OfPnt(1, samples + 1);
    Handle(TColStd_HArray1OfReal) at = new TColStd_HArray1OfReal(1, samples + 1);
    for (int i = 0; i <= samples; i++) {
        at->SetValue(i + 1, (double)i / samples);
        through->SetValue(i + 1, pass(curve, piece, (double)i / samples).place);
    }
    GeomAPI_Interpolate interpolation(through, at, false, 1e-12 * length);
    interpolation.Load(pass(curve, piece, 0.0).along, pass(curve, piece, 1.0).along, false);
    interpolation.Perform();
    if (!interpolation.IsDone())
        throw Failure{CREASE_ERROR_NUMERIC, "a border has no curve on its surface"};
    return interpolation.Curve();
}

double gap_of(const Handle(Geom_BSplineCurve) & cubic, const crease_curve *curve,
    const Piece &piece, int samples)
{
    /* in every span of either curve */
    const int places = 3 * std::max(samples, (int)crease_curve_count(curve));
    double gap = 0.0;
    for (int i = 0; i < places; i++) {
        const double t = (i + 0.5) / places;
        gap = std::max(gap, cubic->Value(t).Distance(pass(curve, piece, t).place));
    }
    return gap;
}

EdgeShape Assembly::border_edge(const crease_trim_edge &edge)
{
    const Piece &piece = piece_of(std::max(edge.faces[0], edge.faces[1]));
    Handle(Geom_BSplineCurve) cubic;
    double gap = INFINITY;
    for (int n = LEAST_SAMPLES; n <= MOST_SAMPLES && gap > CLOSE * measure.size; n *= 2) {
        cubic = cubic_along(edge.curve, piece, n, measure.size);
        gap = gap_of(cubic, edge.curve, piece, n);
    }
    EdgeShape out = {TopoDS_Edge(), 0.0, 1.0, std::max(measure.tolerance, SLACK * gap)};
    builder.MakeEdge(out.shape, cubic, out.tolerance);
    return out;
}

void Assembly::make_edge(const crease_trim_edge &edge)
{
    const int constant = constant_along(edge);
    EdgeShape out = constant < 0 ? border_edge(edge) : iso_edge(edge, constant);
    for (const int32_t face : edge.faces)
        if (face >= 0)
            builder.UpdateEdge(out.shape, flat_curve(edge, out, piece_of(face)),
                faces[(size_t)face], out.tolerance);
    builder.Range(out.shape, out.first, out.last);
    for (int end = 0; end < 2; end++) {
        const size_t vertex = edge.vertices[end];
        double first, last;
        const Handle(Geom_Curve) curve = BRep_Tool::Curve(out.shape, first, last);
        const double away = curve->Value(end ? last : first).Distance(places[vertex]);
        reach[vertex] = std::max({reach[vertex], SLACK * away, out.tolerance});
        builder.Add(out.shape, vertices[vertex].Oriented(end ? TopAbs_REVERSED : TopAbs_FORWARD));
    }
    edges.push_back(out);
}

/* The edge in the parameters of a piece. */
Handle(Geom2d_BSplineCurve) Assembly::flat_curve(
    const crease_trim_edge &edge, const EdgeShape &shape, const Piece &piece) const
{
    const int order = crease_curve_order(edge.curve);
    const size_t count = crease_curve_count(edge.curve);
    const double *const knots = crease_curve_knots(edge.curve);
    std::vector<double> values;
    std::vector<int> times;
    for (size_t i = 0; i < count + (size_t)order; i++) {
        if (i == 0 || knots[i] != knots[i - 1]) {
            values.push_back(shape.first + knots[i] * (shape.last - shape.first));
            times.push_back(0);
        }
        times.back()++;
    }
    values.back() = shape.last;
    TColgp_Array1OfPnt2d poles(1, (int)count);
    for (size_t i = 0; i < count; i++)
        poles((int)i + 1) = piece.at(control_point(edge.curve, i));
    return new Geom2d_BSplineCurve(poles,
        TColStd_Array1OfReal(values.front(), 1, (int)values.size()),
        TColStd_Array1OfInteger(times.front(), 1, (int)times.size()), order - 1);
}

/* ------------------------------------------------------------------------------------ faces -- */

void Assembly::make_face(size_t number)
{
    for (size_t loop = 0; loop < crease_trim_loop_count(trim, number); loop++) {
        size_t count = 0;
        const crease_trim_half *const halves = crease_trim_loop(trim, number, loop, &count);
        TopoDS_Wire wire;
        builder.MakeWire(wire);
        for (size_t i = 0; i < count; i++)
            builder.Add(wire,
                edges[halves[i].edge].shape.Oriented(
                    halves[i].reversed ? TopAbs_REVERSED : TopAbs_FORWARD));
        wire.Closed(true);
        builder.Add(faces[number], wire);
    }
}

void Assembly::set_tolerances()
{
    for (size_t i = 0; i < vertices.size(); i++)
        builder.UpdateVertex(vertices[i], reach[i]);
}

/* Faces that hang together, by number. */
std::vector<std::vector<size_t>> Assembly::shells() const
{
    std::vector<size_t> of(faces.size());
    for (size_t i = 0; i < of.size(); i++)
        of[i] = i;
    for (bool changed = true; changed;) {
        changed = false;
        for (size_t i = 0; i < crease_trim_edge_count(trim); i++) {
            const crease_trim_edge edge = crease_trim_edge_at(trim, i);
            if (edge.faces[0] < 0 || edge.faces[1] < 0)
                continue;
            size_t &a = of[(size_t)edge.faces[0]], &b = of[(size_t)edge.faces[1]];
            changed = changed || a != b;
            a = b = std::min(a, b);
        }
    }
    std::map<size_t, std::vector<size_t>> groups;
    for (size_t i = 0; i < of.size(); i++)
        groups[of[i]].push_back(i);
    std::vector<std::vector<size_t>> out;
    for (const auto &group : groups)
        out.push_back(group.second);
    return out;
}

TopoDS_Shape Assembly::build()
{
    for (size_t i = 0; i < crease_trim_face_count(trim); i++) {
        const crease_surface *const surface = crease_trim_surface(trim, i);
        if (pieces.find(surface) == pieces.end())
            pieces.emplace(surface, make_piece(surface));
        faces.emplace_back();
        builder.MakeFace(faces.back(), piece_of((int32_t)i).surface, measure.tolerance);
    }
    make_vertices();
    for (size_t i = 0; i < crease_trim_edge_count(trim); i++)
        make_edge(crease_trim_edge_at(trim, i));
    for (size_t i = 0; i < faces.size(); i++)
        make_face(i);
    set_tolerances();
    TopoDS_Compound all;
    TopoDS_Shell shell;
    builder.MakeCompound(all);
    const std::vector<std::vector<size_t>> groups = shells();
    for (const std::vector<size_t> &group : groups) {
        shell = TopoDS_Shell();
        builder.MakeShell(shell);
        for (const size_t face : group)
            builder.Add(shell, faces[face]);
        builder.Add(all, shell);
    }
    if (groups.size() == 1)
        return shell;
    return all;
}

} // namespace

} // namespace crease_cad::trimmed

namespace crease_cad
{

TopoDS_Shape shape_of(const crease_trim *trim)
{
    const TopoDS_Shape shape = trimmed::Assembly(trim).build();
    if (!BRepCheck_Analyzer(shape).IsValid())
        throw Failure{CREASE_ERROR_NUMERIC,
            "OpenCASCADE finds fault with the trimmed sheet; leave it untrimmed"};
    return shape;
}

} // namespace crease_cad

crease_status crease_cad_trim_write(
    crease_context *context, const crease_trim *trim, const char *path)
{
    return crease_cad::guard(context, path, [&] {
        const crease_cad::Format format = crease_cad::format_of(path);
        const std::string content = crease_cad::text_of(crease_cad::shape_of(trim), format, path);
        crease_cad::require(crease_file_write(context, path, content.data(), content.size()));
    });
}

crease_status crease_cad_trim_mesh(
    crease_context *context, const crease_trim *trim, double tolerance, crease_mesh **out)
{
    if (out)
        *out = nullptr;
    if (!(tolerance >= 0.0 && tolerance < HUGE_VAL))
        return crease_context_fail(context, CREASE_ERROR_ARGUMENT,
            "mesh: the tolerance is %g; give a length, or 0 for the default", tolerance);
    return crease_cad::guard(context, "mesh", [&] {
        const TopoDS_Shape shape = crease_cad::shape_of(trim);
        if (!out)
            return;
        const double within =
            tolerance > 0.0 ? tolerance : crease_cad::trimmed::COARSE * crease_cad::diagonal(shape);
        const crease_cad::Triangles found = crease_cad::tessellate(shape, within);
        const crease_mesh_parts parts = {found.vertices.size() / 3, found.triangles.size() / 3,
            found.vertices.data(), found.triangles.data(), found.owners.data()};
        crease_cad::require(crease_mesh_from_parts(context, &parts, out));
    });
}
