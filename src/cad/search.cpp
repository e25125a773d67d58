/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "cad/search.hpp"

#include "cad/apart.hpp"
#include "cad/effort.hpp"
#include "cad/kernel.hpp"
#include "cad/ways.hpp"
#include "snap/coarser.h"
#include "topology/complete.h"

#include <algorithm>
#include <sys/resource.h>

namespace crease_cad
{

/* Seconds of the processor after which an attempt hangs, and all together; work is limited by
 * Effort. */
static constexpr unsigned HUNG = 12, MOST_SECONDS = 20;
static constexpr unsigned LAST_RESORT =
    120; /* nothing comes after it, but its faces take their time */
static constexpr double GOOD_LOSS = 0.04; /* of a result: no other way is tried */

/* Regions that join smoothly may be united where nothing closed before: soon where some are free
 * forms, which may be pieces of one; else after the surfaces have been intersected, which is quick.
 * Planes may be added for faces that no point shows, but their neighbours. */
enum Variant { AS_GIVEN, COMPLETED, FORMS_UNITED, PRIMITIVES_UNITED };

/* A way with its margin: the larger of a part of the diagonal and some spacings. */
struct Step {
    Way way;
    double diagonals, spacings;
    bool for_solid;
    bool for_open; /* it is tried when the points end at a border */
    Variant variant;
};

static constexpr Step steps[] = {
    {follow_topology, 0.0, 0.0, true, true, AS_GIVEN},
    {follow_topology, 0.0, 0.0, true, false, COMPLETED},
    {follow_topology, 0.0, 0.0, true, false, FORMS_UNITED},
    {arrange_solid, 0.03, 1.8, true, false, AS_GIVEN},
    {arrange_solid, 0.06, 3.6, true, false, AS_GIVEN},
    {arrange_solid, 0.12, 7.2, true, false, AS_GIVEN},
    {arrange_solid, 0.3, 18.0, true, false, AS_GIVEN},
    {follow_topology, 0.0, 0.0, true, false, PRIMITIVES_UNITED},
    {arrange_shells, 0.03, 3.0, false, true, AS_GIVEN},
    {lay_out_rest, 0.0, 0.0, false, true, AS_GIVEN},
    {lay_out_faces, 0.0, 0.0, false, true, AS_GIVEN}, /* where that broke down */
};

static constexpr const char *HANGS = "OpenCASCADE takes too long to intersect the surfaces";
static constexpr Bounds bounds = {
    HUNG, HANGS, "OpenCASCADE broke down over the surfaces", "cancelled before it was built"};

static bool is_arrangement(const Step &step)
{
    return step.way == arrange_solid || step.way == arrange_shells;
}

/* Seconds of the processor that other processes have taken. */
static double seconds_apart()
{
    rusage usage = {};
    getrusage(RUSAGE_CHILDREN, &usage);
    return (double)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
        1e-6 * (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

static bool is_last_resort(const Step &step)
{
    return step.way == lay_out_rest || step.way == lay_out_faces;
}

/* The seconds of one arrangement are whole, and at least one. */
static Bounds bounds_of(const Search &search, const Step &step)
{
    Bounds out = bounds;
    if (is_last_resort(step))
        out.seconds = LAST_RESORT;
    if (is_arrangement(step))
        out.seconds = std::min(HUNG, 1 + (unsigned)std::max(0.0, MOST_SECONDS - search.arranging));
    return out;
}

/* What a failed attempt means for the search: cancelling and lack of memory end it. */
static void note(Search &search, const Failure &failure)
{
    if (failure.status == CREASE_ERROR_CANCELLED || failure.status == CREASE_ERROR_NO_MEMORY)
        throw failure;
    search.hangs = search.hangs || failure.sentence == HANGS;
    search.spent = search.spent || search.hangs || failure.sentence == TOO_MUCH_WORK;
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
    require(crease_regions_find_coarser(search.context, search.given.regions, &found));
    search.coarser_regions.reset(found);
    if (found && crease_regions_count(found) < crease_regions_count(search.given.regions))
        search.coarser = std::make_unique<const Job>(
            search.context, search.cloud, found, nullptr, search.given.bordered);
    return search.coarser.get();
}

/* Null when the neighbours of no unseen face determine it. */
static const Job *complete_job(Search &search)
{
    if (search.complete)
        return search.complete.get();
    crease_regions *found = nullptr;
    require(crease_regions_find_complete(
        search.context, search.cloud, search.given.regions, &search.given.topology(), &found));
    search.complete_regions.reset(found);
    if (found)
        search.complete = std::make_unique<const Job>(
            search.context, search.cloud, found, search.given.network, search.given.bordered);
    return search.complete.get();
}

static Variant turn_of(const crease_regions &regions)
{
    for (size_t i = 0; i < crease_regions_count(&regions); i++)
        if (crease_regions_at(&regions, i).type == CREASE_REGION_FREEFORM)
            return FORMS_UNITED;
    return PRIMITIVES_UNITED;
}

/* Null where there is none, or a solid is there without it. */
static const Job *job_of(Search &search, const Step &step)
{
    if (step.variant == AS_GIVEN)
        return &search.given;
    if (search.best && is_true_solid(*search.best))
        return nullptr;
    if (step.variant == COMPLETED)
        return complete_job(search);
    return step.variant == turn_of(*search.given.regions) ? coarser_job(search) : nullptr;
}

/* Whether something came out. */
static bool attempt(Search &search, const Step &step, const Job &job)
{
    const double margin = std::max(step.diagonals * job.diagonal, step.spacings * job.spacing);
    const double before = seconds_apart();
    std::vector<char> bytes;
    try {
        bytes =
            run_apart([&] { return pack(measure(job, step.way(job, margin), search.as_bsplines)); },
                bounds_of(search, step));
    } catch (const Failure &failure) {
        note(search, failure);
    }
    if (is_arrangement(step))
        search.arranging += seconds_apart() - before;
    if (bytes.empty())
        return false;
    Judged judged = judge(search.context, search.cloud, job, unpack(bytes));
    if (step.for_solid && !is_true_solid(judged) && search.why_no_solid.empty())
        search.why_no_solid = why_not(judged);
    if (!search.best || is_better(judged, *search.best)) {
        search.best = std::move(judged);
        search.job = &job;
    }
    return true;
}

static bool is_enough(const Search &search, const Step &next)
{
    if (search.best && search.given.bordered)
        return search.best->state == CREASE_PART_SHELL && search.best->loss < GOOD_LOSS;
    if (!search.best || !is_true_solid(*search.best))
        return false;
    return !next.for_solid || (search.best->loss < GOOD_LOSS && search.best->lost == 0);
}

/* Points that end at a border have no other shell. */
static bool is_too_much(const Search &search, const Step &step)
{
    if (search.given.bordered)
        return false;
    return search.arranging > MOST_SECONDS || (search.spent && step.for_solid) || search.hangs;
}

void search_best(Search &search)
{
    bool made = false; /* by the last step that was tried */
    for (const Step &step : steps) {
        if (is_enough(search, step) || (step.way == lay_out_faces && made))
            break;
        if (search.given.bordered && !step.for_open)
            continue;
        if (is_arrangement(step) && is_too_much(search, step))
            continue;
        if (!step.for_solid && search.best && search.best->state == CREASE_PART_SHELL &&
            search.best->loss < GOOD_LOSS)
            break;
        if (const Job *const job = job_of(search, step))
            made = attempt(search, step, *job);
    }
    if (!search.best)
        throw Failure{CREASE_ERROR_NUMERIC, search.why_no_solid};
}

} // namespace crease_cad
