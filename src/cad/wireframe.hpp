/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Edges on no face as a STEP model. */
#ifndef CREASE_CAD_WIREFRAME_HPP
#define CREASE_CAD_WIREFRAME_HPP

#include <StepData_StepModel.hxx>
#include <TopoDS_Shape.hxx>

namespace crease_cad
{

/* Adds the edges of the shape, all of which have B-spline curves, to an empty model. */
void add_wireframe(const TopoDS_Shape &shape, const Handle(StepData_StepModel) & model);

} // namespace crease_cad

#endif
