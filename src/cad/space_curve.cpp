/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "cad/space_curve.hpp"

#include "cad/kernel.hpp"

#include <ElCLib.hxx>
#include <Geom2dAPI_Interpolate.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_Line.hxx>
#include <GeomAPI_Interpolate.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_Circle.hxx>
#include <Geom_Ellipse.hxx>
#include <Geom_Line.hxx>
#include <IntAna_QuadQuadGeo.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TColgp_HArray1OfPnt.hxx>
#include <TColgp_HArray1OfPnt2d.hxx>
#include <gp_Circ.hxx>
#include <gp_Cone.hxx>
#include <gp_Cylinder.hxx>
#include <gp_Elips.hxx>
#include <gp_Lin.hxx>
#include <gp_Pln.hxx>
#include <gp_Sphere.hxx>

#include <algorithm>
#include <cmath>
#include <optional>

namespace crease_cad
{

static constexpr double ANGLE_TOLERANCE = 1e-12;
static constexpr double LENGTH_TOLERANCE = 1e-12; /* of the size of a part, about 10 */
/* In spacings. */
static constexpr double OFF_CONIC = 0.05; /* that the middle of an edge may be off its conic */
static constexpr double APART = 0.2;      /* least distance of points that a cubic goes through */
static constexpr double STRAIGHT = 1e-5;

/* ------------------------------------------------------------------------------- conics -- */

static std::optional<SpaceCurve> line_between(const gp_XYZ &a, const gp_XYZ &b)
{
    const double length = (b - a).Modulus();
    if (!(length > 0.0))
        return std::nullopt;
    return SpaceCurve{new Geom_Line(gp_Pnt(a), gp_Dir(b - a)), 0.0, length};
}

/* The line, as far as the edge goes along it. */
static std::optional<SpaceCurve> part_of_line(const gp_Lin &line, const EdgePoints &edge)
{
    const auto foot = [&](const gp_XYZ &place) {
        return ElCLib::Value(ElCLib::Parameter(line, gp_Pnt(place)), line).XYZ();
    };
    if (line.Distance(gp_Pnt(edge.places[edge.places.size() / 2])) > OFF_CONIC * edge.spacing)
        return std::nullopt;
    return line_between(foot(edge.places.front()), foot(edge.places.back()));
}

/* Whether points go round an axis the positive way. */
static bool runs_positively(const EdgePoints &edge, const gp_Ax2 &axis)
{
    double sum = 0.0;
    for (size_t i = 0; i + 1 < edge.places.size(); i++) {
        const gp_XYZ a = edge.places[i] - axis.Location().XYZ();
        const gp_XYZ b = edge.places[i + 1] - axis.Location().XYZ();
        sum += (a ^ b) * axis.Direction().XYZ();
    }
    return sum > 0.0;
}

/* Circle or ellipse, turned so that it runs as the edge does. */
template <class Conic, class Curve>
static std::optional<SpaceCurve> part_of_ring(Conic conic, const EdgePoints &edge)
{
    gp_Ax2 axes = conic.Position();
    if (!runs_positively(edge, axes))
        axes = gp_Ax2(axes.Location(), axes.Direction().Reversed(), axes.XDirection());
    conic.SetPosition(axes);
    const auto parameter = [&](const gp_XYZ &place) {
        return ElCLib::Parameter(conic, gp_Pnt(place));
    };
    const gp_XYZ &middle = edge.places[edge.places.size() / 2];
    if ((ElCLib::Value(parameter(middle), conic).XYZ() - middle).Modulus() >
        OFF_CONIC * edge.spacing)
        return std::nullopt;
    const double first = parameter(edge.places.front());
    double last = edge.closed ? first + TURN : parameter(edge.places.back());
    if (last <= first)
        last += TURN;
    return SpaceCurve{new Curve(conic), first, last};
}

static IntAna_QuadQuadGeo meet_plane(const Sheet &plane, const Sheet &other)
{
    const gp_Pln flat(plane.frame());
    IntAna_QuadQuadGeo out;
    switch (other.type()) {
    case CREASE_REGION_CYLINDER:
        out.Perform(
            flat, gp_Cylinder(other.frame(), other.radius()), ANGLE_TOLERANCE, LENGTH_TOLERANCE);
        break;
    case CREASE_REGION_CONE:
        out.Perform(flat, gp_Cone(other.frame(), other.half_angle(), other.radius()),
            ANGLE_TOLERANCE, LENGTH_TOLERANCE);
        break;
    default:
        out.Perform(flat, gp_Sphere(other.frame(), other.radius()));
    }
    return out;
}

static std::optional<SpaceCurve> conic(const EdgePoints &edge, const Sheet &a, const Sheet &b)
{
    if (edge.smooth)
        return std::nullopt;
    if (a.type() != CREASE_REGION_PLANE)
        return b.type() == CREASE_REGION_PLANE ? conic(edge, b, a) : std::nullopt;
    if (b.type() == CREASE_REGION_PLANE)
        return line_between(edge.places.front(), edge.places.back());
    if (b.type() == CREASE_REGION_TORUS || b.type() == CREASE_REGION_FREEFORM)
        return std::nullopt;
    IntAna_QuadQuadGeo meeting = meet_plane(a, b);
    if (!meeting.IsDone())
        return std::nullopt;
    if (meeting.TypeInter() == IntAna_Circle)
        return part_of_ring<gp_Circ, Geom_Circle>(meeting.Circle(1), edge);
    if (meeting.TypeInter() == IntAna_Ellipse)
        return part_of_ring<gp_Elips, Geom_Ellipse>(meeting.Ellipse(1), edge);
    if (meeting.TypeInter() != IntAna_Line)
        return std::nullopt;
    for (int i = 1; i <= meeting.NbSolutions(); i++)
        if (const auto line = part_of_line(meeting.Line(i), edge))
            return line;
    return std::nullopt;
}

/* ------------------------------------------------------------------------------- cubics -- */

/* Without the points that are too close to the one before, or to the last. */
static std::vector<gp_XYZ> thinned(const EdgePoints &edge)
{
    const gp_XYZ &last = edge.places.back();
    const double apart = APART * edge.spacing;
    std::vector<gp_XYZ> out = {edge.places.front()};
    for (size_t i = 1; i + 1 < edge.places.size(); i++)
        if ((edge.places[i] - out.back()).Modulus() >= apart &&
            (edge.places[i] - last).Modulus() >= apart)
            out.push_back(edge.places[i]);
    out.push_back(last);
    return out;
}

static bool is_straight(const std::vector<gp_XYZ> &places, double tolerance)
{
    const gp_XYZ along = (places.back() - places.front()).Normalized();
    return std::all_of(places.begin(), places.end(), [&](const gp_XYZ &place) {
        return ((place - places.front()) ^ along).Modulus() < tolerance;
    });
}

static SpaceCurve cubic(const std::vector<gp_XYZ> &places, bool closed)
{
    const int count = (int)places.size();
    Handle(TColgp_HArray1OfPnt) through = new TColgp_HArray1OfPnt(1, count);
    Handle(TColStd_HArray1OfReal) at = new TColStd_HArray1OfReal(1, count);
    double length = 0.0;
    for (int i = 0; i < count; i++) {
        if (i > 0)
            length += (places[(size_t)i] - places[(size_t)i - 1]).Modulus();
        through->SetValue(i + 1, places[(size_t)i]);
        at->SetValue(i + 1, length);
    }
    GeomAPI_Interpolate interpolation(through, at, false, 1e-12);
    if (closed && count > 4) {
        const gp_Vec along((places[1] - places[(size_t)count - 2]).Normalized());
        interpolation.Load(along, along, false);
    }
    interpolation.Perform();
    if (!interpolation.IsDone())
        throw Failure{CREASE_ERROR_NUMERIC, "an edge has no curve through its points"};
    return {Handle(Geom_Curve)(interpolation.Curve()), 0.0, length};
}

SpaceCurve space_curve(const EdgePoints &edge, const Sheet &a, const Sheet &b)
{
    const auto found = conic(edge, a, b);
    return found ? *found : space_curve(edge);
}

SpaceCurve space_curve(const EdgePoints &edge)
{
    const std::vector<gp_XYZ> places = thinned(edge);
    if (!edge.closed && is_straight(places, STRAIGHT * edge.spacing))
        if (const auto line = line_between(places.front(), places.back()))
            return *line;
    return cubic(places, edge.closed);
}

/* -------------------------------------------------------------------------------- in u, v -- */

static double gap_at(const SpaceCurve &space, const Sheet &sheet, const gp_XY &uv, double parameter)
{
    return (sheet.surface->Value(uv.X(), uv.Y()).XYZ() - space.at(parameter)).Modulus();
}

/* Null unless they run evenly along a line at unit speed. */
static Handle(Geom2d_Curve) line_through(const std::vector<gp_XY> &uv, const SpaceCurve &space)
{
    const gp_XY along = uv.back() - uv.front();
    const double length = along.Modulus(), size = std::max(1.0, length);
    if (std::abs(length - (space.last - space.first)) > 1e-9 * size)
        return nullptr;
    for (size_t i = 0; i < uv.size(); i++)
        if ((uv[i] - uv[0] - along * ((double)i / (double)(uv.size() - 1))).Modulus() > 1e-9 * size)
            return nullptr;
    return new Geom2d_Line(gp_Pnt2d(uv[0] - along.Normalized() * space.first), gp_Dir2d(along));
}

static Handle(Geom2d_Curve)
    cubic_through(const std::vector<gp_XY> &uv, const std::vector<double> &parameters)
{
    const int count = (int)uv.size();
    Handle(TColgp_HArray1OfPnt2d) through = new TColgp_HArray1OfPnt2d(1, count);
    Handle(TColStd_HArray1OfReal) at = new TColStd_HArray1OfReal(1, count);
    for (int i = 0; i < count; i++) {
        through->SetValue(i + 1, uv[(size_t)i]);
        at->SetValue(i + 1, parameters[(size_t)i]);
    }
    Geom2dAPI_Interpolate interpolation(through, at, false, 1e-14);
    interpolation.Perform();
    if (!interpolation.IsDone())
        throw Failure{CREASE_ERROR_NUMERIC, "an edge has no curve on its surface"};
    return Handle(Geom2d_Curve)(interpolation.Curve());
}

FlatCurve flat_curve(
    const SpaceCurve &space, const Sheet &sheet, size_t samples, const gp_XY &near, bool reversed)
{
    std::vector<double> parameters;
    std::vector<gp_XYZ> places;
    for (size_t i = 0; i <= samples; i++) {
        parameters.push_back(
            space.first + (space.last - space.first) * (double)i / (double)samples);
        places.push_back(space.at(parameters.back()));
    }
    std::vector<gp_XY> uv = sheet.along(places);
    const gp_XY anchor = reversed ? uv.back() : uv.front();
    for (int d = 1; d <= 2; d++) {
        if (!sheet.turns(d - 1))
            continue;
        const double by = crease_chart_near(anchor.Coord(d), near.Coord(d)) - anchor.Coord(d);
        for (gp_XY &place : uv)
            place.SetCoord(d, place.Coord(d) + by);
    }
    FlatCurve out = {line_through(uv, space), uv.front(), uv.back(), 0.0};
    if (out.curve.IsNull())
        out.curve = cubic_through(uv, parameters);
    for (size_t i = 0; i <= 2 * samples; i++) {
        const double t =
            i % 2 ? 0.5 * (parameters[i / 2] + parameters[i / 2 + 1]) : parameters[i / 2];
        out.gap = std::max(out.gap, gap_at(space, sheet, out.curve->Value(t).XY(), t));
    }
    return out;
}

} // namespace crease_cad
