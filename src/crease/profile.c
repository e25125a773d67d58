/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Along stretches of a chain, the points within `width` of it are put into the plane across the
 * chain: u across, z along the bisector of the normals. The sum over the stretches of how much
 * worse a smooth profile explains them than one with a kink, in squared sigmas, says how sure the
 * kink is. */
#include "crease/profile.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "base/vector.h"
#include "crease/kink.h"
#include "crease/sides.h"

#include <math.h>
#include <stdlib.h>

enum {
    STRETCH_POINTS = 24, /* of the chain */
    LEAST_SAMPLES = 12,
    MOST_SAMPLES = 40000, /* of one stretch */
    BALL_POINTS = 4096,
    WIDENINGS = 3
};

static const double WIDTH = 6.0;        /* of the window, in spacings; then twice and four times */
static const double LEAST_WIDTH = 2.5;  /* in spacings */
static const double RADIUS_SHARE = 0.7; /* of the radius of a curved chain, the widest window */
static const double SLAB = 0.25;        /* half the thickness of one slice across, in spacings */
static const double LEAST_ALIGNMENT = 0.75; /* of a point's model with the model at the chain */
static const double SURE = 10.0;            /* gain at which no wider window is looked at */
static const double NARROW = 3.0;           /* in spacings, and twice: windows that refute a kink */
static const double POWER = 5.0;    /* errors of the kink in such a window that make the bend */
static const double MISSING = 0.33; /* of the bend, what the kink there is less than */
static const double FOLD = 1.33;    /* right angles from which a bend is a fold */
static const double SHORTEST =
    5.0; /* in spacings: of folds, and of chains that turn by 30 degrees */
static const double NEVER = 1e300;

typedef struct worker_memory {
    crease_profile_sample *samples;
    uint32_t *found;
} worker_memory;

typedef struct pruning {
    const crease_survey *survey;
    const crease_chains *chains;
    worker_memory *workers;
    bool *keep; /* by chain */
} pruning;

/* What a window says about a chain. */
struct verdict {
    double gain;
    double bend;  /* mean angle of the kink */
    double error; /* of that */
    double chi;   /* what the smooth profile leaves, by sample, in squared sigmas */
    double samples;
};

/* Adds one stretch to the verdict, whose means are sums so far, weighted by the samples. Where the
 * profile with a kink fits worse than noise explains, what is left is the scale of the gain. */
static void judge_samples(const crease_survey *survey, const crease_profile_sample *samples,
    size_t count, double width, struct verdict *verdict)
{
    crease_kink kink;
    if (!crease_kink_measure(samples, count, width, survey->spacing, survey->sigma, &kink))
        return;
    verdict->gain += (kink.smooth - kink.kinked) / fmax(1.0, kink.kinked / (double)count);
    verdict->bend += (double)count * kink.bend;
    verdict->error += pow((double)count * kink.error, 2.0);
    verdict->chi += kink.smooth;
    verdict->samples += (double)count;
}

/* -------------------------------------------------------------------------------- samples -- */

/* The frame across a chain at one of its points. */
typedef struct cross_section {
    const double *place;
    double gradients[2][3];
    double along[3], across[3], up[3];
} cross_section;

static bool cut(
    const crease_survey *survey, const crease_chain *chain, size_t point, cross_section *out)
{
    out->place = chain->points + 3 * point;
    for (int side = 0; side < 2; side++)
        crease_model_distance(
            &survey->regions->models[chain->regions[side]], out->place, out->gradients[side]);
    crease_vector_cross(out->gradients[0], out->gradients[1], out->along);
    if (!(crease_vector_length(out->along) > 0.0))
        return false;
    crease_vector_normalise(out->along);
    const bool opposed = crease_vector_dot(out->gradients[0], out->gradients[1]) < 0.0;
    for (int c = 0; c < 3; c++)
        out->up[c] = out->gradients[0][c] + (opposed ? -1.0 : 1.0) * out->gradients[1][c];
    crease_vector_normalise(out->up);
    crease_vector_cross(out->up, out->along, out->across);
    return true;
}

/* A point of one of the two regions as a sample, unless it is outside the slice, or its region has
 * turned away there: the far side of a rod. */
static bool sample_point(const crease_survey *survey, const crease_chain *chain,
    const cross_section *section, uint32_t point, crease_profile_sample *out)
{
    const crease_regions *const regions = survey->regions;
    const int32_t label = regions->labels[point];
    if (label != (int32_t)chain->regions[0] && label != (int32_t)chain->regions[1])
        return false;
    const int side = label == (int32_t)chain->regions[1];
    const double *const p = regions->points + 3 * (size_t)point;
    const double d[3] = {
        p[0] - section->place[0], p[1] - section->place[1], p[2] - section->place[2]};
    if (fabs(crease_vector_dot(d, section->along)) > SLAB * survey->spacing)
        return false;
    double gradient[3];
    crease_model_distance(&regions->models[label], p, gradient);
    if (fabs(crease_vector_dot(gradient, section->gradients[side])) < LEAST_ALIGNMENT)
        return false;
    *out = (crease_profile_sample){
        crease_vector_dot(d, section->across), crease_vector_dot(d, section->up)};
    return true;
}

static size_t collect(const crease_survey *survey, const crease_chain *chain, size_t begin,
    size_t end, double width, const worker_memory *memory)
{
    size_t count = 0;
    for (size_t i = begin; i < end; i++) {
        cross_section section;
        size_t found = 0;
        if (!cut(survey, chain, i, &section))
            continue;
        crease_tree_within(survey->tree, section.place, width, BALL_POINTS, memory->found, &found);
        found = found < BALL_POINTS ? found : BALL_POINTS;
        for (size_t k = 0; k < found && count < MOST_SAMPLES; k++)
            count +=
                sample_point(survey, chain, &section, memory->found[k], &memory->samples[count]);
    }
    return count;
}

/* --------------------------------------------------------------------------------- chains -- */

static struct verdict judge_window(const crease_survey *survey, const crease_chain *chain,
    double width, const worker_memory *memory)
{
    struct verdict verdict = {0.0, 0.0, 0.0, 0.0, 0.0};
    for (size_t begin = 0, end = 0; end < chain->count; begin = end) {
        end = begin + STRETCH_POINTS;
        if (end + STRETCH_POINTS / 2 > chain->count)
            end = chain->count; /* a short rest belongs to the last stretch */
        const size_t count = collect(survey, chain, begin, end, width, memory);
        if (count >= LEAST_SAMPLES)
            judge_samples(survey, memory->samples, count, width, &verdict);
    }
    if (!(verdict.samples > 0.0))
        return (struct verdict){0.0, 0.0, NEVER, NEVER, 0.0};
    verdict.bend /= verdict.samples;
    verdict.error = sqrt(verdict.error) / verdict.samples;
    verdict.chi /= verdict.samples;
    return verdict;
}

/* Mean radius of a chain's curvature. */
static double mean_radius(const crease_chain *chain)
{
    double turn = 0.0;
    for (size_t i = 2; i < chain->count; i++) {
        double before[3], after[3];
        for (size_t c = 0; c < 3; c++) {
            before[c] = chain->points[3 * i - 3 + c] - chain->points[3 * i - 6 + c];
            after[c] = chain->points[3 * i + c] - chain->points[3 * i - 3 + c];
        }
        crease_vector_normalise(before);
        crease_vector_normalise(after);
        turn += acos(fmin(1.0, crease_vector_dot(before, after)));
    }
    return turn > 0.0 ? crease_chain_length(chain) / turn : NEVER;
}

/* The surest of the windows: the narrow one is the most honest, but noise may ask for more. */
static struct verdict judge(
    const crease_survey *survey, const crease_chain *chain, const worker_memory *memory)
{
    const double widest = RADIUS_SHARE * mean_radius(chain);
    struct verdict best = {-NEVER, 0.0, NEVER, NEVER, 0.0};
    for (int i = 0; i < WIDENINGS; i++) {
        const double wanted = ldexp(WIDTH, i) * survey->spacing;
        const double width = fmax(fmin(wanted, widest), LEAST_WIDTH * survey->spacing);
        const struct verdict next = judge_window(survey, chain, width, memory);
        best = next.gain > best.gain ? next : best;
        if ((best.gain > SURE && best.bend > survey->least_bend) || width < wanted)
            break;
    }
    return best;
}

/* The gain that is asked for: 10 up to a bend of 30 degrees, where models mislead most, 2 from 45
 * on. */
static double least_gain(double bend)
{
    const double degrees = bend * 180.0 / acos(-1.0);
    return fmin(10.0, fmax(2.0, 10.0 - 8.0 * (degrees - 30.0) / 15.0));
}

/* Whether a sharp bend of the models is none of the points': a window in which it could not be
 * missed shows far less of it. Two sheets that fold back on each other lie above each other there,
 * which no one profile explains; where models that cross at a sharp angle only seem to do so, one
 * does. */
static bool is_refuted(const crease_survey *survey, const crease_chain *chain, double bend,
    const worker_memory *memory)
{
    const double radius = mean_radius(chain), length = crease_chain_length(chain);
    const double widest = RADIUS_SHARE * radius, right = 0.5 * acos(-1.0);
    if (length < SHORTEST * survey->spacing && (bend > FOLD * right || radius < 2.0 * length))
        return true;
    for (int i = bend > right ? 1 : 0; i < 2; i++) {
        const double width = fmin(ldexp(NARROW, i) * survey->spacing, widest);
        const struct verdict seen =
            judge_window(survey, chain, fmax(width, LEAST_WIDTH * survey->spacing), memory);
        const bool folded =
            bend > right && seen.chi > 1.0 + 3.0 * sqrt(2.0 / fmax(seen.samples, 1.0));
        if (POWER * seen.error < bend && seen.bend < MISSING * bend &&
            seen.gain < least_gain(bend) && !folded)
            return true;
    }
    return false;
}

/* Whether most points beside a chain lie on an edge that the scanner has rounded: that they turn
 * fast there has been seen already, and no profile shows a kink any more. */
static bool is_rounded(const crease_survey *survey, const crease_chain *chain, uint32_t *found)
{
    const uint8_t *const rounded = survey->regions->rounded;
    size_t all = 0, on = 0;
    for (size_t i = 0; i < chain->count; i++) {
        size_t count = 0;
        crease_tree_within(survey->tree, chain->points + 3 * i, WIDTH / 2.0 * survey->spacing,
            BALL_POINTS, found, &count);
        count = count < BALL_POINTS ? count : BALL_POINTS;
        all += count;
        for (size_t k = 0; k < count; k++)
            on += rounded[found[k]];
    }
    return 2 * on > all;
}

static bool is_crease(
    const crease_survey *survey, const crease_chain *chain, const worker_memory *memory)
{
    const double bend = crease_chain_mean_bend(chain);
    if (survey->regions->rounded) {
        if (is_rounded(survey, chain, memory->found))
            return true;
    } else if (!crease_sides_end(survey, chain, memory->found)) {
        return false;
    } else if (bend >= acos(-1.0) / 3.0) {
        return !is_refuted(survey, chain, bend, memory);
    }
    const struct verdict verdict = judge(survey, chain, memory);
    return verdict.gain >= least_gain(bend) && verdict.bend >= survey->least_bend;
}

static void prune_some(void *user, size_t begin, size_t end, int worker)
{
    const pruning *const run = user;
    for (size_t i = begin; i < end; i++)
        run->keep[i] = is_crease(run->survey, &run->chains->items[i], &run->workers[worker]);
}

static void compact(crease_chains *chains, const bool *keep)
{
    size_t kept = 0;
    for (size_t i = 0; i < chains->count; i++) {
        if (keep[i])
            chains->items[kept++] = chains->items[i];
        else
            crease_chain_clear(&chains->items[i]);
    }
    chains->count = kept;
}

crease_status crease_profile_prune(
    crease_context *context, const crease_survey *survey, crease_chains *chains)
{
    const size_t threads = (size_t)crease_context_threads(context);
    bool *const keep = crease_allocate(context, chains->count, sizeof *keep);
    worker_memory *const workers = crease_allocate(context, threads, sizeof *workers);
    crease_profile_sample *const samples =
        crease_allocate(context, threads, MOST_SAMPLES * sizeof *samples);
    uint32_t *const found = crease_allocate(context, threads, BALL_POINTS * sizeof *found);
    crease_status status = CREASE_ERROR_NO_MEMORY;
    if (keep && workers && samples && found) {
        for (size_t i = 0; i < threads; i++)
            workers[i] = (worker_memory){samples + i * MOST_SAMPLES, found + i * BALL_POINTS};
        pruning run = {survey, chains, workers, keep};
        status = crease_parallel_for(context, chains->count, 1, prune_some, &run);
    }
    if (status == CREASE_OK)
        compact(chains, keep);
    free(keep);
    free(workers);
    free(samples);
    free(found);
    return status;
}
