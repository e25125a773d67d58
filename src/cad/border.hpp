/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The borders of patches, and which stretches of them are one edge. */
#ifndef CREASE_CAD_BORDER_HPP
#define CREASE_CAD_BORDER_HPP

#include "cad/shell.hpp"

#include <Geom_BSplineCurve.hxx>

#include <map>

namespace crease_cad
{

/* The sides of a patch in the order of a walk around it with the face on the left: along v = 0 and
 * u = 1 with the parameter growing, along v = 1 and u = 0 with it falling. */
enum Side { SIDE_V0, SIDE_U1, SIDE_V1, SIDE_U0, SIDE_COUNT };

struct Border {
    size_t patch;
    Side side;
    Handle(Geom_BSplineCurve) curve;
    bool degenerate; /* shrunk to a point */
};

/* A stretch of a border and the edge that it lies on. */
struct Stretch {
    size_t border;
    double from, to;
    size_t vertices[2]; /* at from and to */
    size_t edge;
    bool backward; /* runs against the edge */
};

/* An edge and the one or two stretches that are it; the first one gives its direction. */
struct Edge {
    std::vector<size_t> stretches;
};

/* Everything that two faces may share. */
struct Borders {
    std::vector<gp_XYZ> vertices;
    std::vector<Border> borders;    /* SIDE_COUNT of each patch, by side */
    std::vector<Stretch> stretches; /* by border, then by parameter */
    std::vector<Edge> edges;
};

Borders match_borders(const std::vector<Patch> &patches, const Measure &measure);

} // namespace crease_cad

#endif
