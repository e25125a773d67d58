/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "cad/sheet.hpp"

#include "cad/height_field.hpp"

#include <Geom_BSplineSurface.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Plane.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_ToroidalSurface.hxx>
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

/* A bicubic surface through the heights. The last row of a round one is the first again. */
void Sheet::interpolate(const crease_chart &from, double factor)
{
    const int side = (int)from.side, rows = from.round ? side - 1 : side;
    TColStd_Array2OfReal heights(1, rows, 1, side);
    for (int d = from.round ? 1 : 0; d < 2 && !from.ball; d++) {
        chart.low[d] *= factor;
        chart.high[d] *= factor;
    }
    for (int i = 0; i < rows; i++)
        for (int k = 0; k < side; k++)
            heights(i + 1, k + 1) = factor * from.heights[i * side + k];
    const Handle(Geom_BSplineSurface) result = from.round
        ? tube_through(heights, chart.low[1], chart.high[1])
        : from.ball ? ball_through(heights, chart.low, chart.high)
                    : surface_through(heights, chart.low, chart.high);
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
