/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Which cells of an arrangement are inside a part. Every wall between two cells has a weight: how
 * much speaks for it being part of the surface (positive) or not. Cells on both sides of a wall of
 * the surface differ, on both sides of any other they agree, so no normals are needed. */
#ifndef CREASE_CAD_CELLS_HPP
#define CREASE_CAD_CELLS_HPP

#include <cstddef>
#include <vector>

namespace crease_cad
{

struct Wall {
    size_t cells[2]; /* 0 is the outside; equal when the wall ends inside a cell */
    double weight;
};

/* inside[0] is false. edges: the walls around each edge. A surface passes an edge once, so no edge
 * has more than two walls between inside and outside, as far as that can be had. */
std::vector<bool> choose_cells(
    size_t count, const std::vector<Wall> &walls, const std::vector<std::vector<size_t>> &edges);

} // namespace crease_cad

#endif
