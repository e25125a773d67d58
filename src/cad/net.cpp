/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Nets are turned, cut and mended here. Operations work along u; transpose first to work along v.
 * The domain of a clamped net is [0, 1] in u and v. */
#include "cad/net.hpp"

#include "cad/kernel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

namespace crease_cad
{

/* Knots nearer than this part of the domain are one: OpenCASCADE takes them for one, too. */
static constexpr double KNOT_RESOLUTION = 1e-9;

struct SurfaceDeleter {
    void operator()(crease_surface *surface) const
    {
        crease_surface_free(surface);
    }
};
using Surface = std::unique_ptr<crease_surface, SurfaceDeleter>;

Net net_of(const crease_surface *surface)
{
    const crease_surface_parts parts = crease_surface_parts_of(surface);
    Net net;
    for (int d = 0; d < 2; d++) {
        net.degree[d] = parts.order[d] - 1;
        net.count[d] = parts.count[d];
        net.knots[d].assign(
            parts.knots[d], parts.knots[d] + parts.count[d] + (size_t)parts.order[d]);
    }
    const size_t count = net.count[0] * net.count[1];
    net.points.reserve(count);
    for (const double *p = parts.control_points; net.points.size() < count; p += 3)
        net.points.emplace_back(p[0], p[1], p[2]);
    return net;
}

Net net_of(const crease_curve *curve)
{
    const int order = crease_curve_order(curve);
    const size_t count = crease_curve_count(curve);
    const double *knots = crease_curve_knots(curve), *points = crease_curve_control_points(curve);
    Net net = {
        {order - 1, 0}, {count, 1}, {{knots, knots + count + (size_t)order}, {0.0, 1.0}}, {}};
    for (const double *p = points; net.points.size() < count; p += 3)
        net.points.emplace_back(p[0], p[1], p[2]);
    return net;
}

static Surface surface_of(crease_context *context, const Net &net)
{
    std::vector<double> points;
    points.reserve(net.points.size() * 3);
    for (const gp_XYZ &p : net.points)
        points.insert(points.end(), {p.X(), p.Y(), p.Z()});
    const crease_surface_parts parts = {{net.degree[0] + 1, net.degree[1] + 1},
        {net.count[0], net.count[1]}, {net.knots[0].data(), net.knots[1].data()}, points.data()};
    crease_surface *surface = nullptr;
    require(crease_surface_create(context, &parts, &surface));
    return Surface(surface);
}

/* Not by gp_XYZ::Coord(i): it reaches past a member, and optimisers take that for impossible. */
Measure measure_of(const std::vector<Net> &nets)
{
    gp_XYZ low(INFINITY, INFINITY, INFINITY), high = low.Reversed();
    for (const Net &net : nets)
        for (const gp_XYZ &p : net.points) {
            low = gp_XYZ(
                std::min(low.X(), p.X()), std::min(low.Y(), p.Y()), std::min(low.Z(), p.Z()));
            high = gp_XYZ(
                std::max(high.X(), p.X()), std::max(high.Y(), p.Y()), std::max(high.Z(), p.Z()));
        }
    const double reach = std::max(low.Modulus(), high.Modulus());
    Measure measure;
    measure.size = (high - low).Modulus();
    measure.fuzz = 1e-12 * measure.size + 16 * std::numeric_limits<double>::epsilon() * reach;
    measure.tolerance = std::max(4 * measure.fuzz, std::min(1e-7, 1e-5 * measure.size));
    measure.joint = measure.tolerance / 4;
    return measure;
}

static Net transposed(const Net &net)
{
    Net out = net;
    std::swap(out.degree[0], out.degree[1]);
    std::swap(out.count[0], out.count[1]);
    std::swap(out.knots[0], out.knots[1]);
    for (size_t i = 0; i < out.count[0]; i++)
        for (size_t j = 0; j < out.count[1]; j++)
            out.at(i, j) = net.at(j, i);
    return out;
}

/* The net with u running the other way. */
static Net reversed(const Net &net)
{
    Net out = net;
    const double sum = net.knots[0].front() + net.knots[0].back();
    std::reverse(out.knots[0].begin(), out.knots[0].end());
    for (double &knot : out.knots[0])
        knot = sum - knot;
    for (size_t i = 0; i < out.count[0]; i++)
        for (size_t j = 0; j < out.count[1]; j++)
            out.at(i, j) = net.at(net.count[0] - 1 - i, j);
    return out;
}

static bool rows_equal(const Net &net, size_t first, size_t second, double within)
{
    for (size_t j = 0; j < net.count[1]; j++)
        if ((net.at(first, j) - net.at(second, j)).Modulus() > within)
            return false;
    return true;
}

static bool run_equal(const Net &net, size_t first, size_t last, double within)
{
    for (size_t i = first + 1; i <= last; i++)
        if (!rows_equal(net, first, i, within))
            return false;
    return true;
}

/* True when the net has shrunk to a curve or a point along u or v; that of a curve has no v. */
static bool collapsed(const Net &net, double within)
{
    const Net turned = transposed(net);
    return run_equal(net, 0, net.count[0] - 1, within) ||
        (turned.degree[0] > 0 && run_equal(turned, 0, turned.count[0] - 1, within));
}

static size_t multiplicity(const std::vector<double> &knots, double t)
{
    return (size_t)std::count(knots.begin(), knots.end(), t);
}

/* Maps the domain to [0, 1] and makes nearly equal knots equal, the ends first. */
static void normalise(std::vector<double> &knots, int degree)
{
    const double first = knots[(size_t)degree], last = knots[knots.size() - 1 - (size_t)degree];
    for (double &knot : knots) {
        knot = (knot - first) / (last - first);
        for (const double end : {0.0, 1.0})
            if (std::fabs(knot - end) < KNOT_RESOLUTION)
                knot = end;
    }
    for (size_t i = 1; i < knots.size(); i++)
        if (knots[i] - knots[i - 1] < KNOT_RESOLUTION)
            knots[i] = knots[i - 1];
}

static Net with_knot(crease_context *context, const Net &net, double u, size_t times)
{
    if (times == 0)
        return net;
    crease_surface *finer = nullptr;
    require(crease_surface_insert_knot(
        context, surface_of(context, net).get(), 0, u, (int)times, &finer));
    return net_of(Surface(finer).get());
}

static Net normalised(const Net &net)
{
    Net out = net;
    for (int d = 0; d < 2; d++)
        normalise(out.knots[d], out.degree[d]);
    return out;
}

/* The same surface over [0, 1] x [0, 1] with clamped knots, nearly equal knots made equal. */
static Net clamped(crease_context *context, const Net &net)
{
    crease_surface *surface = nullptr;
    require(crease_surface_clamp(context, surface_of(context, normalised(net)).get(), &surface));
    return net_of(Surface(surface).get());
}

/* An inner u where the surface may have a crease: the knot's multiplicity reaches the degree, or
 * all control rows that matter there are one (the averaging method's repeated rows). */
static std::optional<double> crease_of(const Net &net, double within)
{
    const std::vector<double> &knots = net.knots[0];
    const size_t degree = (size_t)net.degree[0];
    for (size_t i = degree + 1; i < net.count[0]; i++) {
        const size_t times = multiplicity(knots, knots[i]);
        if (times >= degree)
            return knots[i];
        /* the rows that matter at the first knot of its value */
        if (knots[i] != knots[i - 1] && run_equal(net, i + times - 1 - degree, i - 1, within))
            return knots[i];
    }
    return std::nullopt;
}

/* Cuts a clamped net at u. */
static std::pair<Net, Net> split(crease_context *context, const Net &net, double u)
{
    crease_surface *lower = nullptr, *upper = nullptr;
    require(crease_surface_split(context, surface_of(context, net).get(), 0, u, &lower, &upper));
    const Surface below(lower), above(upper);
    return {normalised(net_of(below.get())), normalised(net_of(above.get()))};
}

static bool vanishing_at_start(const Net &net, double within)
{
    return net.degree[0] > 1 && run_equal(net, 0, (size_t)net.degree[0] - 1, within);
}

static Net straightened_at_start(crease_context *context, const Net &given)
{
    const size_t degree = (size_t)given.degree[0];
    const double end = given.knots[0][degree + 1];
    const bool inner = end < 1.0;
    Net net =
        with_knot(context, given, end, inner ? degree - multiplicity(given.knots[0], end) : 0);
    for (size_t i = 1; i < degree; i++)
        for (size_t j = 0; j < net.count[1]; j++) {
            const gp_XYZ along = net.at(degree, j) - net.at(0, j);
            net.at(i, j) = net.at(0, j) + along * ((double)i / (double)degree);
        }
    std::fill_n(net.knots[0].begin(), degree + 1, end - end / (double)degree);
    if (inner) { /* C1 there now: the row at the knot and one knot are superfluous */
        const auto row = net.points.begin() + (std::ptrdiff_t)(degree * net.count[1]);
        net.points.erase(row, row + (std::ptrdiff_t)net.count[1]);
        net.knots[0].erase(net.knots[0].begin() + (std::ptrdiff_t)degree + 1);
        net.count[0]--;
    }
    normalise(net.knots[0], net.degree[0]);
    return net;
}

/* At repeated rows the surface's derivative vanishes at the border: there S = R + s^degree (Q - R).
 * That first span is ruled; this gives it the parameter w = s^degree, which is the same surface
 * with a derivative, and C1 where it meets the next span. */
static Net straightened(crease_context *context, const Net &net, double within)
{
    Net out = net;
    for (int d = 0; d < 2; d++) {
        if (vanishing_at_start(out, within))
            out = straightened_at_start(context, out);
        const Net back = reversed(out);
        if (vanishing_at_start(back, within))
            out = reversed(straightened_at_start(context, back));
        out = transposed(out);
    }
    return out;
}

/* Cuts a clamped net at its creases, in both directions, until the pieces are smooth. */
static void add_smooth_pieces(
    crease_context *context, const Net &net, const Measure &measure, std::vector<Net> &out)
{
    for (int d = 0; d < 2; d++) {
        const Net turned = d == 0 ? net : transposed(net);
        const std::optional<double> crease = crease_of(turned, measure.fuzz);
        if (!crease)
            continue;
        const auto [lower, upper] = split(context, turned, *crease);
        for (const Net &piece : {lower, upper})
            add_smooth_pieces(context, d == 0 ? piece : transposed(piece), measure, out);
        return;
    }
    if (!collapsed(net, measure.joint))
        out.push_back(straightened(context, net, measure.fuzz));
}

std::vector<Net> smooth_pieces(crease_context *context, const Net &net, const Measure &measure)
{
    std::vector<Net> pieces;
    add_smooth_pieces(context, clamped(context, net), measure, pieces);
    return pieces;
}

} // namespace crease_cad
