/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Points nearer than a distance are one vertex: the first that came. */
#ifndef CREASE_CAD_VERTICES_HPP
#define CREASE_CAD_VERTICES_HPP

#include <gp_XYZ.hxx>

#include <cstdint>
#include <map>
#include <vector>

namespace crease_cad
{

class Vertices
{
  public:
    static constexpr size_t NONE = SIZE_MAX;

    Vertices(std::vector<gp_XYZ> &all, double distance) : places(all), within(distance) {}

    /* The vertex at the point, or NONE. */
    size_t find(const gp_XYZ &point) const
    {
        const auto end = by_x.upper_bound(point.X() + within);
        for (auto it = by_x.lower_bound(point.X() - within); it != end; ++it)
            if ((places[it->second] - point).Modulus() <= within)
                return it->second;
        return NONE;
    }

    size_t find_or_add(const gp_XYZ &point)
    {
        const size_t found = find(point);
        if (found != NONE)
            return found;
        by_x.emplace(point.X(), places.size());
        places.push_back(point);
        return places.size() - 1;
    }

  private:
    std::vector<gp_XYZ> &places;
    double within;
    std::multimap<double, size_t> by_x;
};

} // namespace crease_cad

#endif
