/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The surface of a face: a chart and the same in OpenCASCADE's words, parameters included. */
#ifndef CREASE_CAD_SHEET_HPP
#define CREASE_CAD_SHEET_HPP

#include "topology/chart.h"

#include <Geom_Surface.hxx>
#include <gp_Ax3.hxx>
#include <gp_XY.hxx>
#include <gp_XYZ.hxx>

#include <vector>

namespace crease_cad
{

/* From the cloud's frame to one in which OpenCASCADE's tolerances make sense. */
struct Scaling {
    gp_XYZ origin;
    double factor;

    gp_XYZ operator()(const double place[3]) const
    {
        return (gp_XYZ(place[0], place[1], place[2]) - origin) * factor;
    }
};

class Sheet
{
  public:
    Sheet(const crease_chart &chart, const Scaling &scaling);

    crease_region_type type() const
    {
        return chart.type;
    }
    bool turns(int direction) const
    {
        return crease_chart_turns(&chart, direction);
    }
    gp_XY at(const gp_XYZ &place) const;
    /* Of consecutive places: turning parameters go on. */
    std::vector<gp_XY> along(const std::vector<gp_XYZ> &places) const;
    gp_Ax3 frame() const;
    double radius() const
    {
        return chart.radius;
    }
    double half_angle() const; /* of a cone */

    Handle(Geom_Surface) surface;

  private:
    void interpolate(const crease_chart &from, double factor);

    crease_chart chart; /* without heights */
};

} // namespace crease_cad

#endif
