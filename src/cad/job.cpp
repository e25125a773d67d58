/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "cad/job.hpp"

#include "cad/kernel.hpp"

#include <algorithm>
#include <cmath>

namespace crease_cad
{

static constexpr int DIAGONAL_EXPONENT = 4; /* diagonals are 2^3 to 2^4 */

static gp_Pnt place_of(const double place[3])
{
    return gp_Pnt(place[0], place[1], place[2]);
}

Job::Job(crease_context *context, const crease_cloud *cloud, const crease_regions *given,
    const crease_network *creases, bool is_bordered)
    : bordered(is_bordered), regions(given), network(creases)
{
    crease_carriers *raw = nullptr;
    require(crease_carriers_find(context, regions, &raw));
    found.reset(raw);
    crease_topology *raw_topology = nullptr;
    require(crease_topology_find(context, regions, bordered, &raw_topology));
    shown.reset(raw_topology);
    set_frame(cloud);
    take_carriers();
    take_points(cloud);
}

/* Outliers, which have no region, may be anywhere: they do not count. */
void Job::set_frame(const crease_cloud *cloud)
{
    const int32_t *const labels = crease_regions_labels(regions);
    const double *place = crease_cloud_points(cloud);
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < crease_cloud_count(cloud); i++, place += 3)
        for (int c = 0; c < 3 && labels[i] >= 0; c++) {
            low[c] = std::min(low[c], place[c]);
            high[c] = std::max(high[c], place[c]);
        }
    const double extent = place_of(low).Distance(place_of(high));
    if (!(extent > 0.0 && extent < HUGE_VAL))
        throw Failure{
            CREASE_ERROR_NUMERIC, "no point lies on a smooth region; give a cloud of a surface"};
    int exponent = 0;
    std::frexp(extent, &exponent);
    factor = std::ldexp(1.0, DIAGONAL_EXPONENT - exponent);
    centre = (place_of(low).XYZ() + place_of(high).XYZ()) / 2.0;
    diagonal = extent * factor;
    spacing = crease_regions_spacing(regions) * factor;
    sigma = crease_regions_sigma(regions) * factor;
    outward.SetScale(gp_Pnt(), 1.0 / factor);
    gp_Trsf move;
    move.SetTranslation(gp_Vec(centre));
    outward = move * outward;
}

void Job::take_carriers()
{
    for (size_t i = 0; i < crease_carriers_count(found.get()); i++) {
        const crease_carrier from = crease_carriers_at(found.get(), i);
        const double *const x = from.axes, *const z = x + 6;
        Carrier to = {};
        to.type = from.type;
        to.frame = gp_Ax3(inward(from.centre), gp_Dir(z[0], z[1], z[2]), gp_Dir(x[0], x[1], x[2]));
        to.radius = from.radius * factor;
        to.shape = from.type == CREASE_REGION_TORUS ? from.shape * factor : from.shape;
        to.round = from.round;
        to.ball = from.ball;
        to.spans = from.spans;
        to.region = from.region;
        to.number = (uint32_t)i;
        carriers.push_back(to);
    }
}

void Job::take_points(const crease_cloud *cloud)
{
    const int32_t *const labels = crease_regions_labels(regions);
    const uint32_t *const of_region = crease_carriers_of_regions(found.get());
    const double *const areas = crease_carriers_areas(found.get());
    for (size_t i = 0; i < crease_cloud_count(cloud); i++) {
        if (labels[i] < 0)
            continue;
        Carrier &carrier = carriers[of_region[labels[i]]];
        carrier.points.push_back(inward(crease_cloud_points(cloud) + 3 * i));
        carrier.areas.push_back(areas[i] * factor * factor);
        carrier.area += carrier.areas.back();
    }
}

gp_Pnt Job::inward(const double place[3]) const
{
    return gp_Pnt((place_of(place).XYZ() - centre) * factor);
}

double Job::distance(const Carrier &carrier, const gp_Pnt &place) const
{
    const gp_XYZ outside = place.XYZ() / factor + centre;
    const double there[3] = {outside.X(), outside.Y(), outside.Z()};
    double gradient[3];
    return crease_carriers_distance(found.get(), carrier.number, there, gradient) * factor;
}

double Job::height(const Carrier &carrier, double x, double y) const
{
    const double u = carrier.round || carrier.ball ? x : x / factor;
    const double v = carrier.ball ? y : y / factor;
    return crease_carriers_height(found.get(), carrier.number, u, v) * factor;
}

double Job::area_of_point(size_t index) const
{
    return crease_carriers_areas(found.get())[index];
}

Scaling Job::inwards() const
{
    return {centre, factor};
}

const crease_topology &Job::topology() const
{
    return *shown;
}

double Job::scale() const
{
    return factor;
}

} // namespace crease_cad
