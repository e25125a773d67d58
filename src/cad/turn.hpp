/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* How two faces meet along an edge. */
#ifndef CREASE_CAD_TURN_HPP
#define CREASE_CAD_TURN_HPP

#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>

#include <optional>

namespace crease_cad
{

struct Turn {
    double angle; /* between the normals, mean along the edge, degrees */
    bool convex;  /* seen from where the normals point */
};

/* None where a face has no normal all along. */
std::optional<Turn> turn_at(
    const TopoDS_Edge &edge, const TopoDS_Face &one, const TopoDS_Face &other);

/* Whether an edge with such a turn is sharp. */
bool is_sharp(const std::optional<Turn> &turn);

} // namespace crease_cad

#endif
