/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Parts: what came out best of the search, and its description. */
#include "cad/format.hpp"
#include "cad/kernel.hpp"
#include "cad/search.hpp"
#include "topology/complete.h"

#include <algorithm>
#include <memory>

struct crease_part {
    ~crease_part();

    crease_cad::Judged judged;
    std::string message;
    std::vector<crease_part_face> faces;
    std::vector<crease_part_edge> edges;
    std::vector<crease_curve *> curves;
    const crease_regions *regions;
    std::unique_ptr<crease_regions, crease_cad::RegionsFree> own; /* where regions are these */
};

crease_part::~crease_part()
{
    for (crease_curve *const curve : curves)
        crease_curve_free(curve);
}

namespace crease_cad
{

static std::string free_edges_of(const Outcome &outcome)
{
    const auto is_free = [](const EdgeFact &edge) { return edge.faces[1] == UINT32_MAX; };
    const auto count = std::count_if(outcome.edges.begin(), outcome.edges.end(), is_free);
    return std::to_string(count) + (count == 1 ? " free edge" : " free edges");
}

static std::string lost_sentence(const Judged &best)
{
    return "most points of " + std::to_string(best.lost) +
        (best.lost == 1 ? " smooth region are" : " smooth regions are") +
        " not on the solid: look at the deviations";
}

static std::string message_of(const Search &search)
{
    const Judged &best = *search.best;
    if (is_true_solid(best))
        return best.lost == 0 ? best.outcome.why : lost_sentence(best);
    const std::string faces = std::to_string(best.outcome.faces.size()) +
        (best.outcome.faces.size() == 1 ? " face" : " faces");
    const std::string what = best.state == CREASE_PART_SHELL
        ? "an open shell of " + faces + " with " + free_edges_of(best.outcome)
        : faces + (shares_edges(best) ? " with " + free_edges_of(best.outcome) : " side by side");
    if (search.given.bordered)
        return best.outcome.why.empty() ? what : what + ": " + best.outcome.why;
    return what + ", no solid: " + search.why_no_solid;
}

/* An open shell has no material: the smaller angle. */
static double angle_of(const EdgeFact &fact, bool solid)
{
    return solid ? fact.angle : std::min(fact.angle, 360.0 - fact.angle);
}

static void add_edges(crease_context *context, const Judged &best, crease_part &part)
{
    const Outcome &outcome = best.outcome;
    const bool solid = is_true_solid(best);
    const double *knots = outcome.knots.data(), *poles = outcome.poles.data();
    for (const EdgeFact &fact : outcome.edges) {
        part.edges.push_back(
            {{fact.faces[0], fact.faces[1]}, fact.smooth != 0, fact.length, angle_of(fact, solid)});
        part.curves.push_back(nullptr);
        require(
            crease_curve_create(context, 4, fact.pole_count, knots, poles, &part.curves.back()));
        knots += fact.pole_count + 4;
        poles += 3 * (size_t)fact.pole_count;
    }
}

static std::unique_ptr<crease_part> part_of(Search &search)
{
    auto part = std::make_unique<crease_part>();
    part->message = message_of(search);
    part->faces = describe_faces(*search.job, *search.best);
    add_edges(search.context, *search.best, *part);
    part->judged = std::move(*search.best);
    part->regions = search.job->regions;
    if (search.job == search.coarser.get())
        part->own = std::move(search.coarser_regions);
    if (search.job == search.complete.get())
        part->own = std::move(search.complete_regions);
    if (!is_true_solid(part->judged)) {
        part->judged.outcome.summary.volume = 0.0;
        part->judged.outcome.summary.solids = 0;
        if (part->judged.state == CREASE_PART_SOLID)
            part->judged.state = CREASE_PART_FACES;
    }
    return part;
}

static void check(const crease_cloud *cloud, const crease_regions *regions)
{
    const size_t points = crease_cloud_count(cloud);
    if (crease_regions_point_count(regions) != points)
        throw Failure{CREASE_ERROR_ARGUMENT,
            "the cloud has " + std::to_string(points) + " points, its regions have " +
                std::to_string(crease_regions_point_count(regions)) +
                "; find the regions of this cloud"};
}

} // namespace crease_cad

using namespace crease_cad;

crease_part_options crease_part_options_default(void)
{
    return {};
}

crease_status crease_part_build(crease_context *context, const crease_cloud *cloud,
    const crease_regions *regions, const crease_network *network,
    const crease_part_options *options, crease_part **out)
{
    *out = nullptr;
    return guard(context, "part", [&] {
        check(cloud, regions);
        const Job job(context, cloud, regions, network, options && options->open);
        Search search = {context, cloud, job, options && options->bspline_faces, {}, {}, {}, {},
            nullptr, {}, "", false, false, 0.0};
        search_best(search);
        *out = part_of(search).release();
    });
}

void crease_part_free(crease_part *part)
{
    delete part;
}

crease_part_state crease_part_state_of(const crease_part *part)
{
    return part->judged.state;
}

const char *crease_part_message(const crease_part *part)
{
    return part->message.c_str();
}

size_t crease_part_solid_count(const crease_part *part)
{
    return part->judged.outcome.summary.solids;
}

double crease_part_volume(const crease_part *part)
{
    return part->judged.outcome.summary.volume;
}

const crease_regions *crease_part_regions(const crease_part *part)
{
    return part->regions;
}

size_t crease_part_unseen_count(const crease_part *part)
{
    return crease_regions_unseen(part->regions);
}

size_t crease_part_face_count(const crease_part *part)
{
    return part->faces.size();
}

crease_part_face crease_part_face_at(const crease_part *part, size_t index)
{
    return part->faces[index];
}

size_t crease_part_edge_count(const crease_part *part)
{
    return part->edges.size();
}

crease_part_edge crease_part_edge_at(const crease_part *part, size_t index)
{
    return part->edges[index];
}

const crease_curve *const *crease_part_curves(const crease_part *part)
{
    return part->curves.data();
}

const crease_mesh *crease_part_mesh(const crease_part *part)
{
    return part->judged.mesh.get();
}

const double *crease_part_deviations(const crease_part *part)
{
    return part->judged.deviations.data();
}

const int32_t *crease_part_nearest_faces(const crease_part *part)
{
    return part->judged.nearest.data();
}

crease_status crease_part_write(crease_context *context, const crease_part *part, const char *path)
{
    return guard(context, path, [&] {
        const Format format = format_of(path);
        const std::string text = text_of(shape_from(part->judged.outcome.shape), format, path);
        require(crease_file_write(context, path, text.data(), text.size()));
    });
}
