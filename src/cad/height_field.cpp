/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What is not over a plane is interpolated coordinate by coordinate. Around an axis x and y are
 * interpolated over the same grid as if they were heights, some rows
 * more than a turn: what the ends of the grid do to the interpolant fades by a factor of almost 4
 * from row to row. */
#include "cad/height_field.hpp"

#include "cad/kernel.hpp"
#include "topology/chart.h"

#include <GeomAPI_PointsToBSplineSurface.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>

#include <cmath>

namespace crease_cad
{

static constexpr int EXTRA = 12; /* rows before and after the turn */

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

Handle(Geom_BSplineSurface)
    surface_through(const TColStd_Array2OfReal &heights, const double low[2], const double high[2])
{
    GeomAPI_PointsToBSplineSurface spline;
    spline.Interpolate(heights, low[0], (high[0] - low[0]) / (heights.ColLength() - 1), low[1],
        (high[1] - low[1]) / (heights.RowLength() - 1));
    if (!spline.IsDone())
        throw Failure{CREASE_ERROR_NUMERIC, "a free form has no B-spline through its heights"};
    const Handle(Geom_BSplineSurface) result = spline.Surface();
    for (int d = 0; d < 2; d++)
        set_range(result, d, low[d], high[d]);
    return result;
}

/* x, or y, of the tube as heights over angle and z. */
static Handle(Geom_BSplineSurface)
    coordinate_of(const TColStd_Array2OfReal &distances, int coordinate, double low, double high)
{
    const int rows = distances.ColLength(), columns = distances.RowLength();
    const double step = TURN / rows;
    TColStd_Array2OfReal heights(1, rows + 2 * EXTRA + 1, 1, columns);
    for (int i = heights.LowerRow(); i <= heights.UpperRow(); i++) {
        const int row = (i - 1 - EXTRA + rows) % rows;
        const double share = coordinate ? std::sin(row * step) : std::cos(row * step);
        for (int k = 1; k <= columns; k++)
            heights(i, k) = share * distances(row + 1, k);
    }
    const double from[2] = {-EXTRA * step, low}, to[2] = {TURN + EXTRA * step, high};
    return surface_through(heights, from, to);
}

Handle(Geom_BSplineSurface)
    tube_through(const TColStd_Array2OfReal &distances, double low, double high)
{
    const Handle(Geom_BSplineSurface) out = coordinate_of(distances, 0, low, high);
    const Handle(Geom_BSplineSurface) other = coordinate_of(distances, 1, low, high);
    for (int i = 1; i <= out->NbUPoles(); i++)
        for (int k = 1; k <= out->NbVPoles(); k++) {
            const gp_Pnt x = out->Pole(i, k), y = other->Pole(i, k);
            out->SetPole(i, k, gp_Pnt(x.Z(), y.Z(), x.Y()));
        }
    out->Segment(0.0, TURN, low, high);
    for (int k = 1; k <= out->NbVPoles(); k++)
        out->SetPole(out->NbUPoles(), k, out->Pole(1, k));
    return out;
}

Handle(Geom_BSplineSurface)
    ball_through(const TColStd_Array2OfReal &distances, const double low[2], const double high[2])
{
    const int rows = distances.ColLength(), columns = distances.RowLength();
    Handle(Geom_BSplineSurface) of[3];
    for (int c = 0; c < 3; c++) {
        TColStd_Array2OfReal heights(1, rows, 1, columns);
        for (int i = 0; i < rows; i++)
            for (int k = 0; k < columns; k++) {
                const double at[2] = {low[0] + (high[0] - low[0]) * i / (rows - 1),
                    low[1] + (high[1] - low[1]) * k / (columns - 1)};
                double direction[3];
                crease_chart_ball_direction(at, direction);
                heights(i + 1, k + 1) = direction[c] * distances(i + 1, k + 1);
            }
        of[c] = surface_through(heights, low, high);
    }
    for (int i = 1; i <= of[0]->NbUPoles(); i++)
        for (int k = 1; k <= of[0]->NbVPoles(); k++)
            of[0]->SetPole(
                i, k, gp_Pnt(of[0]->Pole(i, k).Z(), of[1]->Pole(i, k).Z(), of[2]->Pole(i, k).Z()));
    return of[0];
}

} // namespace crease_cad
