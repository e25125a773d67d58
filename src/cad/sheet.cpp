/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "cad/sheet.hpp"

#include "cad/kernel.hpp"

#include <GeomAPI_PointsToBSplineSurface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Plane.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <gp_Trsf.hxx>

#include <cmath>

namespace crease_cad
{

Sheet::Sheet(const crease_chart &from, const Scaling &scaling) : chart(from)
{
    const gp_XYZ centre = scaling(from.centre);
    for (int c = 0; c < 3; c++)
        chart.centre[c] = centre.Coord(c + 1);
    chart.radius *= scaling.factor;
    if (from.type == CREASE_REGION_TORUS)
        chart.shape *= scaling.factor;
    chart.heights = nullptr;
    switch (from.type) {
    case CREASE_REGION_PLANE:
        surface = new Geom_Plane(frame());
        break;
    case CREASE_REGION_SPHERE:
        surface = new Geom_SphericalSurface(frame(), chart.radius);
        break;
    case CREASE_REGION_CYLINDER:
        surface = new Geom_CylindricalSurface(frame(), chart.radius);
        break;
    case CREASE_REGION_CONE:
        surface = new Geom_ConicalSurface(frame(), half_angle(), chart.radius);
        break;
    case CREASE_REGION_TORUS:
        surface = new Geom_ToroidalSurface(frame(), chart.radius, chart.shape);
        break;
    case CREASE_REGION_FREEFORM:
        interpolate(from, scaling.factor);
        break;
    }
}

gp_Ax3 Sheet::frame() const
{
    const double *const a = chart.axes;
    return gp_Ax3(gp_Pnt(chart.centre[0], chart.centre[1], chart.centre[2]),
        gp_Dir(a[6], a[7], a[8]), gp_Dir(a[0], a[1], a[2]));
}

double Sheet::half_angle() const
{
    return std::atan(chart.shape);
}

/* Lets the knots of one direction run from low to high. */
static void set_range(
    const Handle(Geom_BSplineSurface) & spline, int direction, double low, double high)
{
    TColStd_Array1OfReal knots(1, direction ? spline->NbVKnots() : spline->NbUKnots());
    direction ? spline->VKnots(knots) : spline->UKnots(knots);
    const double first = knots.First(), length = knots.Last() - first;
    for (int i = knots.Lower(); i <= knots.Upper(); i++)
        knots(i) = low + (knots(i) - first) / length * (high - low);
    direction ? spline->SetVKnots(knots) : spline->SetUKnots(knots);
}

/* A bicubic surface through the heights. */
void Sheet::interpolate(const crease_chart &from, double factor)
{
    const int side = (int)from.side;
    TColStd_Array2OfReal heights(1, side, 1, side);
    double step[2];
    for (int d = 0; d < 2; d++) {
        chart.low[d] *= factor;
        chart.high[d] *= factor;
        step[d] = (chart.high[d] - chart.low[d]) / (side - 1);
    }
    for (int i = 0; i < side; i++)
        for (int k = 0; k < side; k++)
            heights(i + 1, k + 1) = factor * from.heights[i * side + k];
    GeomAPI_PointsToBSplineSurface spline;
    spline.Interpolate(heights, chart.low[0], step[0], chart.low[1], step[1]);
    if (!spline.IsDone())
        throw Failure{CREASE_ERROR_NUMERIC, "a free form has no B-spline through its heights"};
    const Handle(Geom_BSplineSurface) result = spline.Surface();
    for (int d = 0; d < 2; d++)
        set_range(result, d, chart.low[d], chart.high[d]);
    gp_Trsf to_place;
    to_place.SetTransformation(frame(), gp_Ax3(gp::XOY()));
    result->Transform(to_place);
    surface = result;
}

gp_XY Sheet::at(const gp_XYZ &place) const
{
    const double from[3] = {place.X(), place.Y(), place.Z()};
    double uv[2];
    crease_chart_at(&chart, from, uv);
    return gp_XY(uv[0], uv[1]);
}

std::vector<gp_XY> Sheet::along(const std::vector<gp_XYZ> &places) const
{
    std::vector<gp_XY> out;
    for (const gp_XYZ &place : places) {
        gp_XY uv = at(place);
        for (int d = 0; d < 2 && !out.empty(); d++)
            if (turns(d))
                uv.SetCoord(d + 1, crease_chart_near(uv.Coord(d + 1), out.back().Coord(d + 1)));
        out.push_back(uv);
    }
    return out;
}

} // namespace crease_cad
