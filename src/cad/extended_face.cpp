/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "cad/extended_face.hpp"

#include "cad/height_field.hpp"
#include "topology/chart.h"

#include <BRepBuilderAPI_MakeFace.hxx>
#include <ElSLib.hxx>
#include <GeomAPI_PointsToBSplineSurface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Plane.hxx>
#include <Geom_SphericalSurface.hxx>
#include <Geom_ToroidalSurface.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_Array2OfReal.hxx>

#include <algorithm>
#include <cmath>

namespace crease_cad
{

static constexpr double TOLERANCE = 1e-7;
static constexpr int TURNS = 45;              /* trial directions of a rectangle in 90 degrees */
static constexpr double CLOSED_GAP = 6.0;     /* spacings without points that close a ring */
static constexpr double CLOSED_COVER = 5.0;   /* radians with points that do so */
static constexpr double MARGINS_IN_GAP = 2.2; /* a gap that the margins would fill closes, too */
static constexpr double LEAST_OPENING = 0.05; /* radians that an open sector leaves out */
static constexpr double CLEAR_SIDE = 0.2;     /* mean normal of a cap: what makes it a cap */
static constexpr int LEAST_ROWS = 48, ROWS_PER_SPAN = 3; /* of a free form around its axis */
static constexpr double WIDEST_CAP = 2.6; /* radians from its middle; wider: all of it */

/* The extent of points along two directions. */
struct Extent {
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};

    void add(double x, double y)
    {
        const double at[2] = {x, y};
        for (int d = 0; d < 2; d++) {
            low[d] = std::min(low[d], at[d]);
            high[d] = std::max(high[d], at[d]);
        }
    }
    double area() const
    {
        return (high[0] - low[0]) * (high[1] - low[1]);
    }
    Extent grown(double margin) const
    {
        Extent out = *this;
        for (int d = 0; d < 2; d++) {
            out.low[d] -= margin;
            out.high[d] += margin;
        }
        return out;
    }
};

static gp_XYZ local(const gp_Ax3 &frame, const gp_Pnt &place)
{
    const gp_Vec d(frame.Location(), place);
    return gp_XYZ(d.Dot(frame.XDirection()), d.Dot(frame.YDirection()), d.Dot(frame.Direction()));
}

static gp_Ax3 turned(const gp_Ax3 &frame, double angle)
{
    return frame.Rotated(gp_Ax1(frame.Location(), frame.Direction()), angle);
}

static TopoDS_Face face_on(const Handle(Geom_Surface) & surface, const Extent &extent)
{
    return BRepBuilderAPI_MakeFace(
        surface, extent.low[0], extent.high[0], extent.low[1], extent.high[1], TOLERANCE);
}

static Extent extent_in(const Carrier &carrier, const gp_Ax3 &frame)
{
    Extent extent;
    for (const gp_Pnt &place : carrier.points) {
        const gp_XYZ at = local(frame, place);
        extent.add(at.X(), at.Y());
    }
    return extent;
}

/* The smallest rectangle, by trial. */
static ExtendedFace extend_plane(const Carrier &carrier, double margin)
{
    gp_Ax3 frame = carrier.frame;
    Extent best = extent_in(carrier, frame);
    for (int k = 1; k < TURNS; k++) {
        const gp_Ax3 trial = turned(carrier.frame, k * M_PI / 2.0 / TURNS);
        const Extent extent = extent_in(carrier, trial);
        if (extent.area() < best.area() * 0.999) {
            best = extent;
            frame = trial;
        }
    }
    ExtendedFace out = {};
    out.surface = new Geom_Plane(frame);
    out.face = face_on(out.surface, best.grown(margin));
    return out;
}

Cover cover_of(const Carrier &carrier)
{
    std::vector<double> angles;
    for (const gp_Pnt &place : carrier.points) {
        const gp_XYZ at = local(carrier.frame, place);
        angles.push_back(std::atan2(at.Y(), at.X()));
    }
    std::sort(angles.begin(), angles.end());
    double gap = angles.front() + 2.0 * M_PI - angles.back(), middle = angles.back() + gap / 2.0;
    for (size_t i = 1; i < angles.size(); i++)
        if (angles[i] - angles[i - 1] > gap) {
            gap = angles[i] - angles[i - 1];
            middle = angles[i - 1] + gap / 2.0;
        }
    return {2.0 * M_PI - gap, middle};
}

/* The cone's own parameter runs along its side; it ends at its tip. */
static ExtendedFace extend_cone(const Carrier &carrier, const gp_Ax3 &frame, Extent extent)
{
    const double tip = -carrier.radius / carrier.shape, angle = std::atan(carrier.shape);
    if (carrier.shape > 0.0)
        extent.low[1] = std::max(extent.low[1], tip);
    else
        extent.high[1] = std::min(extent.high[1], tip);
    const double middle = (extent.low[1] + extent.high[1]) / 2.0;
    ExtendedFace out = {};
    out.surface = new Geom_ConicalSurface(frame.Translated(gp_Vec(frame.Direction()) * middle),
        angle, carrier.radius + carrier.shape * middle);
    for (double *const z : {&extent.low[1], &extent.high[1]})
        *z = (*z - middle) / std::cos(angle);
    out.face = face_on(out.surface, extent);
    return out;
}

/* How much of a full turn a face about an axis takes, of points at about a radius. */
static double half_of_turn(const Job &job, const Cover &cover, double radius, double margin)
{
    const double gap = (2.0 * M_PI - cover.angle) * radius;
    const bool closed = cover.angle > CLOSED_COVER ||
        gap < std::max(CLOSED_GAP * job.spacing, MARGINS_IN_GAP * margin);
    return closed ? M_PI : std::min(cover.angle / 2.0 + margin / radius, M_PI - LEAST_OPENING);
}

/* A full turn, its seam where there are fewest points, or a sector. */
static Extent extent_around(
    const Job &job, const Carrier &carrier, const Cover &cover, double radius, double margin)
{
    const double half = half_of_turn(job, cover, radius, margin);
    Extent extent;
    for (const gp_Pnt &place : carrier.points)
        extent.add(M_PI, local(carrier.frame, place).Z());
    extent = extent.grown(margin);
    extent.low[0] = M_PI - half;
    extent.high[0] = M_PI + half;
    return extent;
}

static ExtendedFace extend_round(const Job &job, const Carrier &carrier, double margin)
{
    const Cover cover = cover_of(carrier);
    const Extent extent = extent_around(job, carrier, cover, carrier.radius, margin);
    const gp_Ax3 frame = turned(carrier.frame, cover.middle_of_gap);
    if (carrier.type == CREASE_REGION_CONE)
        return extend_cone(carrier, frame, extent);
    ExtendedFace out = {};
    out.surface = new Geom_CylindricalSurface(frame, carrier.radius);
    out.face = face_on(out.surface, extent);
    return out;
}

static double mean_distance(const Carrier &carrier)
{
    double sum = 0.0;
    for (const gp_Pnt &place : carrier.points) {
        const gp_XYZ at = local(carrier.frame, place);
        sum += std::hypot(at.X(), at.Y());
    }
    return sum / (double)carrier.points.size();
}

static ExtendedFace extend_tube(const Job &job, const Carrier &carrier, double margin)
{
    const Cover cover = cover_of(carrier);
    const Extent extent = extent_around(job, carrier, cover, mean_distance(carrier), margin);
    const int rows = std::max(LEAST_ROWS, ROWS_PER_SPAN * carrier.spans);
    const int columns = 2 * carrier.spans + 6;
    TColStd_Array2OfReal distances(1, rows, 1, columns);
    for (int i = 0; i < rows; i++)
        for (int k = 0; k < columns; k++)
            distances(i + 1, k + 1) =
                job.height(carrier, cover.middle_of_gap + 2.0 * M_PI * i / rows,
                    extent.low[1] + (extent.high[1] - extent.low[1]) * k / (columns - 1));
    ExtendedFace out = {};
    out.frame = turned(carrier.frame, cover.middle_of_gap);
    out.round = true;
    const Handle(Geom_BSplineSurface) tube = tube_through(distances, extent.low[1], extent.high[1]);
    gp_Trsf move;
    move.SetTransformation(out.frame, gp_Ax3());
    tube->Transform(move);
    out.surface = tube;
    out.face = extent.high[0] < 2.0 * M_PI ? face_on(tube, extent)
                                           : BRepBuilderAPI_MakeFace(tube, TOLERANCE).Face();
    return out;
}

static ExtendedFace extend_ball(const Job &job, const Carrier &carrier, double margin)
{
    Extent extent;
    double away = 0.0;
    for (const gp_Pnt &place : carrier.points) {
        const gp_XYZ at = local(carrier.frame, place);
        const double there[3] = {at.X(), at.Y(), at.Z()};
        double uv[2];
        crease_chart_ball_at(there, uv);
        extent.add(uv[0], uv[1]);
        away += at.Modulus() / (double)carrier.points.size();
    }
    extent = extent.grown(margin / away);
    const int count = std::max(LEAST_ROWS, ROWS_PER_SPAN * carrier.spans);
    TColStd_Array2OfReal distances(1, count, 1, count);
    for (int i = 0; i < count; i++)
        for (int k = 0; k < count; k++)
            distances(i + 1, k + 1) = job.height(carrier,
                extent.low[0] + (extent.high[0] - extent.low[0]) * i / (count - 1),
                extent.low[1] + (extent.high[1] - extent.low[1]) * k / (count - 1));
    ExtendedFace out = {};
    out.frame = carrier.frame;
    out.ball = true;
    const Handle(Geom_BSplineSurface) ball = ball_through(distances, extent.low, extent.high);
    gp_Trsf move;
    move.SetTransformation(out.frame, gp_Ax3());
    ball->Transform(move);
    out.surface = ball;
    out.face = BRepBuilderAPI_MakeFace(ball, TOLERANCE);
    return out;
}

/* A cap around the mean direction of the points, or all of the sphere. */
static ExtendedFace extend_sphere(const Carrier &carrier, double margin)
{
    gp_Vec sum;
    for (const gp_Pnt &place : carrier.points)
        sum += gp_Vec(carrier.frame.Location(), place).Normalized();
    gp_Ax3 frame = carrier.frame;
    double lowest = -M_PI / 2.0;
    if (sum.Magnitude() > CLEAR_SIDE * (double)carrier.points.size()) {
        double widest = 0.0;
        for (const gp_Pnt &place : carrier.points)
            widest = std::max(widest, sum.Angle(gp_Vec(carrier.frame.Location(), place)));
        widest += margin / carrier.radius;
        frame = gp_Ax3(carrier.frame.Location(), gp_Dir(sum));
        if (widest < WIDEST_CAP)
            lowest = M_PI / 2.0 - widest;
    }
    ExtendedFace out = {};
    out.surface = new Geom_SphericalSurface(frame, carrier.radius);
    out.face = BRepBuilderAPI_MakeFace(out.surface, 0.0, 2.0 * M_PI, lowest, M_PI / 2.0, TOLERANCE);
    return out;
}

static ExtendedFace extend_torus(const Carrier &carrier)
{
    ExtendedFace out = {};
    out.surface = new Geom_ToroidalSurface(carrier.frame, carrier.radius, carrier.shape);
    out.face = BRepBuilderAPI_MakeFace(out.surface, TOLERANCE);
    return out;
}

/* The heights over a grid, interpolated so that the parameters are x and y up to scale. */
static ExtendedFace extend_freeform(const Job &job, const Carrier &carrier, double margin)
{
    const Extent extent = extent_in(carrier, carrier.frame).grown(margin);
    const int count = 2 * carrier.spans + 6;
    double step[2];
    for (int d = 0; d < 2; d++)
        step[d] = (extent.high[d] - extent.low[d]) / (count - 1);
    TColStd_Array2OfReal heights(1, count, 1, count);
    for (int i = 0; i < count; i++)
        for (int j = 0; j < count; j++)
            heights(i + 1, j + 1) =
                job.height(carrier, extent.low[0] + step[0] * i, extent.low[1] + step[1] * j);
    GeomAPI_PointsToBSplineSurface fit;
    fit.Interpolate(heights, extent.low[0], step[0], extent.low[1], step[1]);
    gp_Trsf move;
    move.SetTransformation(carrier.frame, gp_Ax3());
    ExtendedFace out = {};
    out.surface = Handle(Geom_Surface)::DownCast(fit.Surface()->Transformed(move));
    out.frame = carrier.frame;
    double bounds[4];
    out.surface->Bounds(bounds[0], bounds[1], bounds[2], bounds[3]);
    for (int d = 0; d < 2; d++) {
        out.per_length[d] = (bounds[2 * d + 1] - bounds[2 * d]) / (extent.high[d] - extent.low[d]);
        out.origin[d] = bounds[2 * d] - out.per_length[d] * extent.low[d];
    }
    out.face = BRepBuilderAPI_MakeFace(out.surface, TOLERANCE);
    return out;
}

ExtendedFace extend(const Job &job, const Carrier &carrier, double margin)
{
    if (carrier.points.empty())
        return {};
    switch (carrier.type) {
    case CREASE_REGION_PLANE:
        return extend_plane(carrier, margin);
    case CREASE_REGION_CYLINDER:
    case CREASE_REGION_CONE:
        return extend_round(job, carrier, margin);
    case CREASE_REGION_SPHERE:
        return extend_sphere(carrier, margin);
    case CREASE_REGION_TORUS:
        return extend_torus(carrier);
    default:
        if (carrier.round)
            return extend_tube(job, carrier, margin);
        if (carrier.ball)
            return extend_ball(job, carrier, margin);
        return extend_freeform(job, carrier, margin);
    }
}

gp_Pnt2d foot(const ExtendedFace &extended, const gp_Pnt &place)
{
    double u = 0.0, v = 0.0;
    const Handle(Geom_Surface) &surface = extended.surface;
    if (const auto plane = Handle(Geom_Plane)::DownCast(surface); !plane.IsNull()) {
        ElSLib::Parameters(plane->Pln(), place, u, v);
    } else if (const auto rod = Handle(Geom_CylindricalSurface)::DownCast(surface); !rod.IsNull()) {
        ElSLib::Parameters(rod->Cylinder(), place, u, v);
    } else if (const auto cone = Handle(Geom_ConicalSurface)::DownCast(surface); !cone.IsNull()) {
        ElSLib::Parameters(cone->Cone(), place, u, v);
    } else if (const auto ball = Handle(Geom_SphericalSurface)::DownCast(surface); !ball.IsNull()) {
        ElSLib::Parameters(ball->Sphere(), place, u, v);
    } else if (const auto ring = Handle(Geom_ToroidalSurface)::DownCast(surface); !ring.IsNull()) {
        ElSLib::Parameters(ring->Torus(), place, u, v);
    } else if (extended.ball) {
        const gp_XYZ at = local(extended.frame, place);
        const double there[3] = {at.X(), at.Y(), at.Z()};
        double uv[2];
        crease_chart_ball_at(there, uv);
        u = uv[0];
        v = uv[1];
    } else if (extended.round) {
        const gp_XYZ at = local(extended.frame, place);
        u = std::atan2(at.Y(), at.X());
        u = u < 0.0 ? u + 2.0 * M_PI : u;
        v = at.Z();
    } else {
        const gp_XYZ at = local(extended.frame, place);
        u = extended.origin[0] + extended.per_length[0] * at.X();
        v = extended.origin[1] + extended.per_length[1] * at.Y();
    }
    return gp_Pnt2d(u, v);
}

} // namespace crease_cad
