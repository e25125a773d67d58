/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Along stretches of a chain, the points within `width` of it are put into the plane across the
 * chain: u across, z along the bisector of the normals. Two profiles are fitted to them,
 *
 *   kinked  z = a + b u + c u-^2 + d u+^2 + e u+        u- = min(u, 0), u+ = max(u, 0)
 *   smooth  the same without e, its pieces joining at the best of several places,
 *
 * with cubic terms when the window is wide, by reweighted least squares. The sum over the stretches
 * of how much worse the smooth profile is, in squared sigmas, says how sure the kink is. */
#include "crease/profile.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "base/symmetric.h"
#include "base/vector.h"
#include "crease/sides.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    MOST_TERMS = 7,
    STRETCH_POINTS = 24, /* of the chain */
    LEAST_SAMPLES = 12,
    MOST_SAMPLES = 40000, /* of one stretch */
    BALL_POINTS = 4096,
    ROUNDS = 2,       /* of reweighting */
    LEAST_JOINTS = 6, /* places tried for the joint of the smooth profile, in half the window */
    WIDENINGS = 3
};

static const double WIDTH = 6.0;        /* of the window, in spacings; then twice and four times */
static const double LEAST_WIDTH = 2.5;  /* in spacings */
static const double CUBIC_WIDTH = 8.0;  /* in spacings: wider windows get cubic terms */
static const double RADIUS_SHARE = 0.7; /* of the radius of a curved chain, the widest window */
static const double SLAB = 0.25;        /* half the thickness of one slice across, in spacings */
static const double LEAST_ALIGNMENT = 0.75; /* of a point's model with the model at the chain */
static const double JOINT_RANGE = 0.7;      /* of the width, on both sides */
static const double OUTLIER = 12.0;         /* squared sigmas that one point may cost */
static const double SOFTNESS = 3.0; /* sigmas at which a point has a quarter of its weight */
static const double SURE = 10.0;    /* gain at which no wider window is looked at */
static const double NEVER = 1e300;

struct sample {
    double u, z;
};

/* A kind of profile. */
struct shape {
    bool kinked, cubic;
    double joint, width;
};

typedef struct worker_memory {
    struct sample *samples;
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
    double bend; /* mean angle of the kink */
};

/* ------------------------------------------------------------------------------- profiles -- */

static size_t term_count(const struct shape *shape)
{
    return 4 + 2 * (size_t)shape->cubic + (size_t)shape->kinked;
}

/* The kink is the last term. */
static void terms(const struct shape *shape, double at, double *out)
{
    const double u = at - shape->joint, before = fmin(u, 0.0), after = fmax(u, 0.0);
    size_t n = 0;
    out[n++] = 1.0;
    out[n++] = u;
    out[n++] = before * before;
    out[n++] = after * after;
    if (shape->cubic) {
        out[n++] = before * before * before / shape->width;
        out[n++] = after * after * after / shape->width;
    }
    if (shape->kinked)
        out[n] = after;
}

static double residual(
    const struct shape *shape, const struct sample *sample, const double *weights)
{
    double values[MOST_TERMS], z = sample->z;
    terms(shape, sample->u, values);
    for (size_t k = 0; k < term_count(shape); k++)
        z -= weights[k] * values[k];
    return z;
}

/* One round of least squares; weights holds the result of the last one, or nothing. */
static bool solve(const struct shape *shape, const struct sample *samples, size_t count,
    double sigma, bool reweight, double *weights)
{
    const size_t n = term_count(shape);
    double matrix[MOST_TERMS * MOST_TERMS] = {0}, right[MOST_TERMS] = {0}, values[MOST_TERMS];
    for (size_t i = 0; i < count; i++) {
        double weight = 1.0;
        if (reweight) {
            const double r = residual(shape, &samples[i], weights) / (SOFTNESS * sigma);
            weight = 1.0 / ((1.0 + r * r) * (1.0 + r * r));
        }
        terms(shape, samples[i].u, values);
        for (size_t k = 0; k < n; k++) {
            right[k] += weight * values[k] * samples[i].z;
            for (size_t l = 0; l <= k; l++)
                matrix[k * n + l] += weight * values[k] * values[l];
        }
    }
    for (size_t k = 0; k < n; k++)
        matrix[k * n + k] *= 1.0 + 1e-6; /* a side without points leaves its terms open */
    if (!crease_symmetric_factor(matrix, n, n, n))
        return false;
    crease_symmetric_solve(matrix, n, n, n, right);
    memcpy(weights, right, n * sizeof *weights);
    return true;
}

/* What the best profile of a shape leaves, in squared sigmas; NEVER when there is none. */
static double fit(const struct shape *shape, const struct sample *samples, size_t count,
    double sigma, double *weights)
{
    double cost = 0.0;
    for (int round = 0; round < ROUNDS; round++)
        if (!solve(shape, samples, count, sigma, round > 0, weights))
            return NEVER;
    for (size_t i = 0; i < count; i++) {
        const double r = residual(shape, &samples[i], weights) / sigma;
        cost += fmin(r * r, OUTLIER);
    }
    return cost;
}

/* What the best smooth profile leaves, whatever the place of its joint. */
static double fit_smooth(const crease_survey *survey, const struct sample *samples, size_t count,
    double width, bool cubic)
{
    const double step = fmin(width / LEAST_JOINTS, survey->spacing); /* coarser ones fake kinks */
    const double steps = floor(2.0 * JOINT_RANGE * width / step);
    double weights[MOST_TERMS], least = NEVER;
    for (double i = 0.0; i <= steps; i += 1.0) {
        const struct shape shape = {false, cubic, i * step - JOINT_RANGE * width, width};
        least = fmin(least, fit(&shape, samples, count, survey->sigma, weights));
    }
    return least;
}

/* Adds one stretch to the verdict; the bend is weighted by the samples, *weight their sum. */
static void judge_samples(const crease_survey *survey, const struct sample *samples, size_t count,
    double width, struct verdict *verdict, double *weight)
{
    const bool cubic = width > CUBIC_WIDTH * survey->spacing;
    const struct shape shape = {true, cubic, 0.0, width};
    double weights[MOST_TERMS];
    const double smooth = fit_smooth(survey, samples, count, width, cubic);
    const double kinked = fit(&shape, samples, count, survey->sigma, weights);
    if (kinked == NEVER || smooth == NEVER)
        return;
    const double before = weights[1], after = weights[1] + weights[term_count(&shape) - 1];
    verdict->gain += smooth - kinked;
    verdict->bend += (double)count * fabs(atan(after) - atan(before));
    *weight += (double)count;
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
    const cross_section *section, uint32_t point, struct sample *out)
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
    *out =
        (struct sample){crease_vector_dot(d, section->across), crease_vector_dot(d, section->up)};
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
    struct verdict verdict = {0.0, 0.0};
    double weight = 0.0;
    for (size_t begin = 0, end = 0; end < chain->count; begin = end) {
        end = begin + STRETCH_POINTS;
        if (end + STRETCH_POINTS / 2 > chain->count)
            end = chain->count; /* a short rest belongs to the last stretch */
        const size_t count = collect(survey, chain, begin, end, width, memory);
        if (count >= LEAST_SAMPLES)
            judge_samples(survey, memory->samples, count, width, &verdict, &weight);
    }
    verdict.bend = weight > 0.0 ? verdict.bend / weight : 0.0;
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
    struct verdict best = {-NEVER, 0.0};
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

static void prune_some(void *user, size_t begin, size_t end, int worker)
{
    const pruning *const run = user;
    for (size_t i = begin; i < end; i++) {
        const crease_chain *const chain = &run->chains->items[i];
        const double bend = crease_chain_mean_bend(chain);
        run->keep[i] = true;
        const uint8_t *const rounded = run->survey->regions->rounded;
        if (!rounded && !crease_sides_end(run->survey, chain, run->workers[worker].found)) {
            run->keep[i] = false;
            continue;
        }
        if (rounded ? is_rounded(run->survey, chain, run->workers[worker].found)
                    : bend >= acos(-1.0) / 3.0)
            continue;
        const struct verdict verdict = judge(run->survey, chain, &run->workers[worker]);
        run->keep[i] = verdict.gain >= least_gain(bend) && verdict.bend >= run->survey->least_bend;
    }
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
    struct sample *const samples =
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
