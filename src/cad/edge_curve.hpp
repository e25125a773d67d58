/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Edges as cubic B-spline curves. */
#ifndef CREASE_CAD_EDGE_CURVE_HPP
#define CREASE_CAD_EDGE_CURVE_HPP

#include <TopoDS_Edge.hxx>

#include <vector>

namespace crease_cad
{

/* Appends the control points, 3 numbers each, and their number plus 4 knots, of a cubic through
 * points of the edge; returns the number of control points. */
size_t add_cubic_curve(
    const TopoDS_Edge &edge, std::vector<double> &poles, std::vector<double> &knots);

} // namespace crease_cad

#endif
