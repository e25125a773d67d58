/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A control net with its knots, as a value that can be turned, cut and mended. Operations work
 * along u; transpose first to work along v. The domain of a clamped net is [0, 1] in u and v. */
#ifndef CREASE_CAD_NET_HPP
#define CREASE_CAD_NET_HPP

#include "crease/crease.h"

#include <gp_XYZ.hxx>

#include <optional>
#include <utility>
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
Measure measure_of(const std::vector<Net> &nets);

Net transposed(const Net &net);
/* The net with u running the other way. */
Net reversed(const Net &net);
bool rows_equal(const Net &net, size_t first, size_t second, double within);
/* True when the net has shrunk to a curve or a point along u or v. */
bool collapsed(const Net &net, double within);

/* The same surface over [0, 1] x [0, 1] with clamped knots, nearly equal knots made equal. */
Net clamped(crease_context *context, const Net &net);
/* An inner u where the surface may have a crease: the knot's multiplicity reaches the degree, or
 * all control rows that matter there are one (the averaging method's repeated rows). */
std::optional<double> crease_of(const Net &net, double within);
/* Cuts a clamped net at u. */
std::pair<Net, Net> split(crease_context *context, const Net &net, double u);
/* At repeated rows the surface's derivative vanishes at the border: there S = R + s^degree (Q - R).
 * That first span is ruled; this gives it the parameter w = s^degree, which is the same surface
 * with a derivative, and C1 where it meets the next span. */
Net straightened(crease_context *context, const Net &net, double within);

} // namespace crease_cad

#endif
