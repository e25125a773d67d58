/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "cad/judge.hpp"

#include "cad/kernel.hpp"
#include "topology/complete.h"

#include <algorithm>
#include <cmath>

namespace crease_cad
{

static constexpr double OFF_SIGMAS = 4.0, OFF_SPACINGS = 0.25; /* farther points are not on it */
static constexpr double MOST_LOSS = 0.1;                       /* of what is taken for the part */
static constexpr double MOST_SHELL_LOSS = 0.3;   /* of the shell of points that end at a border */
static constexpr double MOST_PIECES_LOSS = 0.04; /* of several shells, worth more than faces */

static void project(crease_context *context, const crease_cloud *cloud, Judged &out)
{
    const Triangles &from = out.outcome.triangles;
    const crease_mesh_parts parts = {from.vertices.size() / 3, from.owners.size(),
        from.vertices.data(), from.triangles.data(), from.owners.data()};
    crease_mesh *mesh = nullptr;
    require(crease_mesh_from_parts(context, &parts, &mesh));
    out.mesh.reset(mesh);
    const size_t count = crease_cloud_count(cloud);
    std::vector<crease_mesh_foot> feet(count);
    require(crease_mesh_project(context, mesh, crease_cloud_points(cloud), count, feet.data()));
    for (const crease_mesh_foot &foot : feet) {
        out.deviations.push_back(foot.distance);
        out.nearest.push_back((int32_t)from.owners[foot.triangle]);
    }
}

static double off_distance(const Job &job)
{
    return (OFF_SIGMAS * job.sigma + OFF_SPACINGS * job.spacing) / job.scale();
}

static size_t lost_of(const Job &job, const Judged &judged)
{
    const int32_t *const labels = crease_regions_labels(job.regions);
    const double off = off_distance(job);
    std::vector<size_t> all(crease_regions_count(job.regions), 0), on(all);
    for (size_t i = 0; i < judged.deviations.size(); i++)
        if (labels[i] >= 0) {
            all[(size_t)labels[i]]++;
            on[(size_t)labels[i]] += std::fabs(judged.deviations[i]) <= off;
        }
    size_t lost = 0;
    for (size_t r = 0; r < on.size(); r++)
        lost += 2 * on[r] < all[r];
    return lost;
}

/* Whether a face is one that no point is known to show. */
static bool is_unseen(const Job &job, const FaceFact &face)
{
    const size_t count = crease_regions_count(job.regions);
    return job.carriers[face.carrier].region >= count - crease_regions_unseen(job.regions);
}

/* A face half covered is taken for covered: scans have shadows. */
static double loss_of(const Job &job, const Judged &judged)
{
    const int32_t *const labels = crease_regions_labels(job.regions);
    const double off = off_distance(job);
    std::vector<double> support(judged.outcome.faces.size(), 0.0);
    double total = 0.0, missed = 0.0, bare = 0.0;
    for (size_t i = 0; i < judged.deviations.size(); i++) {
        if (labels[i] < 0)
            continue;
        const double area = job.area_of_point(i);
        total += area;
        if (std::fabs(judged.deviations[i]) > off)
            missed += area;
        else
            support[(size_t)judged.nearest[i]] += area;
    }
    for (size_t f = 0; f < support.size(); f++)
        if (!is_unseen(job, judged.outcome.faces[f]))
            bare += std::max(0.0, judged.outcome.faces[f].area - 2.0 * support[f]);
    return (missed + bare) / total;
}

static crease_part_state state_of(const Summary &summary)
{
    if (summary.valid && summary.volume > 0.0)
        return CREASE_PART_SOLID;
    return summary.valid && summary.together ? CREASE_PART_SHELL : CREASE_PART_FACES;
}

Judged judge(crease_context *context, const crease_cloud *cloud, const Job &job, Outcome &&outcome)
{
    Judged out = {};
    out.outcome = std::move(outcome);
    out.state = state_of(out.outcome.summary);
    project(context, cloud, out);
    out.loss = loss_of(job, out);
    out.lost = lost_of(job, out);
    out.bears = out.loss < (job.bordered ? MOST_SHELL_LOSS : MOST_LOSS);
    return out;
}

bool is_true_solid(const Judged &judged)
{
    return judged.state == CREASE_PART_SOLID && judged.loss < MOST_LOSS;
}

bool shares_edges(const Judged &judged)
{
    const std::vector<EdgeFact> &edges = judged.outcome.edges;
    return std::any_of(edges.begin(), edges.end(), [](const EdgeFact &edge) {
        return edge.faces[1] != UINT32_MAX && edge.faces[1] != edge.faces[0];
    });
}

/* A closed solid that the points contradict is worse than faces side by side: it looks finished. */
static int rank(const Judged &judged)
{
    if (is_true_solid(judged))
        return judged.lost == 0 ? 4 : 3;
    if (judged.state == CREASE_PART_SOLID)
        return -1;
    if (judged.state == CREASE_PART_SHELL && judged.bears)
        return 2;
    return judged.outcome.summary.valid && judged.loss < MOST_PIECES_LOSS && shares_edges(judged);
}

bool is_better(const Judged &a, const Judged &b)
{
    return rank(a) != rank(b) ? rank(a) > rank(b) : a.loss < b.loss;
}

static crease_part_face describe(std::vector<double> &deviations)
{
    crease_part_face face = {};
    face.point_count = deviations.size();
    if (deviations.empty())
        return face;
    double sum = 0.0, squares = 0.0;
    for (double &d : deviations) {
        sum += d;
        squares += d * d;
        d = std::fabs(d);
    }
    const double count = (double)deviations.size();
    face.mean = sum / count;
    face.rms = std::sqrt(squares / count);
    face.most = *std::max_element(deviations.begin(), deviations.end());
    const auto p95 = deviations.begin() + (std::ptrdiff_t)(0.95 * (count - 1.0));
    std::nth_element(deviations.begin(), p95, deviations.end());
    face.p95 = *p95;
    return face;
}

std::vector<crease_part_face> describe_faces(const Job &job, const Judged &judged)
{
    const int32_t *const labels = crease_regions_labels(job.regions);
    const std::vector<FaceFact> &facts = judged.outcome.faces;
    std::vector<std::vector<double>> of(facts.size());
    for (size_t i = 0; i < judged.deviations.size(); i++)
        if (labels[i] >= 0)
            of[(size_t)judged.nearest[i]].push_back(judged.deviations[i]);
    std::vector<crease_part_face> faces;
    for (size_t f = 0; f < facts.size(); f++) {
        faces.push_back(describe(of[f]));
        faces.back().region = job.carriers[facts[f].carrier].region;
        faces.back().area = facts[f].area;
    }
    return faces;
}

} // namespace crease_cad
