/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Faces cut along all their intersections, and the cells that the pieces bound. */
#ifndef CREASE_CAD_ARRANGEMENT_HPP
#define CREASE_CAD_ARRANGEMENT_HPP

#include "cad/cells.hpp"
#include "cad/extended_face.hpp"

#include <TopoDS_Edge.hxx>
#include <TopoDS_Shape.hxx>

#include <vector>

namespace crease_cad
{

struct Piece {
    TopoDS_Face face;
    size_t carrier; /* place in the list of faces */
    double area;
    double support; /* area that its carrier's points beside it stand for */
};

struct Arrangement {
    std::vector<Piece> pieces;
    std::vector<Wall> walls;                /* the pieces between their cells */
    std::vector<TopoDS_Shape> cells;        /* from 1; number 0 is the outside */
    std::vector<std::vector<size_t>> edges; /* pieces around each edge */
};

/* A face and the carrier whose points support it. */
struct Supported {
    const Carrier *carrier;
    ExtendedFace extended;
};

/* The cells, and the pieces that bound them; pieces that bound none are left out. */
Arrangement cells_between(const Job &job, const std::vector<Supported> &faces);
/* All pieces, cut along further edges, too; neither walls nor cells nor edges. */
Arrangement pieces_of(
    const Job &job, const std::vector<Supported> &faces, const std::vector<TopoDS_Edge> &cuts);

} // namespace crease_cad

#endif
