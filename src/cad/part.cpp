/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Parts: the ways of building one are tried in turn until one gives a solid that the points lie on;
 * failing that, the best of what came out is taken. */
#include "cad/apart.hpp"
#include "cad/effort.hpp"
#include "cad/format.hpp"
#include "cad/judge.hpp"
#include "cad/kernel.hpp"
#include "cad/ways.hpp"
#include "segment/coarser.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

namespace crease_cad
{

struct RegionsFree {
    void operator()(crease_regions *regions) const
    {
        crease_regions_free(regions);
    }
};

} // namespace crease_cad

struct crease_part {
    ~crease_part();

    crease_cad::Judged judged;
    std::string message;
    std::vector<crease_part_face> faces;
    std::vector<crease_part_edge> edges;
    std::vector<crease_curve *> curves;
    const crease_regions *regions;
    std::unique_ptr<crease_regions, crease_cad::RegionsFree> coarser; /* where regions are these */
};

crease_part::~crease_part()
{
    for (crease_curve *const curve : curves)
        crease_curve_free(curve);
}

namespace crease_cad
{

/* Seconds of the processor after which an attempt hangs; work is limited by Effort. */
static constexpr unsigned HUNG = 30;
static constexpr double GOOD_LOSS = 0.04; /* of a result: no other way is tried */

/* A way with its margin: the larger of a part of the diagonal and some spacings. */
struct Step {
    Way way;
    double diagonals, spacings;
    bool for_solid;
    bool for_open; /* it is tried when the points end at a border */
    bool coarser;  /* with regions united that join smoothly; tried when nothing closed before */
};

static constexpr Step steps[] = {
    {follow_topology, 0.0, 0.0, true, true, false},
    {follow_topology, 0.0, 0.0, true, false, true},
    {arrange_solid, 0.03, 1.8, true, false, false},
    {arrange_solid, 0.06, 3.6, true, false, false},
    {arrange_solid, 0.12, 7.2, true, false, false},
    {arrange_solid, 0.3, 18.0, true, false, false},
    {arrange_shells, 0.03, 3.0, false, true, false},
    {lay_out_faces, 0.0, 0.0, false, true, false},
};

/* The search for the best outcome. */
struct Search {
    crease_context *context;
    const crease_cloud *cloud;
    const Job &given;
    bool as_bsplines;
    std::unique_ptr<crease_regions, RegionsFree> coarser_regions;
    std::unique_ptr<const Job> coarser; /* with these */
    const Job *job;                     /* of the best */
    std::optional<Judged> best;
    std::string why_no_solid;
    bool spent; /* an arrangement was too much work; with a larger margin it is even more */
};

static constexpr const char *HANGS = "OpenCASCADE takes too long to intersect the surfaces";
static constexpr Bounds bounds = {
    HUNG, HANGS, "OpenCASCADE broke down over the surfaces", "cancelled before it was built"};

/* What a failed attempt means for the search: cancelling and lack of memory end it. */
static void note(Search &search, const Failure &failure)
{
    if (failure.status == CREASE_ERROR_CANCELLED || failure.status == CREASE_ERROR_NO_MEMORY)
        throw failure;
    search.spent = search.spent || failure.sentence == TOO_MUCH_WORK || failure.sentence == HANGS;
    if (search.why_no_solid.empty())
        search.why_no_solid = failure.sentence;
}

static std::string why_not(const Judged &judged)
{
    const Summary &summary = judged.outcome.summary;
    if (!summary.closed)
        return "the faces do not close";
    if (!summary.valid)
        return "OpenCASCADE finds fault with the closed shell";
    return "the closed shell leaves points or bears faces without points";
}

/* Null when the given regions are no finer. */
static const Job *coarser_job(Search &search)
{
    if (search.coarser)
        return search.coarser.get();
    crease_regions *found = nullptr;
    require(
        crease_regions_find_coarser(search.context, search.cloud, search.given.regions, &found));
    search.coarser_regions.reset(found);
    if (found && crease_regions_count(found) < crease_regions_count(search.given.regions))
        search.coarser = std::make_unique<const Job>(
            search.context, search.cloud, found, nullptr, search.given.bordered);
    return search.coarser.get();
}

static void attempt(Search &search, const Step &step, const Job &job)
{
    const double margin = std::max(step.diagonals * job.diagonal, step.spacings * job.spacing);
    std::vector<char> bytes;
    try {
        bytes = run_apart(
            [&] { return pack(measure(job, step.way(job, margin), search.as_bsplines)); }, bounds);
    } catch (const Failure &failure) {
        note(search, failure);
        return;
    }
    Judged judged = judge(search.context, search.cloud, job, unpack(bytes));
    if (step.for_solid && !is_true_solid(judged) && search.why_no_solid.empty())
        search.why_no_solid = why_not(judged);
    if (!search.best || is_better(judged, *search.best)) {
        search.best = std::move(judged);
        search.job = &job;
    }
}

static bool is_enough(const Search &search, const Step &next)
{
    if (search.best && search.given.bordered)
        return search.best->state == CREASE_PART_SHELL && search.best->loss < GOOD_LOSS;
    if (!search.best || !is_true_solid(*search.best))
        return false;
    return !next.for_solid || (search.best->loss < GOOD_LOSS && search.best->lost == 0);
}

static void search_best(Search &search)
{
    for (const Step &step : steps) {
        if (is_enough(search, step))
            break;
        if (search.given.bordered && !step.for_open)
            continue;
        if (search.spent && step.way == arrange_solid)
            continue;
        if (step.coarser && search.best && is_true_solid(*search.best))
            continue;
        if (!step.for_solid && search.best && search.best->state == CREASE_PART_SHELL &&
            search.best->loss < GOOD_LOSS)
            break;
        if (const Job *const job = step.coarser ? coarser_job(search) : &search.given)
            attempt(search, step, *job);
    }
    if (!search.best)
        throw Failure{CREASE_ERROR_NUMERIC, search.why_no_solid};
}

/* ---------------------------------------------------------------------------------- the part -- */

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
            {{fact.faces[0], fact.faces[1]}, fact.smooth, fact.length, angle_of(fact, solid)});
        part.curves.push_back(nullptr);
        require(
            crease_curve_create(context, 4, fact.pole_count, knots, poles, &part.curves.back()));
        knots += fact.pole_count + 4;
        poles += 3 * fact.pole_count;
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
        part->coarser = std::move(search.coarser_regions);
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
        Search search = {
            context, cloud, job, options && options->bspline_faces, {}, {}, nullptr, {}, "", false};
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
