/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "cad/arrangement.hpp"

#include "cad/closing.hpp"
#include "cad/effort.hpp"
#include "cad/kernel.hpp"

#include <BOPAlgo_Builder.hxx>
#include <BOPAlgo_MakerVolume.hxx>
#include <BRepTopAdaptor_FClass2d.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>

#include <algorithm>
#include <memory>

namespace crease_cad
{

static constexpr double FUZZ = 1e-7;          /* of the diagonal: what is nearer is one */
static constexpr double IN_FACE = 1e-7;       /* tolerance in the plane of the parameters */
static constexpr long MOST_QUESTIONS = 50000; /* see Effort */
static constexpr size_t MOST_VOTERS = 8000;   /* points of one carrier that are looked at */

/* Gives every point of the face's carrier to the piece that it lies beside. */
static void count_support(
    const Supported &of, const std::vector<size_t> &mine, std::vector<Piece> &pieces)
{
    std::vector<std::unique_ptr<BRepTopAdaptor_FClass2d>> inside;
    for (const size_t i : mine)
        inside.push_back(std::make_unique<BRepTopAdaptor_FClass2d>(
            TopoDS::Face(pieces[i].face.Oriented(TopAbs_FORWARD)), IN_FACE));
    const size_t step = 1 + of.carrier->points.size() / MOST_VOTERS;
    for (size_t p = 0; p < of.carrier->points.size(); p += step) {
        const gp_Pnt2d place = foot(of.extended, of.carrier->points[p]);
        for (size_t k = 0; k < mine.size(); k++)
            if (inside[k]->Perform(place, true) == TopAbs_IN) {
                pieces[mine[k]].support += (double)step * of.carrier->areas[p];
                break;
            }
    }
}

/* The pieces that a face was cut into, itself when it was not. */
static TopTools_ListOfShape pieces_of_face(BOPAlgo_Builder &cutter, const TopoDS_Face &face)
{
    TopTools_ListOfShape cut = cutter.Modified(face);
    if (cut.IsEmpty())
        cut.Append(face);
    return cut;
}

static void prepare(BOPAlgo_Builder &cutter, const Job &job, const std::vector<Supported> &faces)
{
    for (const Supported &face : faces)
        cutter.AddArgument(face.extended.face);
    cutter.SetRunParallel(false);
    cutter.SetNonDestructive(true);
    cutter.SetFuzzyValue(FUZZ * job.diagonal);
}

/* The number of each cell, from 1, and the pieces that bound it. */
static TopTools_IndexedMapOfShape number_cells(const TopoDS_Shape &volumes, Arrangement &out)
{
    TopTools_IndexedMapOfShape solids;
    TopExp::MapShapes(volumes, TopAbs_SOLID, solids);
    out.cells.emplace_back();
    for (int i = 1; i <= solids.Extent(); i++)
        out.cells.push_back(solids(i));
    TopTools_IndexedDataMapOfShapeListOfShape around;
    TopExp::MapShapesAndAncestors(volumes, TopAbs_FACE, TopAbs_SOLID, around);
    TopTools_IndexedMapOfShape numbers;
    for (int i = 1; i <= around.Extent(); i++) {
        const TopoDS_Face face = TopoDS::Face(around.FindKey(i));
        numbers.Add(face);
        out.pieces.push_back({face, 0, area_of(face), 0.0});
        Wall wall = {};
        size_t sides = 0;
        for (TopTools_ListIteratorOfListOfShape it(around(i)); it.More() && sides < 2; it.Next())
            wall.cells[sides++] = (size_t)solids.FindIndex(it.Value());
        out.walls.push_back(wall);
    }
    return numbers;
}

static void list_edges(
    const TopoDS_Shape &volumes, const TopTools_IndexedMapOfShape &numbers, Arrangement &out)
{
    TopTools_IndexedDataMapOfShapeListOfShape around;
    TopExp::MapShapesAndAncestors(volumes, TopAbs_EDGE, TopAbs_FACE, around);
    for (int i = 1; i <= around.Extent(); i++) {
        std::vector<size_t> pieces;
        for (TopTools_ListIteratorOfListOfShape it(around(i)); it.More(); it.Next())
            pieces.push_back((size_t)numbers.FindIndex(it.Value()) - 1);
        std::sort(pieces.begin(), pieces.end());
        pieces.erase(std::unique(pieces.begin(), pieces.end()), pieces.end());
        out.edges.push_back(pieces);
    }
}

/* Supported all over speaks fully for a piece, bare fully against it. */
static void weigh(Arrangement &out)
{
    for (size_t i = 0; i < out.pieces.size(); i++) {
        const Piece &piece = out.pieces[i];
        out.walls[i].weight = std::clamp(2.0 * piece.support - piece.area, -piece.area, piece.area);
    }
}

Arrangement cells_between(const Job &job, const std::vector<Supported> &faces)
{
    BOPAlgo_MakerVolume maker;
    prepare(maker, job, faces);
    maker.SetIntersect(true);
    maker.SetAvoidInternalShapes(true);
    const Handle(Effort) effort = new Effort(MOST_QUESTIONS);
    maker.Perform(effort->Start());
    effort->check();
    if (maker.HasErrors())
        throw Failure{CREASE_ERROR_NUMERIC, "OpenCASCADE cannot intersect the surfaces"};
    Arrangement out;
    const TopTools_IndexedMapOfShape numbers = number_cells(maker.Shape(), out);
    list_edges(maker.Shape(), numbers, out);
    for (size_t f = 0; f < faces.size(); f++) {
        std::vector<size_t> mine;
        for (const TopoDS_Shape &cut : pieces_of_face(maker, faces[f].extended.face))
            if (const int number = numbers.FindIndex(cut); number > 0) {
                mine.push_back((size_t)number - 1);
                out.pieces[mine.back()].carrier = f;
            }
        count_support(faces[f], mine, out.pieces);
    }
    weigh(out);
    return out;
}

Arrangement pieces_of(
    const Job &job, const std::vector<Supported> &faces, const std::vector<TopoDS_Edge> &cuts)
{
    BOPAlgo_Builder cutter;
    prepare(cutter, job, faces);
    for (const TopoDS_Edge &cut : cuts)
        cutter.AddArgument(cut);
    const Handle(Effort) effort = new Effort(MOST_QUESTIONS);
    if (faces.size() + cuts.size() > 1)
        cutter.Perform(effort->Start());
    effort->check();
    if (cutter.HasErrors())
        throw Failure{CREASE_ERROR_NUMERIC, "OpenCASCADE cannot intersect the surfaces"};
    Arrangement out;
    for (size_t f = 0; f < faces.size(); f++) {
        std::vector<size_t> mine;
        for (const TopoDS_Shape &cut : pieces_of_face(cutter, faces[f].extended.face)) {
            mine.push_back(out.pieces.size());
            out.pieces.push_back({TopoDS::Face(cut), f, area_of(cut), 0.0});
        }
        count_support(faces[f], mine, out.pieces);
    }
    return out;
}

} // namespace crease_cad
