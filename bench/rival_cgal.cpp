/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* usage: rival-cgal pca|jet K POINTS SCORES
 *        rival-cgal vcm OFFSET CONVOLUTION POINTS SCORES
 * Normal variation: normals by CGAL (planes or jets fitted to K neighbours), and how much they vary
 * among the K neighbours of a point: 1 less the largest eigenvalue of the mean of n n^T.
 * Voronoi covariance: CGAL's measure of an edge, the middle eigenvalue over the sum of all three;
 * OFFSET and CONVOLUTION are radii.
 *
 * Based on: Merigot, Ovsjanikov, Guibas. Voronoi-based curvature and feature estimation from point
 * clouds. 2011. */
#include "rival_cloud.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Search_traits_adapter.h>
#include <CGAL/jet_estimate_normals.h>
#include <CGAL/pca_estimate_normals.h>
#include <CGAL/property_map.h>
#include <CGAL/vcm_estimate_edges.h>
#include <Eigen/Eigenvalues>

#include <cstdlib>
#include <string>
#include <utility>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Oriented = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Place = CGAL::First_of_pair_property_map<Oriented>;
using Normal = CGAL::Second_of_pair_property_map<Oriented>;
using Index = std::size_t;

namespace
{

/* The place of a point by its number. */
struct Place_of {
    using key_type = Index;
    using value_type = Kernel::Point_3;
    using reference = const value_type &;
    using category = boost::lvalue_property_map_tag;
    const std::vector<Oriented> *points;
    reference operator[](Index i) const
    {
        return (*points)[i].first;
    }
    friend reference get(const Place_of &map, Index i)
    {
        return map[i];
    }
};

using Traits = CGAL::Search_traits_adapter<Index, Place_of, CGAL::Search_traits_3<Kernel>>;
using Search = CGAL::Orthogonal_k_neighbor_search<Traits>;

std::vector<double> normal_variation(const std::vector<Oriented> &points, unsigned k)
{
    const Place_of map{&points};
    Search::Tree tree(boost::counting_iterator<Index>(0),
        boost::counting_iterator<Index>(points.size()), Search::Splitter(), Traits(map));
    std::vector<double> scores;
    for (const Oriented &point : points) {
        Search search(tree, point.first, k, 0, true, Search::Distance(map));
        Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
        for (const auto &found : search) {
            const Kernel::Vector_3 &n = points[found.first].second;
            const Eigen::Vector3d v(n.x(), n.y(), n.z());
            sum += v * v.transpose() / k;
        }
        scores.push_back(
            1 - Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(sum, 0).eigenvalues()[2]);
    }
    return scores;
}

std::vector<double> voronoi_covariance(
    const std::vector<Oriented> &points, double offset, double convolution)
{
    using Covariance = std::array<double, 6>;
    std::vector<Covariance> covariances;
    CGAL::compute_vcm(points, covariances, offset, convolution,
        CGAL::parameters::point_map(Place()).geom_traits(Kernel()));
    std::vector<double> scores;
    for (const Covariance &covariance : covariances) {
        std::array<double, 3> values = {0, 0, 0};
        CGAL::Default_diagonalize_traits<double, 3>::diagonalize_selfadjoint_covariance_matrix(
            covariance, values);
        const double sum = values[0] + values[1] + values[2];
        scores.push_back(sum > 0 ? values[1] / sum : 0);
    }
    return scores;
}

} // namespace

int main(int count, char **arguments)
{
    const std::string method = count > 1 ? arguments[1] : "";
    if (count != (method == "vcm" ? 6 : 5))
        return 2;
    std::vector<Oriented> points;
    for (const rival::Point &p : rival::read_points(arguments[count - 2]))
        points.emplace_back(Kernel::Point_3(p[0], p[1], p[2]), Kernel::Vector_3(0, 0, 0));
    const unsigned k = (unsigned)std::atoi(arguments[2]);
    const auto maps = CGAL::parameters::point_map(Place()).normal_map(Normal());
    std::vector<double> scores;
    if (method == "vcm")
        scores = voronoi_covariance(points, std::atof(arguments[2]), std::atof(arguments[3]));
    else if (method == "jet")
        CGAL::jet_estimate_normals<CGAL::Sequential_tag>(points, k, maps);
    else
        CGAL::pca_estimate_normals<CGAL::Sequential_tag>(points, k, maps);
    if (method != "vcm")
        scores = normal_variation(points, k);
    return rival::write_scores(arguments[count - 1], scores) ? 0 : 1;
}
