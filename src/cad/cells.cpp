/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The labels follow the heaviest walls along a spanning tree (Kruskal 1956, with the parity of the
 * path in a union-find), then single cells change sides while that lowers the cost: the weights of
 * walls of the surface that should not be, and of those missing. The votes of a scan hardly
 * contradict each other, so this ends in or next to the optimum. */
#include "cad/cells.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace crease_cad
{

static constexpr int ROUNDS = 50;
static constexpr double LEAST_GAIN = 1e-12; /* of the heaviest wall */

namespace
{

/* Sets of cells in which each knows whether it is on the same side as its set's root. */
class Parity
{
  public:
    explicit Parity(size_t count) : parent(count), differs(count, false)
    {
        std::iota(parent.begin(), parent.end(), (size_t)0);
    }
    /* The root, and whether the cell is on the other side than the root. */
    std::pair<size_t, bool> find(size_t cell) const
    {
        bool other = false;
        for (; parent[cell] != cell; cell = parent[cell])
            other = other != differs[cell];
        return {cell, other};
    }
    void join(size_t a, size_t b, bool differ)
    {
        const auto [root_a, side_a] = find(a);
        const auto [root_b, side_b] = find(b);
        if (root_a == root_b)
            return;
        parent[root_a] = root_b;
        differs[root_a] = (side_a != side_b) != differ;
    }

  private:
    std::vector<size_t> parent;
    std::vector<bool> differs;
};

class Labelling
{
  public:
    Labelling(size_t count, const std::vector<Wall> &given,
        const std::vector<std::vector<size_t>> &around);
    void follow_walls();
    void settle();
    void mend_edges();

    std::vector<bool> inside;

  private:
    bool kept(const Wall &wall) const
    {
        return inside[wall.cells[0]] != inside[wall.cells[1]];
    }
    double price_of_flip(size_t cell) const;
    bool is_fault(const std::vector<size_t> &edge) const;
    int faults_at(size_t cell) const;
    int mended_by(size_t cell);
    size_t best_mender();

    const std::vector<Wall> &walls;
    const std::vector<std::vector<size_t>> &edges;
    std::vector<std::vector<size_t>> walls_of, edges_of; /* of each cell */
    double heaviest = 0.0;
};

Labelling::Labelling(
    size_t count, const std::vector<Wall> &given, const std::vector<std::vector<size_t>> &around)
    : inside(count, false), walls(given), edges(around), walls_of(count), edges_of(count)
{
    for (size_t i = 0; i < walls.size(); i++) {
        heaviest = std::max(heaviest, std::fabs(walls[i].weight));
        if (walls[i].cells[0] == walls[i].cells[1])
            continue;
        for (const size_t cell : walls[i].cells)
            walls_of[cell].push_back(i);
    }
    for (size_t e = 0; e < edges.size(); e++)
        for (const size_t wall : edges[e])
            for (const size_t cell : walls[wall].cells)
                if (edges_of[cell].empty() || edges_of[cell].back() != e)
                    edges_of[cell].push_back(e);
}

void Labelling::follow_walls()
{
    std::vector<size_t> order(walls.size());
    std::iota(order.begin(), order.end(), (size_t)0);
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
        return std::fabs(walls[a].weight) > std::fabs(walls[b].weight);
    });
    Parity sides(inside.size());
    for (const size_t i : order)
        sides.join(walls[i].cells[0], walls[i].cells[1], walls[i].weight > 0.0);
    const auto [outside, side] = sides.find(0);
    for (size_t cell = 0; cell < inside.size(); cell++) {
        const auto [root, other] = sides.find(cell);
        inside[cell] = root == outside && other != side;
    }
}

/* What the cost grows by when the cell changes sides. */
double Labelling::price_of_flip(size_t cell) const
{
    double price = 0.0;
    for (const size_t i : walls_of[cell])
        price += kept(walls[i]) ? walls[i].weight : -walls[i].weight;
    return price;
}

void Labelling::settle()
{
    bool changed = true;
    for (int round = 0; round < ROUNDS && changed; round++) {
        changed = false;
        for (size_t cell = 1; cell < inside.size(); cell++)
            if (price_of_flip(cell) < -LEAST_GAIN * heaviest) {
                inside[cell] = !inside[cell];
                changed = true;
            }
    }
}

bool Labelling::is_fault(const std::vector<size_t> &edge) const
{
    return std::count_if(edge.begin(), edge.end(), [&](size_t i) { return kept(walls[i]); }) > 2;
}

int Labelling::faults_at(size_t cell) const
{
    int faults = 0;
    for (const size_t e : edges_of[cell])
        faults += is_fault(edges[e]);
    return faults;
}

/* How many faults fewer there are once the cell has changed sides. */
int Labelling::mended_by(size_t cell)
{
    const int before = faults_at(cell);
    inside[cell] = !inside[cell];
    const int after = faults_at(cell);
    inside[cell] = !inside[cell];
    return before - after;
}

/* The cell beside a fault whose change of sides mends most cheaply; 0: none does. */
size_t Labelling::best_mender()
{
    std::vector<bool> asked(inside.size(), false);
    size_t best = 0;
    double least = INFINITY;
    for (const std::vector<size_t> &edge : edges) {
        if (!is_fault(edge))
            continue;
        for (const size_t wall : edge)
            for (const size_t cell : walls[wall].cells) {
                if (cell == 0 || asked[cell])
                    continue;
                asked[cell] = true;
                const double price = price_of_flip(cell);
                if (price < least && mended_by(cell) > 0) {
                    least = price;
                    best = cell;
                }
            }
    }
    return best;
}

void Labelling::mend_edges()
{
    for (int round = 0; round < ROUNDS; round++) {
        const size_t cell = best_mender();
        if (cell == 0)
            return;
        inside[cell] = !inside[cell];
    }
}

} // namespace

std::vector<bool> choose_cells(
    size_t count, const std::vector<Wall> &walls, const std::vector<std::vector<size_t>> &edges)
{
    Labelling labelling(count, walls, edges);
    labelling.follow_walls();
    labelling.settle();
    labelling.mend_edges();
    return labelling.inside;
}

} // namespace crease_cad
