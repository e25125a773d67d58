/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "cad/bicubic.hpp"

#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRep_Tool.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>

#include <algorithm>

namespace crease_cad
{

static constexpr int CUBIC = 3;

/* Raising the degree leaves the parameters as they are, and so the curves on the faces. */
TopoDS_Shape bicubic(const TopoDS_Shape &shape)
{
    const TopoDS_Shape out = BRepBuilderAPI_NurbsConvert(shape, true).Shape();
    for (TopExp_Explorer it(out, TopAbs_FACE); it.More(); it.Next()) {
        TopLoc_Location location;
        const Handle(Geom_BSplineSurface) surface = Handle(Geom_BSplineSurface)::DownCast(
            BRep_Tool::Surface(TopoDS::Face(it.Current()), location));
        if (!surface.IsNull())
            surface->IncreaseDegree(
                std::max(CUBIC, surface->UDegree()), std::max(CUBIC, surface->VDegree()));
    }
    return out;
}

} // namespace crease_cad
