/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Curves as edges that share the vertices in which they end. */
#include "cad/format.hpp"
#include "cad/kernel.hpp"
#include "cad/occt.hpp"
#include "cad/vertices.hpp"

#include <BRepCheck_Analyzer.hxx>
#include <BRep_Builder.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>

namespace crease_cad
{

static std::vector<Net> nets_of(const crease_curve *const *curves, size_t count)
{
    if (count == 0)
        throw Failure{CREASE_ERROR_ARGUMENT, "there is no curve to write; give at least one"};
    std::vector<Net> nets;
    for (size_t i = 0; i < count; i++) {
        nets.push_back(net_of(curves[i]));
        if (nets[i].degree[0] < 1)
            throw Failure{CREASE_ERROR_ARGUMENT,
                "curve " + std::to_string(i + 1) +
                    " is of order 1, which is no curve to CAD programs; use order 2 or more"};
    }
    return nets;
}

static std::vector<Handle(Geom_BSplineCurve)> smooth_curves(
    crease_context *context, const std::vector<Net> &nets, const Measure &measure)
{
    std::vector<Handle(Geom_BSplineCurve)> out;
    for (const Net &net : nets)
        for (const Net &piece : smooth_pieces(context, net, measure))
            out.push_back(curve_of(piece.degree[0], piece.knots[0], piece.points));
    if (out.empty())
        throw Failure{CREASE_ERROR_NUMERIC,
            "every curve has shrunk to a point; nothing is left to "
            "write"};
    return out;
}

/* The ends of each curve are vertices; curves that end within the joint of each other share one. */
static TopoDS_Shape assemble(
    const std::vector<Handle(Geom_BSplineCurve)> &curves, const Measure &measure)
{
    const BRep_Builder builder;
    std::vector<gp_XYZ> places;
    std::vector<TopoDS_Vertex> made;
    Vertices vertices(places, measure.joint);
    const auto vertex_at = [&](const gp_Pnt &place) {
        const size_t number = vertices.find_or_add(place.XYZ());
        if (number == made.size()) {
            made.emplace_back();
            builder.MakeVertex(made.back(), gp_Pnt(places[number]), measure.tolerance);
        }
        return made[number];
    };
    TopoDS_Compound out;
    builder.MakeCompound(out);
    for (const Handle(Geom_BSplineCurve) & curve : curves) {
        TopoDS_Edge edge;
        builder.MakeEdge(edge, curve, measure.tolerance);
        builder.Add(edge, vertex_at(curve->StartPoint()).Oriented(TopAbs_FORWARD));
        builder.Add(edge, vertex_at(curve->EndPoint()).Oriented(TopAbs_REVERSED));
        builder.Range(edge, 0.0, 1.0);
        builder.Add(out, edge);
    }
    return out;
}

static std::string file_content(crease_context *context, const crease_curve *const *curves,
    size_t count, const std::string &path)
{
    const Format format = format_of(path);
    const std::vector<Net> nets = nets_of(curves, count);
    const Measure measure = measure_of(nets);
    const TopoDS_Shape shape = assemble(smooth_curves(context, nets, measure), measure);
    if (!BRepCheck_Analyzer(shape).IsValid())
        throw Failure{
            CREASE_ERROR_NUMERIC, "OpenCASCADE finds fault with a curve; check the control points"};
    return text_of(shape, format, path);
}

} // namespace crease_cad

crease_status crease_cad_curves_write(
    crease_context *context, const crease_curve *const *curves, size_t count, const char *path)
{
    return crease_cad::guard(context, path, [&] {
        const std::string content = crease_cad::file_content(context, curves, count, path);
        crease_cad::require(crease_file_write(context, path, content.data(), content.size()));
    });
}
