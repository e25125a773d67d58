/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/alike.h"

#include "base/memory.h"
#include "base/vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    MOST_POINTS = 300, /* of a region that are looked at */
    WAYS = 3,          /* across the gap */
    MOST_NEAR = 64
};

/* In spacings. */
static const double SAME_RADIUS = 0.5;
static const double SAME_AXIS = 1.0;
static const double CLEAR = 1.0; /* from the way across the gap to points of other regions */
static const double STEP = 0.5;
static const double RIM = 1.5;  /* from the ends of the face: there others are beside the way */
static const double NEXT = 3.0; /* apart along the axis, or the length of the smaller one */

static const double PARALLEL = 0.9986;  /* cosine of 3 degrees */
static const double MOST_SIGMAS = 1.25; /* rms distance of the points from the other's surface */

/* Some points of a region, about the axis of the larger one: angle, place along it, radius. */
struct some {
    size_t count;
    double points[MOST_POINTS][3];
    double low, high; /* along the axis */
};

struct pair {
    const crease_survey *survey;
    const int32_t *labels;
    const size_t *sizes;
    int32_t large, small;
    struct some *some[2];
};

struct way {
    double length, from[3], to[3];
};

static bool is_round(const crease_model *model)
{
    return model->type == CREASE_REGION_CYLINDER || model->type == CREASE_REGION_CONE;
}

static bool may_be_one(const crease_survey *survey, const crease_model *a, const crease_model *b)
{
    const double *const z = a->axes + 6;
    double across[3];
    if (!is_round(a) || a->type != b->type || fabs(crease_vector_dot(z, b->axes + 6)) < PARALLEL)
        return false;
    for (int c = 0; c < 3; c++)
        across[c] = b->centre[c] - a->centre[c];
    const double along = crease_vector_dot(across, z);
    for (int c = 0; c < 3; c++)
        across[c] -= along * z[c];
    return crease_vector_length(across) < SAME_AXIS * survey->spacing &&
        (a->type == CREASE_REGION_CONE ||
            fabs(a->radius - b->radius) < SAME_RADIUS * survey->spacing);
}

static void about_axis(const crease_model *model, const double place[3], double out[3])
{
    double d[3];
    for (int c = 0; c < 3; c++)
        d[c] = place[c] - model->centre[c];
    const double x = crease_vector_dot(d, model->axes), y = crease_vector_dot(d, model->axes + 3);
    out[0] = atan2(y, x);
    out[1] = crease_vector_dot(d, model->axes + 6);
    out[2] = hypot(x, y);
}

/* Takes points of both regions, evenly; false when the smaller one's are not on the surface. */
static bool take_points(const struct pair *pair)
{
    const crease_regions *const r = pair->survey->regions;
    const crease_model *const model = &r->models[pair->large];
    size_t seen[2] = {0, 0};
    double squares = 0.0, gradient[3];
    for (int k = 0; k < 2; k++)
        *pair->some[k] = (struct some){.low = INFINITY, .high = -INFINITY};
    for (size_t i = 0; i < r->count; i++) {
        const int k = pair->labels[i] == pair->small;
        struct some *const some = pair->some[k];
        if (!k && pair->labels[i] != pair->large)
            continue;
        const size_t step = pair->sizes[k ? pair->small : pair->large] / MOST_POINTS + 1;
        if (seen[k]++ % step != 0 || some->count == MOST_POINTS)
            continue;
        double *const to = some->points[some->count++];
        about_axis(model, r->points + 3 * i, to);
        some->low = fmin(some->low, to[1]);
        some->high = fmax(some->high, to[1]);
        if (k) {
            const double away = crease_model_distance(model, r->points + 3 * i, gradient);
            squares += away * away;
        }
    }
    const double most = MOST_SIGMAS * pair->survey->sigma;
    return pair->some[1]->count > 0 && squares < most * most * (double)pair->some[1]->count;
}

static double turn_between(double a, double b)
{
    return remainder(b - a, 2.0 * acos(-1.0));
}

/* The shortest ways from points of the one region to the nearest of the other; away from the ends
 * of both, where both are side by side. */
static size_t find_ways(const struct pair *pair, struct way ways[WAYS])
{
    const double rim = RIM * pair->survey->spacing;
    const double low = fmax(pair->some[0]->low, pair->some[1]->low) + rim;
    const double high = fmin(pair->some[0]->high, pair->some[1]->high) - rim;
    size_t count = 0;
    for (size_t i = 0; i < pair->some[1]->count; i++) {
        const double *const from = pair->some[1]->points[i];
        struct way way = {.length = INFINITY};
        if (low < high && (from[1] < low || from[1] > high))
            continue;
        memcpy(way.from, from, sizeof way.from);
        for (size_t k = 0; k < pair->some[0]->count; k++) {
            const double *const to = pair->some[0]->points[k];
            if (low < high && (to[1] < low || to[1] > high))
                continue;
            const double length = hypot(turn_between(from[0], to[0]) * to[2], to[1] - from[1]);
            if (length < way.length) {
                way.length = length;
                memcpy(way.to, to, sizeof way.to);
            }
        }
        if (way.length == INFINITY)
            continue;
        size_t at = count < WAYS ? count++ : WAYS;
        for (; at > 0 && ways[at - 1].length > way.length; at--)
            if (at < WAYS)
                ways[at] = ways[at - 1];
        if (at < WAYS)
            ways[at] = way;
    }
    return count;
}

/* Whether points of a third region lie beside the way. */
static bool is_crossed(const struct pair *pair, const struct way *way)
{
    const crease_survey *const survey = pair->survey;
    const crease_model *const model = &survey->regions->models[pair->large];
    const double s = survey->spacing, turn = turn_between(way->from[0], way->to[0]);
    const size_t steps = (size_t)ceil(way->length / (STEP * s)) + 1;
    for (size_t i = 0; i <= steps; i++) {
        const double share = (double)i / (double)steps;
        const double angle = way->from[0] + share * turn;
        const double along = way->from[1] + share * (way->to[1] - way->from[1]);
        const double radius = way->from[2] + share * (way->to[2] - way->from[2]);
        uint32_t near[MOST_NEAR];
        size_t found = 0;
        double place[3];
        for (int c = 0; c < 3; c++)
            place[c] = model->centre[c] + along * model->axes[6 + c] +
                radius * (cos(angle) * model->axes[c] + sin(angle) * model->axes[3 + c]);
        crease_tree_within(survey->tree, place, CLEAR * s, MOST_NEAR, near, &found);
        for (size_t k = 0; k < found && k < MOST_NEAR; k++) {
            const int32_t label = pair->labels[near[k]];
            if (label >= 0 && label != pair->large && label != pair->small)
                return true;
        }
    }
    return false;
}

static bool is_one_face(const struct pair *pair)
{
    struct way ways[WAYS];
    if (!take_points(pair))
        return false;
    const struct some *const a = pair->some[0], *const b = pair->some[1];
    const double apart = fmax(a->low, b->low) - fmin(a->high, b->high);
    if (apart > fmax(NEXT * pair->survey->spacing, b->high - b->low))
        return false;
    const size_t count = find_ways(pair, ways);
    for (size_t i = 0; i < count; i++)
        if (is_crossed(pair, &ways[i]))
            return false;
    return count > 0;
}

static void relabel(struct pair *pair, size_t count, int32_t *labels, size_t *sizes)
{
    for (size_t i = 0; i < count; i++)
        if (labels[i] == pair->small)
            labels[i] = pair->large;
    sizes[pair->large] += sizes[pair->small];
    sizes[pair->small] = 0;
}

static void join_all(struct pair *pair, int32_t *labels, size_t *sizes)
{
    const crease_regions *const r = pair->survey->regions;
    const int32_t count = (int32_t)r->region_count;
    for (int32_t a = 0; a < count; a++)
        for (int32_t b = 0; b < count; b++) {
            const bool smaller = sizes[b] < sizes[a] || (sizes[b] == sizes[a] && b > a);
            pair->large = a;
            pair->small = b;
            if (sizes[b] > 0 && smaller && may_be_one(pair->survey, &r->models[a], &r->models[b]) &&
                is_one_face(pair))
                relabel(pair, r->count, labels, sizes);
        }
}

crease_status crease_alikes_join(
    crease_context *context, const crease_survey *survey, int32_t *labels)
{
    const crease_regions *const r = survey->regions;
    size_t *const sizes = crease_allocate(context, r->region_count, sizeof *sizes);
    struct some *const some = crease_allocate(context, 2, sizeof *some);
    struct pair pair = {survey, labels, sizes, 0, 0, {some, some ? some + 1 : NULL}};
    if (sizes && some) {
        for (size_t i = 0; i < r->count; i++)
            if (labels[i] >= 0)
                sizes[labels[i]]++;
        join_all(&pair, labels, sizes);
    }
    free(sizes);
    free(some);
    return sizes && some ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
}
