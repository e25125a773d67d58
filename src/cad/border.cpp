/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "cad/border.hpp"

#include "cad/occt.hpp"
#include "cad/vertices.hpp"

#include <algorithm>
#include <array>

namespace crease_cad
{

namespace
{

constexpr size_t NONE = Vertices::NONE;

class Matcher
{
  public:
    Matcher(const std::vector<Patch> &patches, const Measure &measure);
    Borders match();

  private:
    void add_border(const std::vector<Patch> &patches, size_t patch, Side side);
    void add_whole_stretches();
    void match_free();
    void cut_free();
    bool join(size_t stretch, size_t edge);
    bool coincide(const Stretch &a, const Stretch &b, bool backward) const;
    bool may_share_face(const Stretch &a, const Stretch &b, bool backward) const;
    void number_edges();

    double within;
    Borders result;
    Vertices vertices;
};

Matcher::Matcher(const std::vector<Patch> &patches, const Measure &measure)
    : within(measure.joint), vertices(result.vertices, within)
{
    for (size_t i = 0; i < patches.size(); i++)
        for (int side = 0; side < SIDE_COUNT; side++)
            add_border(patches, i, (Side)side);
}

void Matcher::add_border(const std::vector<Patch> &patches, size_t patch, Side side)
{
    const Net &net = patches[patch].net;
    const int along = side == SIDE_V0 || side == SIDE_V1 ? 0 : 1;
    const bool last = side == SIDE_U1 || side == SIDE_V1;
    std::vector<gp_XYZ> points;
    for (size_t i = 0; i < net.count[along]; i++)
        points.push_back(along == 0 ? net.at(i, last ? net.count[1] - 1 : 0)
                                    : net.at(last ? net.count[0] - 1 : 0, i));
    const bool degenerate = std::all_of(points.begin(), points.end(),
        [&](const gp_XYZ &p) { return (p - points[0]).Modulus() <= within; });
    result.borders.push_back(
        {patch, side, curve_of(net.degree[along], net.knots[along], points), degenerate});
}

void Matcher::add_whole_stretches()
{
    for (size_t i = 0; i < result.borders.size(); i++) {
        const Handle(Geom_BSplineCurve) &curve = result.borders[i].curve;
        const size_t first = vertices.find_or_add(curve->StartPoint().XYZ());
        const size_t last = vertices.find_or_add(curve->EndPoint().XYZ());
        result.stretches.push_back({i, 0.0, 1.0, {first, last}, NONE, false});
    }
}

/* Polynomials that agree at degree + 1 places of every span agree everywhere. */
bool Matcher::coincide(const Stretch &a, const Stretch &b, bool backward) const
{
    const Handle(Geom_BSplineCurve) &p = result.borders[a.border].curve;
    const Handle(Geom_BSplineCurve) &q = result.borders[b.border].curve;
    std::vector<double> places = {0.0, 1.0};
    for (int i = 1; i <= p->NbKnots(); i++)
        places.push_back((p->Knot(i) - a.from) / (a.to - a.from));
    for (int i = 1; i <= q->NbKnots(); i++) {
        const double place = (q->Knot(i) - b.from) / (b.to - b.from);
        places.push_back(backward ? 1.0 - place : place);
    }
    std::sort(places.begin(), places.end());
    const int degree = std::max(p->Degree(), q->Degree());
    for (size_t i = 1; i < places.size(); i++)
        for (int k = 0; k <= degree; k++) {
            const double s = places[i - 1] + (places[i] - places[i - 1]) * k / degree;
            if (places[i - 1] < 0.0 || places[i] > 1.0)
                continue;
            const double t = backward ? 1.0 - s : s;
            const gp_Pnt here = p->Value(a.from + (a.to - a.from) * s);
            if (here.Distance(q->Value(b.from + (b.to - b.from) * t)) > within)
                return false;
        }
    return true;
}

/* A face meets itself along a seam only: opposite sides that run the same way. */
bool Matcher::may_share_face(const Stretch &a, const Stretch &b, bool backward) const
{
    const Border &p = result.borders[a.border], &q = result.borders[b.border];
    if (p.patch != q.patch)
        return true;
    return !backward && (p.side + 2) % SIDE_COUNT == q.side % SIDE_COUNT;
}

/* Lets the stretch become part of the edge if it is the same curve. */
bool Matcher::join(size_t stretch, size_t edge)
{
    Stretch &b = result.stretches[stretch];
    const Stretch &a = result.stretches[result.edges[edge].stretches[0]];
    for (const bool backward : {false, true}) {
        if (a.vertices[0] != b.vertices[backward] || a.vertices[1] != b.vertices[!backward])
            continue;
        if (!may_share_face(a, b, backward) || !coincide(a, b, backward))
            continue;
        b.edge = edge;
        b.backward = backward;
        result.edges[edge].stretches.push_back(stretch);
        return true;
    }
    return false;
}

/* Gives every stretch an edge; edges with one stretch only stay open to a second. */
void Matcher::match_free()
{
    std::map<std::array<size_t, 2>, std::vector<size_t>> open;
    for (size_t i = 0; i < result.stretches.size(); i++) {
        Stretch &stretch = result.stretches[i];
        if (stretch.edge != NONE)
            continue;
        std::array<size_t, 2> key = {stretch.vertices[0], stretch.vertices[1]};
        std::sort(key.begin(), key.end());
        std::vector<size_t> &edges = open[key];
        const bool alone = result.borders[stretch.border].degenerate;
        const auto found = std::find_if(
            edges.begin(), edges.end(), [&](size_t edge) { return !alone && join(i, edge); });
        if (found != edges.end()) {
            edges.erase(found);
            continue;
        }
        stretch.edge = result.edges.size();
        result.edges.push_back({{i}});
        if (!alone)
            edges.push_back(stretch.edge);
    }
}

/* Cuts the stretches that found no partner at the knots where another patch has a vertex, and frees
 * them for another search. */
void Matcher::cut_free()
{
    std::vector<Stretch> cut;
    for (Stretch stretch : result.stretches) {
        const Border &border = result.borders[stretch.border];
        if (result.edges[stretch.edge].stretches.size() == 2) {
            cut.push_back(stretch);
            continue;
        }
        stretch.edge = NONE;
        for (int k = 2; k < border.curve->NbKnots() && !border.degenerate; k++) {
            const double t = border.curve->Knot(k);
            const size_t vertex = vertices.find(border.curve->Value(t).XYZ());
            if (vertex == NONE)
                continue;
            cut.push_back(
                {stretch.border, stretch.from, t, {stretch.vertices[0], vertex}, NONE, false});
            stretch.from = t;
            stretch.vertices[0] = vertex;
        }
        cut.push_back(stretch);
    }
    result.stretches = cut;
}

/* Rebuilds the edges in the order of their first stretch. */
void Matcher::number_edges()
{
    std::map<size_t, size_t> number;
    result.edges.clear();
    for (size_t i = 0; i < result.stretches.size(); i++) {
        Stretch &stretch = result.stretches[i];
        if (stretch.edge == NONE)
            continue;
        const auto [it, fresh] = number.emplace(stretch.edge, result.edges.size());
        if (fresh)
            result.edges.emplace_back();
        stretch.edge = it->second;
        result.edges[stretch.edge].stretches.push_back(i);
    }
}

Borders Matcher::match()
{
    add_whole_stretches();
    match_free();
    cut_free();
    number_edges();
    match_free();
    return std::move(result);
}

} // namespace

Borders match_borders(const std::vector<Patch> &patches, const Measure &measure)
{
    return Matcher(patches, measure).match();
}

} // namespace crease_cad
