/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The way that follows the topology of the points: nothing is intersected, so surfaces may be
 * tangent to each other, and what the points leave open stays open. */
#include "cad/brep.hpp"
#include "cad/closing.hpp"
#include "cad/ways.hpp"

#include <BRepCheck_Analyzer.hxx>
#include <ShapeFix_Shape.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>

#include <algorithm>

namespace crease_cad
{

static int face_count(const TopoDS_Shape &shape)
{
    TopTools_IndexedMapOfShape faces;
    TopExp::MapShapes(shape, TopAbs_FACE, faces);
    return faces.Extent();
}

/* What OpenCASCADE can mend without taking or adding faces. */
static TopoDS_Shape mended(const TopoDS_Shape &shape)
{
    if (BRepCheck_Analyzer(shape).IsValid())
        return shape;
    ShapeFix_Shape fix(shape);
    fix.Perform();
    const TopoDS_Shape fixed = fix.Shape();
    const bool fine = !fixed.IsNull() && BRepCheck_Analyzer(fixed).IsValid() &&
        face_count(fixed) == face_count(shape) && is_closed(fixed) == is_closed(shape);
    return fine ? fixed : shape;
}

static std::string why_open(const crease_topology &topology)
{
    const auto open = std::count(topology.open, topology.open + topology.region_count, true);
    if (open == 0)
        return "";
    return std::to_string(open) + " of " + std::to_string(topology.region_count) +
        " faces have no closed border";
}

Attempt follow_topology(const Job &job, double)
{
    const Brep brep = brep_of(job.topology(), job.inwards());
    if (brep.shape.IsNull())
        return {TopoDS_Shape(), why_open(job.topology())};
    return {mended(brep.shape), why_open(job.topology())};
}

} // namespace crease_cad
