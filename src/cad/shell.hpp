/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Faces that share their edges and vertices, gathered in shells and solids. */
#ifndef CREASE_CAD_SHELL_HPP
#define CREASE_CAD_SHELL_HPP

#include "cad/net.hpp"

#include <TopoDS_Shape.hxx>

namespace crease_cad
{

/* One smooth piece of a surface: a clamped net, and the number of the surface it comes from. */
struct Patch {
    Net net;
    size_t surface;
};

/* One face for each patch. Borders that are the same curve with the same parameter, in either
 * direction, whole or from knot to knot, become one edge; nothing is approximated. Returns a shell,
 * a solid when the shell is closed, or a compound of several. Throws Failure. */
TopoDS_Shape assemble(const std::vector<Patch> &patches, const Measure &measure);

} // namespace crease_cad

#endif
