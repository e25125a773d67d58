/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "cad/naming.hpp"

#include <algorithm>
#include <cmath>

namespace crease_cad
{

static constexpr size_t MOST_PLACES = 64; /* of a face that are looked at */

/* Corners and middles of triangles, evenly chosen: corners alone may all lie on the border. */
static std::vector<gp_Pnt> places_on(const Triangles &triangles, const std::vector<size_t> &mine)
{
    std::vector<gp_Pnt> places;
    const size_t step = 1 + mine.size() / MOST_PLACES;
    for (size_t k = 0; k < mine.size(); k += step) {
        gp_XYZ middle;
        for (size_t c = 0; c < 3; c++) {
            const double *const at =
                triangles.vertices.data() + 3 * (size_t)triangles.triangles[3 * mine[k] + c];
            middle += gp_XYZ(at[0], at[1], at[2]) / 3.0;
            places.emplace_back(at[0], at[1], at[2]);
        }
        places.emplace_back(middle);
    }
    return places;
}

static uint32_t nearest_carrier(const Job &job, const std::vector<gp_Pnt> &places)
{
    uint32_t best = 0;
    double least = INFINITY;
    for (const Carrier &carrier : job.carriers) {
        double sum = 0.0;
        for (const gp_Pnt &place : places)
            sum += std::fabs(job.distance(carrier, place));
        if (sum < least) {
            least = sum;
            best = carrier.number;
        }
    }
    return best;
}

std::vector<uint32_t> carriers_of_faces(
    const Job &job, const Triangles &triangles, size_t face_count)
{
    std::vector<std::vector<size_t>> mine(face_count);
    for (size_t t = 0; t < triangles.owners.size(); t++)
        mine[triangles.owners[t]].push_back(t);
    std::vector<uint32_t> carriers;
    for (const std::vector<size_t> &some : mine)
        carriers.push_back(nearest_carrier(job, places_on(triangles, some)));
    return carriers;
}

} // namespace crease_cad
