/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "peer.h"

#include <nanoflann.hpp>
#include <vector>

namespace
{
struct Points {
    const double *points;
    size_t count;
    size_t kdtree_get_point_count() const
    {
        return count;
    }
    double kdtree_get_pt(size_t i, size_t axis) const
    {
        return points[3 * i + axis];
    }
    template <class Box> bool kdtree_get_bbox(Box &) const
    {
        return false;
    }
};
using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Points>,
    Points, 3, uint32_t>;
} // namespace

void peer_nanoflann(const double *points, size_t count, size_t k, uint32_t *indices)
{
    const Points adaptor{points, count};
    const Tree tree(3, adaptor, nanoflann::KDTreeSingleIndexAdaptorParams(10));
    std::vector<double> distances(k);
    for (size_t i = 0; i < count; i++)
        tree.knnSearch(points + 3 * i, k, indices + i * k, distances.data());
}
