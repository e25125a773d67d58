/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The curves of an edge: in space, and on each of its surfaces at the same parameter. */
#ifndef CREASE_CAD_SPACE_CURVE_HPP
#define CREASE_CAD_SPACE_CURVE_HPP

#include "cad/sheet.hpp"

#include <Geom2d_Curve.hxx>
#include <Geom_Curve.hxx>

namespace crease_cad
{

struct SpaceCurve {
    Handle(Geom_Curve) curve;
    double first, last;

    gp_XYZ at(double parameter) const
    {
        return curve->Value(parameter).XYZ();
    }
};

/* The points of an edge, in order; when closed, the last is the first. */
struct EdgePoints {
    std::vector<gp_XYZ> places;
    bool closed, smooth;
    double spacing;
};

/* A line, circle or ellipse where two surfaces meet in one, else a cubic through the points. */
SpaceCurve space_curve(const EdgePoints &edge, const Sheet &a, const Sheet &b);
/* A line or a cubic through the points. */
SpaceCurve space_curve(const EdgePoints &edge);

/* A curve in u and v. */
struct FlatCurve {
    Handle(Geom2d_Curve) curve;
    gp_XY begin, end; /* where it is at the first and last parameter */
    double gap;       /* how far it is from the curve in space */
};

/* whole turns are added so that it begins (or ends, when reversed) near a place. */
FlatCurve flat_curve(
    const SpaceCurve &space, const Sheet &sheet, size_t samples, const gp_XY &near, bool reversed);

} // namespace crease_cad

#endif
