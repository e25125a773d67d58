/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "cad/turn.hpp"

#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_Curve.hxx>
#include <TopExp_Explorer.hxx>

#include <cmath>

namespace crease_cad
{

static constexpr double SHARP_ANGLE = 10.0; /* degrees */
static constexpr int SAMPLES = 16;

/* The outward normal of the face at the edge's parameter, where it has one. */
static std::optional<gp_Dir> normal_at(
    const TopoDS_Edge &edge, const TopoDS_Face &face, double part)
{
    double first = 0, last = 0;
    const Handle(Geom2d_Curve) line = BRep_Tool::CurveOnSurface(edge, face, first, last);
    if (line.IsNull())
        return std::nullopt;
    const gp_Pnt2d uv = line->Value(first + (last - first) * part);
    gp_Pnt point;
    gp_Vec along_u, along_v;
    BRepAdaptor_Surface(face, false).D1(uv.X(), uv.Y(), point, along_u, along_v);
    const gp_Vec normal = along_u.Crossed(along_v);
    if (normal.Magnitude() <= 1e-9 * along_u.Magnitude() * along_v.Magnitude())
        return std::nullopt;
    return gp_Dir(face.Orientation() == TopAbs_REVERSED ? normal.Reversed() : normal);
}

/* The direction in which a walk around the face, the face on the left, goes along the edge. */
static gp_Vec walk_along(const TopoDS_Edge &edge, const TopoDS_Face &face, double part)
{
    const BRepAdaptor_Curve curve(edge);
    const double first = curve.FirstParameter(), last = curve.LastParameter();
    gp_Pnt point;
    gp_Vec along;
    curve.D1(first + (last - first) * part, point, along);
    for (TopExp_Explorer it(face, TopAbs_EDGE); it.More(); it.Next())
        if (it.Current().IsSame(edge))
            return it.Current().Orientation() == TopAbs_REVERSED ? along.Reversed() : along;
    return along;
}

std::optional<Turn> turn_at(
    const TopoDS_Edge &edge, const TopoDS_Face &one, const TopoDS_Face &other)
{
    double sum = 0, outwards = 0;
    int samples = 0;
    for (int i = 0; i <= SAMPLES; i++) {
        const double part = (double)i / SAMPLES;
        const std::optional<gp_Dir> a = normal_at(edge, one, part),
                                    b = normal_at(edge, other, part);
        if (!a || !b)
            continue;
        sum += a->Angle(*b) * 180.0 / M_PI;
        outwards += gp_Vec(*a).Crossed(gp_Vec(*b)).Dot(walk_along(edge, one, part));
        samples++;
    }
    if (samples == 0)
        return std::nullopt;
    return Turn{sum / samples, outwards > 0.0};
}

bool is_sharp(const std::optional<Turn> &turn)
{
    return turn && turn->angle > SHARP_ANGLE;
}

} // namespace crease_cad
