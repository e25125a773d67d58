/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "trim/contour.h"

#include "base/memory.h"
#include "base/vector.h"
#include "trim/bend.h"
#include "trim/smoothing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LEAST_FITTED = 3, MOST_SAMPLES = 1 << 20, MOST_DOUBTED = 60 };

/* In spacings. */
static const double STEP = 0.5;           /* between points of a smooth line */
static const double CORNER_FREEDOM = 3.0; /* parameters that a corner counts for */
static const double GUARD = 0.4;          /* beside a corner: points there say little */
static const double CORNER_REACH = 6.0;   /* from the point taken for the corner to the corner */
static const double SHORT_OF = 0.05;      /* of a corner, where a line's own points end */

struct task {
    crease_context *context;
    const crease_rag *rag;
    double *at, *outward, length;
    size_t corner_count, *corners;
    crease_smooth *lines;    /* between the corners */
    double squares, freedom; /* of the lines */
};

/* -------------------------------------------------------------------------------- measure -- */

/* Where the points are along the border, and which way is out. */
static void measure(struct task *task)
{
    const crease_rag *const rag = task->rag;
    const size_t n = rag->count;
    for (size_t i = 1; i < n; i++)
        task->at[i] = task->at[i - 1] +
            crease_vector_distance(rag->points + 3 * i, rag->points + 3 * (i - 1));
    task->length = task->at[n - 1];
    if (rag->closed)
        task->length += crease_vector_distance(rag->points, rag->points + 3 * (n - 1));
    for (size_t i = 0; i < n; i++) {
        const size_t before = i > 0 ? i - 1 : rag->closed ? n - 1 : 0;
        const size_t after = i + 1 < n ? i + 1 : rag->closed ? 0 : n - 1;
        double along[3];
        for (size_t c = 0; c < 3; c++)
            along[c] = rag->points[3 * after + c] - rag->points[3 * before + c];
        crease_vector_cross(along, rag->normals + 3 * i, task->outward + 3 * i);
        crease_vector_normalise(task->outward + 3 * i);
    }
}

/* -------------------------------------------------------------------------------- fitting -- */

/* The points from number `begin` on, over the end of a closed border, as far as `end` - 1. */
static crease_status fit_between(
    struct task *task, size_t begin, size_t end, bool closed, crease_smooth *out)
{
    const crease_rag *const rag = task->rag;
    const size_t n = rag->count, room = end - begin;
    double *const points = crease_allocate(task->context, room, 7 * sizeof *points);
    if (!points)
        return CREASE_ERROR_NO_MEMORY;
    double *const outward = points + 3 * room, *const at = outward + 3 * room;
    const double first = task->at[begin % n] + (begin >= n ? task->length : 0.0);
    const double last =
        closed ? first + task->length : task->at[(end - 1) % n] + (end > n ? task->length : 0.0);
    const double guard = closed ? -1.0 : fmin(GUARD * rag->spacing, 0.2 * (last - first));
    size_t count = 0;
    for (size_t i = begin; i < end; i++) {
        const double here = task->at[i % n] + (i >= n ? task->length : 0.0);
        const bool guarded =
            (task->corner_count > 0) && (here < first + guard || here > last - guard);
        if (guarded && room > LEAST_FITTED + 2)
            continue;
        memcpy(points + 3 * count, rag->points + 3 * (i % n), 3 * sizeof *points);
        memcpy(outward + 3 * count, task->outward + 3 * (i % n), 3 * sizeof *points);
        at[count++] = here;
    }
    const crease_strip strip = {.count = count,
        .points = points,
        .outward = outward,
        .at = at,
        .begin = first,
        .length = last - first,
        .closed = closed,
        .spacing = rag->spacing};
    const crease_status status = crease_smooth_fit(task->context, &strip, out);
    free(points);
    return status;
}

static size_t line_count(const struct task *task)
{
    if (task->rag->closed)
        return task->corner_count ? task->corner_count : 1;
    return task->corner_count + 1;
}

/* First point of a line, and its last. */
static void range_of(const struct task *task, size_t line, size_t *begin, size_t *end)
{
    const size_t n = task->rag->count, corners = task->corner_count;
    if (task->rag->closed) {
        *begin = corners ? task->corners[line] : 0;
        *end = !corners          ? n
            : line + 1 < corners ? task->corners[line + 1] + 1
                                 : task->corners[0] + n + 1;
    } else {
        *begin = line > 0 ? task->corners[line - 1] : 0;
        *end = line < corners ? task->corners[line] + 1 : n;
    }
}

static void clear_lines(struct task *task)
{
    for (size_t i = 0; task->lines && i < line_count(task); i++)
        crease_smooth_clear(&task->lines[i]);
    free(task->lines);
    task->lines = NULL;
}

static crease_status fit_lines(struct task *task)
{
    const size_t count = line_count(task);
    crease_status status = CREASE_OK;
    task->squares = 0.0;
    task->freedom = CORNER_FREEDOM * (double)task->corner_count;
    task->lines = crease_allocate(task->context, count, sizeof *task->lines);
    if (!task->lines)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < count && status == CREASE_OK; i++) {
        size_t begin, end;
        range_of(task, i, &begin, &end);
        const bool closed = task->rag->closed && task->corner_count == 0;
        status = fit_between(task, begin, end, closed, &task->lines[i]);
        task->squares += task->lines[i].squares;
        task->freedom += task->lines[i].freedom;
    }
    return status;
}

static double cost_of(const struct task *task, double squares, double freedom)
{
    return crease_smooth_cost(squares, freedom, task->rag->count, task->rag->spacing);
}

/* What it costs when one line takes the place of the two beside a corner. */
static crease_status cost_without(struct task *task, size_t corner, double *cost)
{
    const bool closed = task->rag->closed;
    const size_t corners = task->corner_count;
    const size_t before = closed ? (corner + corners - 1) % corners : corner;
    const size_t after = closed ? corner : corner + 1;
    size_t begin, middle, end;
    crease_smooth line = {.size = 0};
    range_of(task, before, &begin, &middle);
    range_of(task, after, &middle, &end);
    if (closed && end < begin + 2)
        end += task->rag->count;
    const crease_status status = before == after
        ? fit_between(task, 0, task->rag->count, true, &line)
        : fit_between(task, begin, end, false, &line);
    const double squares =
        task->lines[before].squares + (before == after ? 0.0 : task->lines[after].squares);
    const double freedom = task->lines[before].freedom +
        (before == after ? 0.0 : task->lines[after].freedom) + CORNER_FREEDOM;
    *cost = cost_of(
        task, task->squares - squares + line.squares, task->freedom - freedom + line.freedom);
    crease_smooth_clear(&line);
    return status;
}

/* Drops the corner that the points ask for least, unless they ask for all of them. */
static crease_status drop_corner(struct task *task, bool *dropped)
{
    double least = cost_of(task, task->squares, task->freedom);
    size_t worst = SIZE_MAX;
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < task->corner_count && status == CREASE_OK; i++) {
        double cost = INFINITY;
        status = cost_without(task, i, &cost);
        if (cost < least) {
            least = cost;
            worst = i;
        }
    }
    *dropped = status == CREASE_OK && worst < SIZE_MAX;
    if (!*dropped)
        return status;
    clear_lines(task);
    task->corner_count--;
    memmove(task->corners + worst, task->corners + worst + 1,
        (task->corner_count - worst) * sizeof *task->corners);
    return fit_lines(task);
}

static crease_status fit_best(struct task *task)
{
    bool dropped = task->corner_count <= MOST_DOUBTED;
    crease_status status = fit_lines(task);
    while (status == CREASE_OK && dropped && task->corner_count > 0)
        status = drop_corner(task, &dropped);
    return status;
}

/* -------------------------------------------------------------------------------- corners -- */

/* Where a line is at its begin or end, and its direction outwards there. */
static void ray_of(
    const crease_smooth *line, double spacing, bool end, double place[3], double out[3])
{
    const double at = end ? line->begin + line->length : line->begin;
    crease_smooth_at(line, at, place);
    crease_smooth_at(line, end ? at + spacing : at - spacing, out);
    for (int c = 0; c < 3; c++)
        out[c] -= place[c];
    crease_vector_normalise(out);
}

/* Between the closest points of two rays; false where they run alike or meet too far away. */
static bool meet(const double p[3], const double a[3], const double q[3], const double b[3],
    double reach, double out[3])
{
    const double d[3] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
    const double ab = crease_vector_dot(a, b), sine = 1.0 - ab * ab;
    if (sine < 0.01)
        return false;
    const double x = (crease_vector_dot(d, a) - ab * crease_vector_dot(d, b)) / sine;
    const double y = (ab * crease_vector_dot(d, a) - crease_vector_dot(d, b)) / sine;
    for (int c = 0; c < 3; c++)
        out[c] = 0.5 * (p[c] + x * a[c] + q[c] + y * b[c]);
    return fabs(x) < reach && fabs(y) < reach;
}

static void place_corner(
    const struct task *task, size_t before, size_t after, size_t corner, double out[3])
{
    const double s = task->rag->spacing;
    double p[3], a[3], q[3], b[3];
    ray_of(&task->lines[before], s, true, p, a);
    ray_of(&task->lines[after], s, false, q, b);
    if (!meet(p, a, q, b, CORNER_REACH * s, out))
        memcpy(out, task->rag->points + 3 * corner, 3 * sizeof *out);
}

/* -------------------------------------------------------------------------------- points -- */

static bool is_beyond(
    const double place[3], const double corner[3], const double towards[3], double margin)
{
    const double d[3] = {corner[0] - place[0], corner[1] - place[1], corner[2] - place[2]};
    return crease_vector_dot(d, towards) < margin;
}

/* A line's points between two places, NULL where it keeps its own end. */
static crease_status sample(struct task *task, const crease_smooth *line, const double *first,
    const double *last, crease_stretch *out)
{
    const double s = task->rag->spacing, steps = ceil(line->length / (STEP * s));
    const size_t count = steps < 2.0 ? 2 : steps < MOST_SAMPLES ? (size_t)steps : MOST_SAMPLES;
    double p[3], back[3], q[3], on[3];
    ray_of(line, s, false, p, back);
    ray_of(line, s, true, q, on);
    out->points = crease_allocate(task->context, count + 3, 3 * sizeof *out->points);
    out->room = count + 3;
    if (!out->points)
        return CREASE_ERROR_NO_MEMORY;
    if (first)
        memcpy(out->points + 3 * out->count++, first, 3 * sizeof *first);
    for (size_t i = 0; i <= count; i++) {
        double *const place = out->points + 3 * out->count;
        const double at = line->length * (double)i / (double)count;
        crease_smooth_at(line, line->begin + at, place);
        const bool early = first && at < CORNER_REACH * s;
        const bool late = last && at > line->length - CORNER_REACH * s;
        const bool keep = !(early && is_beyond(place, first, back, SHORT_OF * s)) &&
            !(late && is_beyond(place, last, on, SHORT_OF * s));
        out->count += keep;
    }
    if (last)
        memcpy(out->points + 3 * out->count++, last, 3 * sizeof *last);
    return CREASE_OK;
}

static crease_status make_stretches(struct task *task, crease_contour *out)
{
    const size_t count = line_count(task), corners = task->corner_count;
    const bool closed = task->rag->closed;
    double *const places = crease_allocate(task->context, corners, 3 * sizeof *places);
    out->items = crease_allocate(task->context, count, sizeof *out->items);
    out->closed = closed;
    crease_status status = places && out->items ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < corners && status == CREASE_OK; i++)
        place_corner(task, closed ? (i + corners - 1) % corners : i, closed ? i : i + 1,
            task->corners[i], places + 3 * i);
    for (size_t i = 0; i < count && status == CREASE_OK; i++) {
        const double *first = NULL, *last = NULL;
        if (closed && corners) {
            first = places + 3 * i;
            last = places + 3 * ((i + 1) % corners);
        } else if (!closed) {
            first = i > 0 ? places + 3 * (i - 1) : NULL;
            last = i < corners ? places + 3 * i : NULL;
        }
        status = sample(task, &task->lines[i], first, last, &out->items[i]);
        out->count = i + 1;
    }
    free(places);
    return status;
}

crease_status crease_contour_fit(
    crease_context *context, const crease_rag *rag, crease_contour *out)
{
    struct task task = {.context = context, .rag = rag};
    const size_t n = rag->count;
    *out = (crease_contour){.count = 0};
    task.at = crease_allocate(context, n, sizeof *task.at);
    task.outward = crease_allocate(context, n, 3 * sizeof *task.outward);
    task.corners = crease_allocate(context, n, sizeof *task.corners);
    crease_status status =
        task.at && task.outward && task.corners ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK) {
        measure(&task);
        task.corner_count = crease_bends_find(rag, task.at, task.length, task.corners);
        status = fit_best(&task);
    }
    if (status == CREASE_OK)
        status = make_stretches(&task, out);
    if (status != CREASE_OK)
        crease_contour_clear(out);
    clear_lines(&task);
    free(task.at);
    free(task.outward);
    free(task.corners);
    return status;
}

void crease_contour_clear(crease_contour *contour)
{
    for (size_t i = 0; contour->items && i < contour->count; i++)
        free(contour->items[i].points);
    free(contour->items);
    *contour = (crease_contour){.count = 0};
}
