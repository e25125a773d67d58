/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Curves in space come into the plane by the points around them; those that go on from each other
 * become one course. */
#include "fit/course.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NEAR = 8, MOST_STATIONS = 400, LEAST_STATIONS = 8, SMOOTHED = 2 };

/* In spacings. */
static const double APART = 10.0, TO_JOIN = 6.0, BESIDE = 3.0, CLEAR = 4.0;
static const double AHEAD = 0.5;       /* slope, at most, of the way to where a crease goes on */
static const double TURNED_BACK = 0.1; /* of the length */
static const double SLANTED = 0.1; /* square of the least cosine between a crease and the axis */
static const double SHORT = 12.0;  /* spacings: a crease whose direction says nothing */

/* One crease in the plane. */
typedef struct trail {
    uint32_t regions[2];
    size_t count;
    double length;
    double plane[2 * MOST_STATIONS]; /* across, along */
    size_t course;
} trail;

static crease_status lay_trail(crease_context *context, const crease_spread *spread,
    const crease_tree *tree, const crease_curve *curve, double length, trail *out)
{
    double places[3 * MOST_STATIONS], squares[NEAR * MOST_STATIONS], domain[2];
    uint32_t near[NEAR * MOST_STATIONS];
    const double stations = fmin(fmax(length / spread->spacing, LEAST_STATIONS), MOST_STATIONS);
    out->count = (size_t)stations;
    crease_curve_domain(curve, domain);
    for (size_t i = 0; i < out->count; i++) {
        const double t = (double)i / (double)(out->count - 1);
        crease_curve_evaluate(
            curve, domain[0] + t * (domain[1] - domain[0]), CREASE_SIDE_RIGHT, 0, places + 3 * i);
    }
    const crease_status status =
        crease_tree_nearest(context, tree, places, out->count, NEAR, near, squares);
    for (size_t i = 0; i < out->count && status == CREASE_OK; i++) {
        double sum[3] = {0.0, 0.0, 0.0};
        for (size_t k = 0; k < NEAR; k++) {
            const uint32_t point = near[i * NEAR + k];
            const double weight = spread->keep[point] /
                (squares[i * NEAR + k] + 0.01 * spread->spacing * spread->spacing);
            sum[0] += weight * spread->plane[2 * point];
            sum[1] += weight * spread->plane[2 * point + 1];
            sum[2] += weight;
        }
        for (size_t d = 0; d < 2; d++)
            out->plane[2 * i + d] = sum[2] > 0.0 ? sum[d] / sum[2] : 0.0;
    }
    return status;
}

static void smooth(trail *one)
{
    double before[2 * MOST_STATIONS];
    for (int pass = 0; pass < SMOOTHED; pass++) {
        memcpy(before, one->plane, 2 * one->count * sizeof *before);
        for (size_t i = 2; i < 2 * (one->count - 1); i++)
            one->plane[i] = (before[i - 2] + before[i] + before[i + 2]) / 3.0;
    }
}

/* The direction that the chords of the trails have in common: the axis of their doubled angles. */
static double common_direction(const trail *trails, size_t count)
{
    double cosine = 0.0, sine = 0.0;
    for (size_t i = 0; i < count; i++) {
        const double *const last = trails[i].plane + 2 * (trails[i].count - 1);
        const double x = last[0] - trails[i].plane[0], y = last[1] - trails[i].plane[1];
        cosine += x * x - y * y;
        sine += 2.0 * x * y;
    }
    return 0.5 * atan2(sine, cosine);
}

static void turn(double *plane, size_t count, double angle)
{
    const double c = cos(angle), s = sin(angle);
    for (size_t i = 0; i < count; i++) {
        const double x = plane[2 * i], y = plane[2 * i + 1];
        plane[2 * i] = s * x - c * y;
        plane[2 * i + 1] = c * x + s * y;
    }
}

/* Makes a trail ascend along the second axis; false when it does not go that way. */
static bool ascend(trail *one)
{
    double *const p = one->plane;
    const size_t last = one->count - 1;
    if (p[2 * last + 1] < p[1])
        for (size_t i = 0; i < one->count / 2; i++)
            for (size_t d = 0; d < 2; d++) {
                const double kept = p[2 * i + d];
                p[2 * i + d] = p[2 * (last - i) + d];
                p[2 * (last - i) + d] = kept;
            }
    const double x = p[2 * last] - p[0], y = p[2 * last + 1] - p[1];
    double back = 0.0;
    size_t count = 1;
    for (size_t i = 1; i <= last; i++) {
        if (!(p[2 * i + 1] > p[2 * count - 1])) {
            back += p[2 * count - 1] - p[2 * i + 1];
            continue;
        }
        memmove(p + 2 * count++, p + 2 * i, 2 * sizeof *p);
    }
    one->count = count;
    return y * y > SLANTED * (x * x + y * y) && back < TURNED_BACK * y && count > 1;
}

/* Whether all of a trail runs close beside a longer one. */
static bool doubles(const trail *one, const trail *other, double clear)
{
    if (!(one->length < other->length))
        return false;
    for (size_t i = 0; i < one->count; i++) {
        double least = INFINITY;
        for (size_t k = 0; k < other->count; k++)
            least = fmin(least,
                hypot(one->plane[2 * i] - other->plane[2 * k],
                    one->plane[2 * i + 1] - other->plane[2 * k + 1]));
        if (!(least < clear))
            return false;
    }
    return true;
}

/* Where a region has been taken in two, a crease may be found twice. */
static size_t without_doubles(trail *trails, size_t count, double clear)
{
    size_t kept = 0;
    for (size_t i = 0; i < count; i++) {
        bool twice = false;
        for (size_t k = 0; k < count && !twice; k++)
            twice = k != i && (k < kept || k > i) && doubles(&trails[i], &trails[k], clear);
        if (!twice)
            trails[kept++] = trails[i];
    }
    return kept;
}

static int by_begin(const void *a, const void *b)
{
    const double x = ((const trail *)a)->plane[1], y = ((const trail *)b)->plane[1];
    return (x > y) - (x < y);
}

/* The course whose end a trail goes on from, or a new one. */
static size_t course_before(const trail *trails, size_t index, size_t courses, double spacing)
{
    size_t best = courses;
    double nearest = INFINITY;
    for (size_t c = 0; c < courses; c++) {
        const trail *last = NULL;
        for (size_t i = 0; i < index; i++)
            if (trails[i].course == c)
                last = trails + i;
        const double *const end = last->plane + 2 * (last->count - 1);
        const double x = trails[index].plane[0] - end[0], y = trails[index].plane[1] - end[1];
        /* A line may go on where the crease has faded out and comes again. */
        if (y > -APART * spacing && fabs(x) < fmax(TO_JOIN * spacing, AHEAD * y) &&
            hypot(x, y) < nearest) {
            nearest = hypot(x, y);
            best = c;
        }
    }
    return best;
}

static crease_status join(
    crease_context *context, trail *trails, size_t count, double spacing, crease_courses *out)
{
    qsort(trails, count, sizeof *trails, by_begin);
    for (size_t i = 0; i < count; i++) {
        trails[i].course = course_before(trails, i, out->count, spacing);
        out->count += trails[i].course == out->count;
        if (out->count > CREASE_MOST_LINES)
            return CREASE_OK;
    }
    for (size_t c = 0; c < out->count; c++) {
        crease_course *const course = &out->items[c];
        course->along = crease_allocate(context, count, MOST_STATIONS * sizeof(double));
        course->across = crease_allocate(context, count, MOST_STATIONS * sizeof(double));
        if (!course->along || !course->across)
            return CREASE_ERROR_NO_MEMORY;
        for (size_t i = 0; i < count; i++)
            for (size_t k = 0; k < trails[i].count && trails[i].course == c; k++) {
                const double *const p = trails[i].plane + 2 * k;
                if (course->count > 0 && !(p[1] > course->along[course->count - 1]))
                    continue;
                course->along[course->count] = p[1];
                course->across[course->count++] = p[0];
            }
    }
    return CREASE_OK;
}

double crease_course_across(const crease_course *course, double along)
{
    const size_t last = course->count - 1;
    const double *const y = course->along, *const x = course->across;
    if (along <= y[0] || along >= y[last]) {
        /* Goes on as a tenth of the course does at its end. */
        const size_t part = last / 10 > 1 ? last / 10 : 1;
        const size_t end = along <= y[0] ? 0 : last, inner = along <= y[0] ? part : last - part;
        return x[end] + (along - y[end]) * (x[inner] - x[end]) / (y[inner] - y[end]);
    }
    size_t low = 0, high = last;
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        if (y[middle] <= along)
            low = middle;
        else
            high = middle;
    }
    return x[low] + (along - y[low]) * (x[high] - x[low]) / (y[high] - y[low]);
}

/* Orders the courses across; false when they do not stay clear of each other on the patch. */
static bool in_order(const crease_spread *spread, trail *trails, size_t count, crease_courses *out)
{
    size_t rank[CREASE_MOST_LINES] = {0};
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < spread->count; i++)
        if (spread->keep[i] > 0.0) {
            low = fmin(low, spread->plane[2 * i + 1]);
            high = fmax(high, spread->plane[2 * i + 1]);
        }
    for (size_t a = 0; a < out->count; a++)
        for (size_t b = 0; b < out->count; b++) {
            if (a == b)
                continue;
            bool before = false, behind = false;
            for (int i = 0; i <= 64; i++) {
                const double y = low + (high - low) * i / 64.0;
                const double gap = crease_course_across(&out->items[b], y) -
                    crease_course_across(&out->items[a], y);
                before = before || gap < CLEAR * spread->spacing;
                behind = behind || gap > -CLEAR * spread->spacing;
            }
            if (before && behind)
                return false;
            rank[a] += before;
        }
    crease_courses sorted = *out;
    for (size_t c = 0; c < out->count; c++)
        sorted.items[rank[c]] = out->items[c];
    for (size_t i = 0; i < count; i++)
        trails[i].course = rank[trails[i].course];
    *out = sorted;
    return true;
}

static void put_in_strips(crease_spread *spread, const crease_courses *courses)
{
    for (size_t i = 0; i < spread->count; i++) {
        size_t strip = 0;
        for (size_t c = 0; c < courses->count; c++)
            strip += spread->plane[2 * i] >
                crease_course_across(&courses->items[c], spread->plane[2 * i + 1]);
        spread->strip[i] = (uint8_t)strip;
    }
}

/* Near a crease the regions of its two sides know better than the plane which side is which. */
static void trust_regions(crease_spread *spread, const crease_courses *courses, const trail *one)
{
    const crease_course *const course = &courses->items[one->course];
    const double near = BESIDE * spread->spacing;
    double side[2] = {0.0, 0.0};
    for (int pass = 0; pass < 2; pass++)
        for (size_t i = 0; i < spread->count; i++) {
            const double *const p = spread->plane + 2 * i;
            const double off = p[0] - crease_course_across(course, p[1]);
            const int which = spread->labels[i] == (int32_t)one->regions[0]
                ? 0
                : (spread->labels[i] == (int32_t)one->regions[1] ? 1 : 2);
            if (!(spread->keep[i] > 0.0) || which == 2 || fabs(off) > 2.0 * near ||
                p[1] < one->plane[1] || p[1] > one->plane[2 * one->count - 1])
                continue;
            if (pass == 0)
                side[which] += off / near;
            else if (fabs(off) < near)
                spread->strip[i] =
                    (uint8_t)(one->course + ((side[1] > side[0]) == (which == 1) ? 1 : 0));
        }
}

static crease_status lay_trails(crease_context *context, const crease_spread *spread,
    const crease_network *network, trail *trails)
{
    crease_tree *tree = NULL;
    crease_status status = crease_tree_create(context, spread->points, spread->count, &tree);
    for (size_t i = 0; i < crease_network_count(network) && status == CREASE_OK; i++) {
        const crease_network_crease crease = crease_network_at(network, i);
        memcpy(trails[i].regions, crease.regions, sizeof crease.regions);
        trails[i].length = crease.length;
        status = lay_trail(
            context, spread, tree, crease_network_curves(network)[i], crease.length, &trails[i]);
        if (status == CREASE_OK)
            smooth(&trails[i]);
    }
    crease_tree_free(tree);
    return status;
}

/* Turns the plane, and keeps the trails that go along its second axis; false when a long one does
 * not. */
static bool align(crease_spread *spread, trail *trails, size_t *count)
{
    const double angle = common_direction(trails, *count);
    const size_t all = *count;
    turn(spread->plane, spread->count, angle);
    *count = 0;
    for (size_t i = 0; i < all; i++) {
        turn(trails[i].plane, trails[i].count, angle);
        if (ascend(&trails[i]))
            trails[(*count)++] = trails[i];
        else if (trails[i].length > SHORT * spread->spacing)
            return false;
    }
    return *count > 0;
}

crease_status crease_courses_find(crease_context *context, crease_spread *spread,
    const crease_network *network, crease_courses *out)
{
    size_t count = crease_network_count(network);
    *out = (crease_courses){.count = 0};
    if (count == 0 || spread->count < NEAR)
        return CREASE_OK;
    for (size_t i = 0; i < count; i++)
        if (crease_network_at(network, i).closed)
            return CREASE_OK;
    trail *const trails = crease_allocate(context, count, sizeof *trails);
    crease_status status =
        trails ? lay_trails(context, spread, network, trails) : CREASE_ERROR_NO_MEMORY;
    bool fine = status == CREASE_OK && align(spread, trails, &count);
    if (fine)
        count = without_doubles(trails, count, CLEAR * spread->spacing);
    if (fine)
        status = join(context, trails, count, spread->spacing, out);
    fine = fine && status == CREASE_OK && out->count <= CREASE_MOST_LINES &&
        in_order(spread, trails, count, out);
    if (fine)
        put_in_strips(spread, out);
    for (size_t i = 0; i < count && fine; i++)
        trust_regions(spread, out, &trails[i]);
    if (!fine)
        crease_courses_clear(out);
    free(trails);
    return status;
}

void crease_courses_clear(crease_courses *courses)
{
    for (size_t c = 0; c < CREASE_MOST_LINES; c++) {
        free(courses->items[c].along);
        free(courses->items[c].across);
    }
    *courses = (crease_courses){.count = 0};
}
