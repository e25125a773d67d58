/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What a CAD program would find in a file. */
#include "cad/apart.hpp"
#include "cad/kernel.hpp"
#include "cad/read.hpp"
#include "cad/turn.hpp"

#include <BRepAdaptor_Surface.hxx>
#include <BRepBndLib.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <ShapeAnalysis_ShapeTolerance.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>

#include <cmath>
#include <cstdio>

namespace crease_cad
{

static constexpr double INTEGRAL_ERROR = 1e-9; /* relative, of areas and volumes */

static TopTools_IndexedMapOfShape parts_of(const TopoDS_Shape &shape, TopAbs_ShapeEnum kind)
{
    TopTools_IndexedMapOfShape parts;
    TopExp::MapShapes(shape, kind, parts);
    return parts;
}

static void count_edges(const TopoDS_Shape &shape, crease_cad_info &info)
{
    TopTools_IndexedDataMapOfShapeListOfShape edges;
    TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, edges);
    for (int i = 1; i <= edges.Extent(); i++) {
        const TopoDS_Edge edge = TopoDS::Edge(edges.FindKey(i));
        if (BRep_Tool::Degenerated(edge))
            continue;
        info.edges++;
        const TopTools_ListOfShape &faces = edges(i);
        if (faces.IsEmpty()) {
            info.wire_edges++;
            continue;
        }
        const TopoDS_Face first = TopoDS::Face(faces.First()), last = TopoDS::Face(faces.Last());
        if (faces.Extent() == 1 && !BRep_Tool::IsClosed(edge, first))
            info.free_edges++;
        else if (faces.Extent() == 2 && !first.IsSame(last) && is_sharp(turn_at(edge, first, last)))
            info.sharp_edges++;
    }
}

static void count_faces(const TopoDS_Shape &shape, crease_cad_info &info)
{
    const TopTools_IndexedMapOfShape faces = parts_of(shape, TopAbs_FACE);
    info.faces = (size_t)faces.Extent();
    for (int i = 1; i <= faces.Extent(); i++) {
        const GeomAbs_SurfaceType type =
            BRepAdaptor_Surface(TopoDS::Face(faces(i)), false).GetType();
        if (type == GeomAbs_BSplineSurface)
            info.bspline_faces++;
        else if (type == GeomAbs_Plane)
            info.plane_faces++;
        else
            info.other_faces++;
    }
}

static void count_shells(const TopoDS_Shape &shape, crease_cad_info &info)
{
    const TopTools_IndexedMapOfShape shells = parts_of(shape, TopAbs_SHELL);
    info.shells = (size_t)shells.Extent();
    for (int i = 1; i <= shells.Extent(); i++)
        if (BRep_Tool::IsClosed(shells(i)))
            info.closed_shells++;
}

static gp_Pnt find_bounds(const TopoDS_Shape &shape, double unit, crease_cad_info &info)
{
    Bnd_Box box;
    BRepBndLib::AddOptimal(shape, box, false, false);
    if (box.IsVoid())
        return gp_Pnt();
    box.SetGap(0.0);
    double *const low = info.lowest, *const high = info.highest;
    box.Get(low[0], low[1], low[2], high[0], high[1], high[2]);
    const gp_Pnt corner(low[0], low[1], low[2]);
    for (int c = 0; c < 3; c++) {
        low[c] /= unit;
        high[c] /= unit;
    }
    return corner;
}

/* Volumes are summed from a corner of the bounds: far from the origin they would cancel. */
static void measure(const TopoDS_Shape &shape, double unit, crease_cad_info &info)
{
    const gp_Pnt corner = find_bounds(shape, unit, info);
    GProp_GProps area(corner);
    BRepGProp::SurfaceProperties(shape, area, INTEGRAL_ERROR);
    info.area = area.Mass() / (unit * unit);
    const TopTools_IndexedMapOfShape solids = parts_of(shape, TopAbs_SOLID);
    info.solids = (size_t)solids.Extent();
    for (int i = 1; i <= solids.Extent(); i++) {
        GProp_GProps volume(corner);
        BRepGProp::VolumeProperties(solids(i), volume, INTEGRAL_ERROR);
        info.volume += volume.Mass() / (unit * unit * unit);
    }
    info.tolerance = ShapeAnalysis_ShapeTolerance().Tolerance(shape, 1) / unit;
}

static crease_cad_info info_of(const Model &model)
{
    crease_cad_info info = {};
    std::snprintf(info.format, sizeof info.format, "%s", model.format.c_str());
    std::snprintf(info.schema, sizeof info.schema, "%s", model.schema.c_str());
    info.vertices = (size_t)parts_of(model.shape, TopAbs_VERTEX).Extent();
    count_shells(model.shape, info);
    count_faces(model.shape, info);
    count_edges(model.shape, info);
    measure(model.shape, model.unit, info);
    info.valid = BRepCheck_Analyzer(model.shape).IsValid();
    return info;
}

} // namespace crease_cad

crease_status crease_cad_info_read(crease_context *context, const char *path, crease_cad_info *out)
{
    *out = {};
    return crease_cad::guard(context, path, [&] {
        const auto work = [&] { return crease_cad::info_of(crease_cad::read_model(path)); };
        *out = crease_cad::run_apart_for<crease_cad_info>(work);
    });
}
