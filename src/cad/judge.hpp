/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* How well an outcome agrees with the points: a shape can be valid and still be another one. */
#ifndef CREASE_CAD_JUDGE_HPP
#define CREASE_CAD_JUDGE_HPP

#include "cad/outcome.hpp"

#include <memory>

namespace crease_cad
{

struct MeshFree {
    void operator()(crease_mesh *mesh) const
    {
        crease_mesh_free(mesh);
    }
};

struct Judged {
    Outcome outcome;
    crease_part_state state;
    double loss; /* area that the points stand for and that is not on the shape, plus area of the
                    shape without points, over the area that all points stand for */
    bool bears;  /* loses no more than a shell may */
    size_t lost; /* regions most of whose points are not on the shape */
    std::unique_ptr<crease_mesh, MeshFree> mesh;
    std::vector<double> deviations; /* of all points, signed */
    std::vector<int32_t> nearest;   /* face of each point */
};

/* Throws Failure. */
Judged judge(crease_context *context, const crease_cloud *cloud, const Job &job, Outcome &&outcome);

/* Whether the solid is what the points say. */
bool is_true_solid(const Judged &judged);
/* Whether any two faces share an edge. */
bool shares_edges(const Judged &judged);
/* Whether a is more worth than b: state first, then regions lost or not, then loss. */
bool is_better(const Judged &a, const Judged &b);

/* Statistics of the faces. */
std::vector<crease_part_face> describe_faces(const Job &job, const Judged &judged);

} // namespace crease_cad

#endif
