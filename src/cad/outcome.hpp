/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What an attempt came to, with everything about it that OpenCASCADE is needed for, so that it can
 * be made in a process of its own and sent as bytes. Lengths in the unit of the cloud. */
#ifndef CREASE_CAD_OUTCOME_HPP
#define CREASE_CAD_OUTCOME_HPP

#include "cad/job.hpp"
#include "cad/tessellate.hpp"

namespace crease_cad
{

/* Within which a model is triangulated to measure it, of the diagonal. */
constexpr double MESH_TOLERANCE = 1e-4;

/* These go from process to process byte by byte, so that there are no gaps between their members.
 */
struct FaceFact {
    uint64_t carrier;
    double area;
};

struct EdgeFact {
    uint32_t faces[2];   /* see crease_part_edge */
    uint32_t smooth;     /* 1 or 0 */
    uint32_t pole_count; /* of its curve */
    double length, angle;
};

struct Summary {
    uint32_t valid;    /* 1: OpenCASCADE finds no fault */
    uint32_t closed;   /* 1: every edge has two faces */
    uint32_t together; /* 1: one set of faces connected by edges */
    uint32_t solids;   /* 0 unless all faces close */
    double volume;     /* of these */
};

struct Outcome {
    Summary summary;
    std::string why;
    std::vector<char> shape; /* in OpenCASCADE's binary form */
    Triangles triangles;
    std::vector<FaceFact> faces;
    std::vector<EdgeFact> edges;
    std::vector<double> poles, knots; /* of the edges' cubic curves, one after the other: 3 for each
                                         pole, and poles + 4 knots */
};

/* Measures what the way made. Throws Failure when that has no faces. */
Outcome measure(const Job &job, const Attempt &attempt, bool as_bsplines);

std::vector<char> pack(const Outcome &outcome);
Outcome unpack(const std::vector<char> &bytes);

/* The shape in the bytes of an outcome. */
TopoDS_Shape shape_from(const std::vector<char> &bytes);

} // namespace crease_cad

#endif
