/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* OpenCASCADE's own translation makes a geometric curve set of such edges, in which no two of them
 * share a vertex. An edge-based wireframe model keeps the vertices. Each edge is a connected edge
 * set of its own: OpenCASCADE reads a set as one wire, and pulls edges together that do not follow
 * each other in it. */
#include "cad/wireframe.hpp"

#include <BRep_Tool.hxx>
#include <GeomToStep_MakeBSplineCurveWithKnots.hxx>
#include <GeomToStep_MakeCartesianPoint.hxx>
#include <Geom_BSplineCurve.hxx>
#include <STEPConstruct_ContextTool.hxx>
#include <STEPConstruct_Part.hxx>
#include <STEPConstruct_UnitContext.hxx>
#include <ShapeAnalysis_ShapeTolerance.hxx>
#include <StepBasic_ApplicationProtocolDefinition.hxx>
#include <StepBasic_ProductRelatedProductCategory.hxx>
#include <StepGeom_Axis2Placement3d.hxx>
#include <StepGeom_BSplineCurveWithKnots.hxx>
#include <StepGeom_CartesianPoint.hxx>
#include <StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx.hxx>
#include <StepRepr_HArray1OfRepresentationItem.hxx>
#include <StepShape_ConnectedEdgeSet.hxx>
#include <StepShape_EdgeBasedWireframeModel.hxx>
#include <StepShape_EdgeBasedWireframeShapeRepresentation.hxx>
#include <StepShape_EdgeCurve.hxx>
#include <StepShape_HArray1OfConnectedEdgeSet.hxx>
#include <StepShape_HArray1OfEdge.hxx>
#include <StepShape_ShapeDefinitionRepresentation.hxx>
#include <StepShape_VertexPoint.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>

#include <vector>

namespace crease_cad
{

static Handle(TCollection_HAsciiString) no_name()
{
    return new TCollection_HAsciiString("");
}

static Handle(StepShape_VertexPoint) step_vertex(const TopoDS_Vertex &vertex)
{
    const Handle(StepShape_VertexPoint) out = new StepShape_VertexPoint;
    out->Init(no_name(), GeomToStep_MakeCartesianPoint(BRep_Tool::Pnt(vertex)).Value());
    return out;
}

static Handle(StepGeom_BSplineCurveWithKnots) step_curve(const TopoDS_Edge &edge)
{
    double first = 0, last = 0;
    const Handle(Geom_BSplineCurve) curve =
        Handle(Geom_BSplineCurve)::DownCast(BRep_Tool::Curve(edge, first, last));
    return GeomToStep_MakeBSplineCurveWithKnots(curve).Value();
}

static Handle(StepShape_ConnectedEdgeSet) set_of(const Handle(StepShape_Edge) & edge)
{
    const Handle(StepShape_HArray1OfEdge) edges = new StepShape_HArray1OfEdge(1, 1);
    edges->SetValue(1, edge);
    const Handle(StepShape_ConnectedEdgeSet) out = new StepShape_ConnectedEdgeSet;
    out->Init(no_name(), edges);
    return out;
}

static Handle(StepShape_EdgeBasedWireframeModel) step_wireframe(const TopoDS_Shape &shape)
{
    TopTools_IndexedMapOfShape vertices, edges;
    TopExp::MapShapes(shape, TopAbs_VERTEX, vertices);
    TopExp::MapShapes(shape, TopAbs_EDGE, edges);
    std::vector<Handle(StepShape_VertexPoint)> points;
    for (int i = 1; i <= vertices.Extent(); i++)
        points.push_back(step_vertex(TopoDS::Vertex(vertices(i))));
    const auto point_at = [&](const TopoDS_Vertex &vertex) {
        return points[(size_t)vertices.FindIndex(vertex) - 1];
    };
    const Handle(StepShape_HArray1OfConnectedEdgeSet) sets =
        new StepShape_HArray1OfConnectedEdgeSet(1, edges.Extent());
    for (int i = 1; i <= edges.Extent(); i++) {
        const TopoDS_Edge edge = TopoDS::Edge(edges(i).Oriented(TopAbs_FORWARD));
        const Handle(StepShape_EdgeCurve) out = new StepShape_EdgeCurve;
        out->Init(no_name(), point_at(TopExp::FirstVertex(edge)),
            point_at(TopExp::LastVertex(edge)), step_curve(edge), true);
        sets->SetValue(i, set_of(out));
    }
    const Handle(StepShape_EdgeBasedWireframeModel) out = new StepShape_EdgeBasedWireframeModel;
    out->Init(no_name(), sets);
    return out;
}

void add_wireframe(const TopoDS_Shape &shape, const Handle(StepData_StepModel) & model)
{
    STEPConstruct_ContextTool context(model);
    context.AddAPD();
    STEPConstruct_UnitContext units;
    units.Init(ShapeAnalysis_ShapeTolerance().Tolerance(shape, 1));
    const Handle(StepRepr_HArray1OfRepresentationItem) items =
        new StepRepr_HArray1OfRepresentationItem(1, 2);
    items->SetValue(1, context.GetDefaultAxis());
    items->SetValue(2, step_wireframe(shape));
    const Handle(StepShape_EdgeBasedWireframeShapeRepresentation) representation =
        new StepShape_EdgeBasedWireframeShapeRepresentation;
    representation->Init(no_name(), items, units.Value());
    STEPConstruct_Part part;
    part.MakeSDR(representation, no_name(), context.GetAPD()->Application());
    model->AddWithRefs(part.SDRValue());
    model->AddWithRefs(part.PRPC());
    model->AddWithRefs(context.GetAPD());
}

} // namespace crease_cad
