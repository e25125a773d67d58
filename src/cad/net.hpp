/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A control net with its knots, as a value, and its smooth pieces. */
#ifndef CREASE_CAD_NET_HPP
#define CREASE_CAD_NET_HPP

#include "crease/crease.h"

#include <gp_XYZ.hxx>

#include <vector>

namespace crease_cad
{

struct Net {
    int degree[2];
    size_t count[2];
    std::vector<double> knots[2];
    std::vector<gp_XYZ> points; /* count[0] x count[1], v fastest */

    const gp_XYZ &at(size_t u, size_t v) const
    {
        return points[u * count[1] + v];
    }
    gp_XYZ &at(size_t u, size_t v)
    {
        return points[u * count[1] + v];
    }
};

/* Lengths that decide what is equal, from the extent of all control points. */
struct Measure {
    double size;      /* diagonal of the bounding box */
    double fuzz;      /* control points nearer than this are one point, up to rounding */
    double joint;     /* borders and vertices nearer than this are joined */
    double tolerance; /* what CAD programs are told: points nearer than this are one vertex */
};

Net net_of(const crease_surface *surface);
/* A curve is a net of degree 0 along v. */
Net net_of(const crease_curve *curve);
Measure measure_of(const std::vector<Net> &nets);

/* The same surface or curve over [0, 1], clamped, cut at its creases until the pieces are smooth:
 * where a knot's multiplicity reaches the degree, or control rows are repeated as often. The pieces
 * come u-major; none has shrunk to a curve or a point. */
std::vector<Net> smooth_pieces(crease_context *context, const Net &net, const Measure &measure);

} // namespace crease_cad

#endif
