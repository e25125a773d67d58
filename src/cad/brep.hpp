/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A topology as a shape: no sewing, no search for what belongs together. Faces share the edges and
 * edges the vertices that the topology says they share. */
#ifndef CREASE_CAD_BREP_HPP
#define CREASE_CAD_BREP_HPP

#include "cad/sheet.hpp"
#include "topology/topology.h"

#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>

#include <vector>

namespace crease_cad
{

struct Brep {
    TopoDS_Shape shape;             /* solid, shell, or a compound of them; null without faces */
    std::vector<TopoDS_Face> faces; /* each as it was made */
    std::vector<uint32_t> regions;  /* of each of them */
    double tolerance;               /* the largest of an edge, in the cloud's unit */
};

/* Solids when all faces are there and close, their faces turned outwards. */
Brep brep_of(const crease_topology &topology, const Scaling &scaling);

} // namespace crease_cad

#endif
