/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "cad/rounding.hpp"

#include "cad/closing.hpp"
#include "cad/extended_face.hpp"
#include "cad/naming.hpp"

#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRep_Tool.hxx>
#include <Geom_Curve.hxx>
#include <Standard_Failure.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>

#include <algorithm>
#include <cmath>

namespace crease_cad
{

static constexpr double WIDEST = 3.0;       /* radians that a fillet covers at most */
static constexpr double PARALLEL = 0.02;    /* sine between axis and plane */
static constexpr double NEARLY_FLAT = 0.97; /* cosine between planes that need no fillet */
static constexpr double COARSE = 1e-3;      /* of the diagonal: triangles that tell faces apart */
static constexpr double REACH_RADII = 1.5, REACH_SPACINGS = 3.0; /* from edge to fillet's points */

/* On the side where the axis is, the plane lies one radius from it. */
static bool is_tangent(const Job &job, const Carrier &round, const Carrier &plane)
{
    const gp_Pnt middle = round.frame.Location();
    if (std::fabs(round.frame.Direction().Dot(plane.frame.Direction())) > PARALLEL)
        return false;
    return std::fabs(std::fabs(job.distance(plane, middle)) - round.radius) < job.sigma;
}

/* Direction from the axis to where the plane touches. */
static gp_Dir towards(const Job &job, const Carrier &round, const Carrier &plane)
{
    const gp_Dir normal = plane.frame.Direction();
    return job.distance(plane, round.frame.Location()) > 0.0 ? normal.Reversed() : normal;
}

/* Whether the round's points lie between the lines in which the planes touch it. */
static bool spans(const Job &job, const Carrier &round, const Carrier &a, const Carrier &b)
{
    const gp_Vec middle = gp_Vec(towards(job, round, a)) + gp_Vec(towards(job, round, b));
    const double half = gp_Vec(towards(job, round, a)).Angle(gp_Vec(towards(job, round, b))) / 2.0;
    if (std::cos(2.0 * half) > NEARLY_FLAT || std::cos(2.0 * half) < -NEARLY_FLAT)
        return false;
    size_t within = 0;
    const gp_Vec axis(round.frame.Direction());
    const double slack = (job.spacing + 2.0 * job.sigma) / round.radius;
    for (const gp_Pnt &place : round.points) {
        gp_Vec out(round.frame.Location(), place);
        out -= axis * out.Dot(axis);
        within += out.Magnitude() > 0.0 && middle.Angle(out) < half + slack;
    }
    return within > round.points.size() * 9 / 10;
}

static bool find_planes(const Job &job, const Carrier &round, Fillet &fillet)
{
    std::vector<const Carrier *> tangent;
    for (const Carrier &plane : job.carriers)
        if (plane.type == CREASE_REGION_PLANE && is_tangent(job, round, plane))
            tangent.push_back(&plane);
    for (size_t i = 0; i < tangent.size(); i++)
        for (size_t j = i + 1; j < tangent.size(); j++)
            if (spans(job, round, *tangent[i], *tangent[j])) {
                fillet = {&round, {tangent[i], tangent[j]}};
                return true;
            }
    return false;
}

std::vector<Fillet> find_fillets(const Job &job)
{
    std::vector<Fillet> fillets;
    Fillet fillet = {};
    for (const Carrier &round : job.carriers)
        if (round.type == CREASE_REGION_CYLINDER && !round.points.empty() &&
            cover_of(round).angle < WIDEST && find_planes(job, round, fillet))
            fillets.push_back(fillet);
    return fillets;
}

namespace
{

struct Roll {
    TopoDS_Edge edge;
    double radius;
    size_t fillet;
};

/* The edges of a solid with the carriers of their faces. */
class Edges
{
  public:
    Edges(const Job &job, const TopoDS_Shape &solid);
    std::vector<Roll> to_round(const Job &job, const std::vector<Fillet> &fillets) const;

  private:
    bool lies_between(int edge, const Fillet &fillet) const;

    TopTools_IndexedDataMapOfShapeListOfShape around;
    TopTools_IndexedMapOfShape faces;
    std::vector<uint32_t> carriers;
};

Edges::Edges(const Job &job, const TopoDS_Shape &solid)
{
    TopExp::MapShapesAndAncestors(solid, TopAbs_EDGE, TopAbs_FACE, around);
    TopExp::MapShapes(solid, TopAbs_FACE, faces);
    carriers =
        carriers_of_faces(job, tessellate(solid, COARSE * job.diagonal), (size_t)faces.Extent());
}

bool Edges::lies_between(int edge, const Fillet &fillet) const
{
    if (around(edge).Extent() != 2)
        return false;
    const uint32_t a = carriers[(size_t)faces.FindIndex(around(edge).First()) - 1];
    const uint32_t b = carriers[(size_t)faces.FindIndex(around(edge).Last()) - 1];
    const uint32_t p = fillet.planes[0]->number, q = fillet.planes[1]->number;
    return (a == p && b == q) || (a == q && b == p);
}

/* Of edges between the same planes those beside the fillet's points. */
static bool is_near(const Job &job, const TopoDS_Edge &edge, const Carrier &round)
{
    double first = 0.0, last = 0.0;
    const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
    if (curve.IsNull())
        return false;
    const gp_Pnt middle = curve->Value((first + last) / 2.0);
    double nearest = INFINITY;
    for (const gp_Pnt &place : round.points)
        nearest = std::min(nearest, place.Distance(middle));
    return nearest < REACH_RADII * round.radius + REACH_SPACINGS * job.spacing;
}

std::vector<Roll> Edges::to_round(const Job &job, const std::vector<Fillet> &fillets) const
{
    std::vector<Roll> rolls;
    for (int i = 1; i <= around.Extent(); i++) {
        const TopoDS_Edge edge = TopoDS::Edge(around.FindKey(i));
        for (size_t f = 0; f < fillets.size(); f++)
            if (lies_between(i, fillets[f]) && is_near(job, edge, *fillets[f].round)) {
                rolls.push_back({edge, fillets[f].round->radius, f});
                break;
            }
    }
    return rolls;
}

/* Null when that cannot be done. */
TopoDS_Shape roll(const TopoDS_Shape &solid, const std::vector<Roll> &rolls)
{
    try {
        BRepFilletAPI_MakeFillet maker(solid);
        for (const Roll &one : rolls)
            maker.Add(one.radius, one.edge);
        maker.Build();
        if (maker.IsDone() && is_sound(maker.Shape()))
            return maker.Shape();
    } catch (const Standard_Failure &) {
        return TopoDS_Shape();
    }
    return TopoDS_Shape();
}

size_t not_made(const std::vector<Roll> &rolls, size_t fillets)
{
    std::vector<bool> made(fillets, false);
    for (const Roll &one : rolls)
        made[one.fillet] = true;
    return (size_t)std::count(made.begin(), made.end(), false);
}

} // namespace

/* All at once, because fillets that meet in a corner depend on each other; where that fails, one
 * more at a time. */
TopoDS_Shape rounded(
    const Job &job, const TopoDS_Shape &solid, const std::vector<Fillet> &fillets, size_t *left)
{
    *left = 0;
    if (fillets.empty())
        return solid;
    const std::vector<Roll> wanted = Edges(job, solid).to_round(job, fillets);
    *left = not_made(wanted, fillets.size());
    if (wanted.empty())
        return solid;
    if (const TopoDS_Shape all = roll(solid, wanted); !all.IsNull())
        return all;
    std::vector<Roll> good;
    TopoDS_Shape result = solid;
    for (const Roll &one : wanted) {
        good.push_back(one);
        if (const TopoDS_Shape next = roll(solid, good); !next.IsNull())
            result = next;
        else
            good.pop_back();
    }
    *left = not_made(good, fillets.size());
    return result;
}

} // namespace crease_cad
