/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What a part is built from, in the way that suits OpenCASCADE: its tolerances are lengths, so the
 * cloud is moved to the origin and scaled by a power of two until its diagonal is 8 to 16. All
 * lengths here and in the files that build on this are in that frame. */
#ifndef CREASE_CAD_JOB_HPP
#define CREASE_CAD_JOB_HPP

#include "cad/sheet.hpp"
#include "crease/crease_cad.h"
#include "topology/assembly.h"
#include "topology/carriers.h"

#include <TopoDS_Shape.hxx>
#include <gp_Ax3.hxx>
#include <gp_Pnt.hxx>
#include <gp_Trsf.hxx>

#include <memory>
#include <string>
#include <vector>

namespace crease_cad
{

/* A surface that faces may lie on, and its points. */
struct Carrier {
    crease_region_type type;
    gp_Ax3 frame; /* see crease_carrier */
    double radius, shape;
    bool round, ball;
    int spans;
    uint32_t region, number; /* number: in Job::carriers, and of the crease_carrier */
    std::vector<gp_Pnt> points;
    std::vector<double> areas; /* that the points stand for */
    double area;               /* their sum */
};

class Job
{
  public:
    /* Throws Failure. */
    Job(crease_context *context, const crease_cloud *cloud, const crease_regions *regions,
        const crease_network *network, bool bordered);

    /* Signed distance of a place from a carrier's surface. */
    double distance(const Carrier &carrier, const gp_Pnt &place) const;
    /* Height of a free form over the plane of its frame; of a round one, its distance from the axis
     * at the angle x and the height y; of a ball, that from its centre. */
    double height(const Carrier &carrier, double x, double y) const;
    /* Area that a point of the cloud stands for, in the cloud's unit. */
    double area_of_point(size_t index) const;
    /* Lengths here per length of the cloud. */
    double scale() const;

    std::vector<Carrier> carriers;
    double spacing, sigma, diagonal;
    bool bordered;   /* see crease_topology_find() */
    gp_Trsf outward; /* from this frame to that of the cloud */
    const crease_regions *regions;
    const crease_network *network;
    Scaling inwards() const; /* from the cloud's frame to this one */
    const crease_topology &topology() const;

  private:
    void set_frame(const crease_cloud *cloud);
    void take_carriers();
    void take_points(const crease_cloud *cloud);
    gp_Pnt inward(const double place[3]) const;

    struct Free {
        void operator()(crease_carriers *gone) const
        {
            crease_carriers_free(gone);
        }
    };
    struct TopologyFree {
        void operator()(crease_topology *given) const
        {
            crease_topology_free(given);
        }
    };
    std::unique_ptr<crease_carriers, Free> found;
    std::unique_ptr<crease_topology, TopologyFree> shown; /* by the points */
    gp_XYZ centre;
    double factor; /* see scale() */
};

/* What a way of building came to. */
struct Attempt {
    TopoDS_Shape shape; /* null when nothing came out of it */
    std::string why;    /* it is not what it should be; empty when nothing is known to be wrong */
};

/* A way of building a part. Works in a process of its own; may throw. */
using Way = Attempt (*)(const Job &job, double margin);

} // namespace crease_cad

#endif
