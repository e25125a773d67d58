/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "cad/ways.hpp"

#include "cad/arrangement.hpp"
#include "cad/brep.hpp"
#include "cad/closing.hpp"
#include "cad/outcome.hpp"
#include "cad/rounding.hpp"
#include "cad/tessellate.hpp"

#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>

#include <algorithm>

namespace crease_cad
{

static constexpr double MOSTLY = 0.5; /* supported share of a piece that makes it part of a shell */
static constexpr double BORDER_SPACINGS = 0.5; /* from the outermost points to a free border */

static bool is_fillet(const Carrier &carrier, const std::vector<Fillet> &fillets)
{
    return std::any_of(fillets.begin(), fillets.end(),
        [&](const Fillet &fillet) { return fillet.round == &carrier; });
}

static std::vector<Supported> extend_all(
    const Job &job, const std::vector<Fillet> &fillets, double margin)
{
    std::vector<Supported> faces;
    for (const Carrier &carrier : job.carriers)
        if (!carrier.points.empty() && !is_fillet(carrier, fillets))
            faces.push_back({&carrier, extend(job, carrier, margin)});
    return faces;
}

/* The pieces between inside and outside, turned outwards. */
static std::vector<TopoDS_Face> surface_of(
    const Arrangement &arrangement, const std::vector<bool> &inside)
{
    TopTools_IndexedMapOfShape numbers;
    for (const Piece &piece : arrangement.pieces)
        numbers.Add(piece.face);
    std::vector<TopoDS_Face> faces;
    for (size_t cell = 1; cell < inside.size(); cell++) {
        if (!inside[cell])
            continue;
        for (TopExp_Explorer it(arrangement.cells[cell], TopAbs_FACE); it.More(); it.Next()) {
            const Wall &wall = arrangement.walls[(size_t)numbers.FindIndex(it.Current()) - 1];
            if (inside[wall.cells[0]] != inside[wall.cells[1]])
                faces.push_back(TopoDS::Face(it.Current()));
        }
    }
    return faces;
}

Attempt arrange_solid(const Job &job, double margin)
{
    const std::vector<Fillet> fillets = find_fillets(job);
    const Arrangement arrangement = cells_between(job, extend_all(job, fillets, margin));
    const std::vector<bool> inside =
        choose_cells(arrangement.cells.size(), arrangement.walls, arrangement.edges);
    const std::vector<TopoDS_Face> faces = surface_of(arrangement, inside);
    if (faces.empty())
        return {{}, "the surfaces enclose no volume that the points support"};
    const TopoDS_Shape solid = solid_of(faces);
    if (!is_sound(solid))
        return {solid, "OpenCASCADE finds fault with the solid"};
    size_t left = 0;
    const TopoDS_Shape result = rounded(job, solid, fillets, &left);
    return {result, left ? std::to_string(left) + " fillets are left sharp" : ""};
}

/* Where the points end: the borders of faces that reach no farther. */
static std::vector<TopoDS_Edge> borders_of(const Job &job)
{
    std::vector<TopoDS_Edge> borders;
    for (const Supported &face : extend_all(job, {}, BORDER_SPACINGS * job.spacing))
        for (TopExp_Explorer it(face.extended.face, TopAbs_EDGE); it.More(); it.Next()) {
            const TopoDS_Edge edge = TopoDS::Edge(it.Current());
            if (!BRep_Tool::Degenerated(edge) && !BRep_Tool::IsClosed(edge, face.extended.face))
                borders.push_back(edge);
        }
    return borders;
}

/* The faces reach beyond the borders of their points, and so do the lines in which they cross:
 * lines that end inside a face do not cut it. */
Attempt arrange_shells(const Job &job, double margin)
{
    const Arrangement arrangement = pieces_of(job, extend_all(job, {}, margin), borders_of(job));
    std::vector<TopoDS_Face> faces;
    for (const Piece &piece : arrangement.pieces)
        if (piece.support > MOSTLY * piece.area)
            faces.push_back(piece.face);
    if (faces.empty())
        return {{}, "no face is supported by points"};
    return {shells_of(faces), ""};
}

/* The topology's faces where they close and can be triangulated, turned so that neighbours agree,
 * and the regions that have one. */
static std::vector<TopoDS_Face> closed_faces(const Job &job, std::vector<bool> &have)
{
    const Brep brep = brep_of(job.topology(), job.inwards());
    std::vector<TopoDS_Face> out;
    have.assign(job.topology().region_count, false);
    if (!brep.shape.IsNull())
        tessellate_some(brep.shape, MESH_TOLERANCE * job.diagonal);
    for (TopExp_Explorer it(brep.shape, TopAbs_FACE); it.More(); it.Next())
        for (size_t i = 0; i < brep.faces.size(); i++)
            if (it.Current().IsSame(brep.faces[i]) && is_tessellated(brep.faces[i])) {
                have[brep.regions[i]] = true;
                out.push_back(TopoDS::Face(it.Current()));
            }
    return out;
}

/* Faces that cannot be triangulated are left out: no other face should be lost with them. */
static void lay_out(
    const Job &job, const TopoDS_Face &face, const BRep_Builder &builder, TopoDS_Compound &out)
{
    if (face.IsNull())
        return;
    tessellate_some(face, MESH_TOLERANCE * job.diagonal);
    if (is_tessellated(face))
        builder.Add(out, face);
}

Attempt lay_out_rest(const Job &job, double margin)
{
    BRep_Builder builder;
    TopoDS_Compound compound;
    std::vector<bool> have;
    builder.MakeCompound(compound);
    for (const TopoDS_Face &face : closed_faces(job, have))
        builder.Add(compound, face);
    for (const Carrier &carrier : job.carriers)
        if (!carrier.points.empty() && !have[carrier.region])
            lay_out(job, extend(job, carrier, margin).face, builder, compound);
    return {compound, ""};
}

Attempt lay_out_faces(const Job &job, double margin)
{
    BRep_Builder builder;
    TopoDS_Compound compound;
    builder.MakeCompound(compound);
    for (const Supported &face : extend_all(job, {}, margin))
        lay_out(job, face.extended.face, builder, compound);
    return {compound, ""};
}

} // namespace crease_cad
