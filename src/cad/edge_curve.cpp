/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "cad/edge_curve.hpp"

#include "cad/kernel.hpp"

#include <BRepAdaptor_Curve.hxx>
#include <GeomAPI_Interpolate.hxx>
#include <Geom_BSplineCurve.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_HArray1OfPnt.hxx>

#include <algorithm>

namespace crease_cad
{

static constexpr int LINE_POINTS = 4;
static constexpr int CONIC_POINTS = 65; /* a full circle is met to 1e-7 of its radius */
static constexpr int POINTS_PER_SPAN = 4;
static constexpr int MOST_POINTS = 2000;

static int point_count(const BRepAdaptor_Curve &curve)
{
    if (curve.GetType() == GeomAbs_Line)
        return LINE_POINTS;
    if (curve.GetType() != GeomAbs_BSplineCurve)
        return CONIC_POINTS;
    return std::clamp((curve.NbKnots() - 1) * POINTS_PER_SPAN + 1, CONIC_POINTS, MOST_POINTS);
}

size_t add_cubic_curve(
    const TopoDS_Edge &edge, std::vector<double> &poles, std::vector<double> &knots)
{
    const BRepAdaptor_Curve curve(edge);
    const int count = point_count(curve);
    const Handle(TColgp_HArray1OfPnt) points = new TColgp_HArray1OfPnt(1, count);
    const double first = curve.FirstParameter(), last = curve.LastParameter();
    for (int i = 0; i < count; i++)
        points->SetValue(i + 1, curve.Value(first + (last - first) * i / (count - 1)));
    GeomAPI_Interpolate fit(points, false, 0.0);
    fit.Perform();
    if (!fit.IsDone())
        throw Failure{CREASE_ERROR_NUMERIC, "an edge has no curve"};
    const Handle(Geom_BSplineCurve) &cubic = fit.Curve();
    for (int i = 1; i <= cubic->NbPoles(); i++)
        for (int c = 1; c <= 3; c++)
            poles.push_back(cubic->Pole(i).Coord(c));
    for (int i = 1; i <= cubic->NbKnots(); i++)
        knots.insert(knots.end(), (size_t)cubic->Multiplicity(i), cubic->Knot(i));
    return (size_t)cubic->NbPoles();
}

} // namespace crease_cad
