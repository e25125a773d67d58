/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Orthogonal projection by branch and bound. The surface is cut into its Bezier patches, which lie
 * in a tree of boxes. A patch that may hold something nearer than what has been found is given as
 * the polynomial of the squared distance in Bernstein form: it is dropped when its coefficients are
 * too large, reduced to a side where it is monotone, finished by Newton's method where it is convex
 * and halved otherwise. So what is found is the closest point of all, to a relative 1e-10 of the
 * distance, unless a place is equally far from so much of the surface (the centre of a sphere) that
 * MOST_BOXES are used up; then it is the best of those.
 *
 * Based on: Chen, Yong, Wang, Paul, Xu. Computing the minimum distance between a point and a NURBS
 * curve. 2008 (squared distance in Bernstein form); Ratschek, Rokne. New computer methods for
 * global optimization. 1988 (monotonicity and convexity tests). */
#include "spline/project.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "spline/basis.h"
#include "spline/bernstein.h"
#include "spline/bezier.h"
#include "spline/curve.h"
#include "spline/newton.h"
#include "spline/surface.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    GRAIN = 64,
    ENCLOSED_AT_ONCE = 4096,
    MOST_BOXES = 2000,
    STACK_BOXES = 80,
    STACK_NODES = 128
};

static const double SMALL_BOX = 1e-6;

/* A box that holds the patches first..last - 1 along u and v. */
typedef struct node {
    double lowest[3], highest[3];
    size_t first[2], last[2];
    size_t children[2]; /* 0 for a single patch */
} node;

struct crease_projector {
    const crease_surface *surface; /* or NULL */
    const crease_curve *curve;     /* or NULL */
    crease_bezier bezier;
    node *nodes;
    size_t node_count;
};

/* What a worker needs besides. */
typedef struct scratch {
    double patch[3 * CREASE_ORDER_MAX * CREASE_ORDER_MAX];
    crease_box boxes[STACK_BOXES];
    double *coefficients;
} scratch;

typedef struct found {
    double squared;
    double at[2];    /* within the patch */
    size_t patch[2]; /* number of the span in each direction */
} found;

/* ---------------------------------------------------------------------------------- tree -- */

static void enclose_patch(const crease_projector *p, node *leaf)
{
    static const double origin[3] = {0};
    double points[3 * CREASE_ORDER_MAX * CREASE_ORDER_MAX];
    crease_bezier_patch(&p->bezier, leaf->first, origin, points);
    for (int i = 0; i < 3 * p->bezier.parts.order[0] * p->bezier.parts.order[1]; i++) {
        double *const low = &leaf->lowest[i % 3], *const high = &leaf->highest[i % 3];
        *low = i < 3 || points[i] < *low ? points[i] : *low;
        *high = i < 3 || points[i] > *high ? points[i] : *high;
    }
}

static void enclose_some(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const crease_projector *const p = user;
    for (size_t i = begin; i < end; i++)
        if (!p->nodes[i].children[0])
            enclose_patch(p, &p->nodes[i]);
}

/* Children come after their parents. */
static void enclose_children(const crease_projector *p)
{
    for (size_t i = p->node_count; i-- > 0;) {
        node *const here = &p->nodes[i];
        if (!here->children[0])
            continue;
        const node *const a = &p->nodes[here->children[0]], *const b = &p->nodes[here->children[1]];
        for (int c = 0; c < 3; c++) {
            here->lowest[c] = a->lowest[c] < b->lowest[c] ? a->lowest[c] : b->lowest[c];
            here->highest[c] = a->highest[c] > b->highest[c] ? a->highest[c] : b->highest[c];
        }
    }
}

/* Makes the node that holds a rectangle of patches and all below it, without their boxes; returns
 * its number. The depth is that of halving twice a 32-bit count. */
static size_t grow(crease_projector *p, const size_t first[2], const size_t last[2])
{
    const size_t number = p->node_count++;
    node *const here = &p->nodes[number];
    memcpy(here->first, first, sizeof here->first);
    memcpy(here->last, last, sizeof here->last);
    const int longer = last[1] - first[1] > last[0] - first[0];
    if (last[longer] - first[longer] == 1)
        return number;
    const size_t middle = first[longer] + (last[longer] - first[longer]) / 2;
    size_t lower_last[2] = {last[0], last[1]};
    size_t upper_first[2] = {first[0], first[1]};
    lower_last[longer] = upper_first[longer] = middle;
    here->children[0] = grow(p, first, lower_last);
    here->children[1] = grow(p, upper_first, last);
    return number;
}

static void release(crease_projector *p)
{
    crease_bezier_release(&p->bezier);
    free(p->nodes);
}

static crease_status prepare(
    crease_context *context, const crease_surface_parts *parts, crease_projector *p)
{
    crease_status status = crease_bezier_prepare(context, parts, &p->bezier);
    if (status != CREASE_OK)
        return status;
    const size_t patches = p->bezier.span_count[0] * p->bezier.span_count[1];
    p->nodes = crease_allocate(context, 2 * patches, sizeof *p->nodes);
    if (p->nodes) {
        grow(p, (const size_t[2]){0, 0}, p->bezier.span_count);
        status = crease_parallel_for(context, p->node_count, ENCLOSED_AT_ONCE, enclose_some, p);
    } else {
        status = CREASE_ERROR_NO_MEMORY;
    }
    if (status == CREASE_OK)
        enclose_children(p);
    else
        release(p);
    return status;
}

/* -------------------------------------------------------------------------------- search -- */

static double squared_distance_to_node(const node *n, const double place[3])
{
    double squared = 0.0;
    for (int c = 0; c < 3; c++) {
        const double outside = fmax(fmax(n->lowest[c] - place[c], place[c] - n->highest[c]), 0.0);
        squared += outside * outside;
    }
    return squared;
}

static bool hopeless(double least, double rounding, double best)
{
    return least - rounding >= best * (1.0 - 1e-10);
}

static void descend(
    const crease_patch *patch, const crease_box *box, const size_t number[2], found *best)
{
    double at[2];
    crease_box_guess(box, at);
    const double squared = crease_newton_descend(patch, box->lowest, box->highest, at);
    if (squared < best->squared)
        *best = (found){squared, {at[0], at[1]}, {number[0], number[1]}};
}

static bool settled(const crease_box *box, int used)
{
    const bool small = box->highest[0] - box->lowest[0] < SMALL_BOX &&
        box->highest[1] - box->lowest[1] < SMALL_BOX;
    return small || used >= MOST_BOXES || crease_box_convex(box);
}

/* Searches one patch; *used counts the boxes looked at for this place. */
static void search_patch(const crease_projector *p, const size_t number[2], const double place[3],
    scratch *s, int *used, found *best)
{
    crease_bezier_patch(&p->bezier, number, place, s->patch);
    const crease_patch patch = {
        .degree = {p->bezier.parts.order[0] - 1, p->bezier.parts.order[1] - 1}, .points = s->patch};
    crease_box_of_patch(&patch, &s->boxes[0]);
    if (hopeless(s->boxes[0].least, s->boxes[0].rounding, best->squared))
        return;
    descend(&patch, &s->boxes[0], number, best);
    for (int depth = crease_box_convex(&s->boxes[0]) ? 0 : 1; depth > 0;) {
        crease_box *const box = &s->boxes[depth - 1];
        if (!hopeless(box->least, box->rounding, best->squared))
            crease_box_reduce(box);
        if (hopeless(box->least, box->rounding, best->squared)) {
            depth--;
        } else if (depth == STACK_BOXES || settled(box, *used)) {
            descend(&patch, box, number, best);
            depth--;
        } else {
            crease_box_halve(box, &s->boxes[depth]);
            if (box->least < s->boxes[depth].least) {
                const crease_box lower = *box;
                *box = s->boxes[depth];
                s->boxes[depth] = lower;
            }
            depth++;
            *used += 1;
        }
    }
}

/* Nearer child on top of the stack, so that the bound falls early. */
static found search(const crease_projector *p, const double place[3], scratch *s)
{
    struct {
        double squared;
        size_t node;
    } stack[STACK_NODES];
    found best = {.squared = INFINITY};
    int used = 0;
    stack[0].squared = squared_distance_to_node(&p->nodes[0], place);
    stack[0].node = 0;
    for (int depth = 1; depth > 0;) {
        depth--;
        const node *const here = &p->nodes[stack[depth].node];
        if (hopeless(stack[depth].squared, 0.0, best.squared))
            continue;
        if (!here->children[0]) {
            search_patch(p, here->first, place, s, &used, &best);
            continue;
        }
        double squared[2];
        for (int c = 0; c < 2; c++)
            squared[c] = squared_distance_to_node(&p->nodes[here->children[c]], place);
        const int nearer = squared[1] < squared[0];
        for (int c = 0; c < 2; c++, depth++) {
            const int child = c == 0 ? 1 - nearer : nearer;
            stack[depth].squared = squared[child];
            stack[depth].node = here->children[child];
        }
    }
    return best;
}

/* Takes the border of the patch when it is as near, so that a foot on a crease is on it exactly,
 * also where repeated control points make the parametrisation stand still. */
static void snap(const crease_patch *patch, found *best)
{
    const double close = 1e-3;
    for (int d = 0; d < 2; d++) {
        if (best->at[d] > close && best->at[d] < 1.0 - close)
            continue;
        double at[2] = {best->at[0], best->at[1]};
        at[d] = best->at[d] < 0.5 ? 0.0 : 1.0;
        crease_patch_point point;
        crease_patch_evaluate(patch, at, &point);
        double squared = 0.0;
        double size = 0.0;
        for (int c = 0; c < 3; c++) {
            squared += point.s[c] * point.s[c];
            size = fmax(size, fabs(patch->points[c]));
        }
        if (squared <= best->squared * (1.0 + 1e-14) + 1e-30 * size * size)
            best->at[d] = at[d];
    }
}

/* The last digits: once more from the best, free in its whole patch. */
static void polish(const crease_projector *p, const double place[3], scratch *s, found *best)
{
    static const double lowest[2] = {0.0, 0.0};
    static const double highest[2] = {1.0, 1.0};
    crease_bezier_patch(&p->bezier, best->patch, place, s->patch);
    const crease_patch patch = {
        .degree = {p->bezier.parts.order[0] - 1, p->bezier.parts.order[1] - 1}, .points = s->patch};
    double at[2] = {best->at[0], best->at[1]};
    const double squared = crease_newton_descend(&patch, lowest, highest, at);
    if (squared <= best->squared) {
        best->squared = squared;
        memcpy(best->at, at, sizeof at);
    }
    snap(&patch, best);
}

static void locate(
    const crease_projector *p, const double place[3], scratch *s, found *best, double uv[2])
{
    *best = search(p, place, s);
    polish(p, place, s, best);
    for (int d = 0; d < 2; d++) {
        const double *const ends = p->bezier.spans[d][best->patch[d]].ends;
        uv[d] = best->at[d] >= 1.0 ? ends[1] : ends[0] + best->at[d] * (ends[1] - ends[0]);
    }
}

/* -------------------------------------------------------------------------------- threads -- */

typedef struct work {
    const crease_projector *projector;
    scratch *scratches; /* one per thread */
    const double *points;
    crease_foot *feet;
} work;

/* The sum of the unit normals on all sides of a foot: at a crease the normal of neither side alone
 * tells in and out.
 * Based on: Baerentzen, Aanaes. Signed distance computation using the angle weighted pseudonormal.
 * 2005. */
static void sum_normals(
    const crease_surface *surface, const found *best, const double uv[2], double sum[3])
{
    bool both[2];
    crease_side side[2];
    for (int d = 0; d < 2; d++) {
        both[d] = best->at[d] <= 0.0 || best->at[d] >= 1.0;
        side[d] = best->at[d] >= 1.0 ? CREASE_SIDE_LEFT : CREASE_SIDE_RIGHT;
    }
    sum[0] = sum[1] = sum[2] = 0.0;
    for (int i = 0; i < 4; i++) {
        if ((i % 2 && !both[0]) || (i / 2 && !both[1]))
            continue;
        const crease_side sides[2] = {i % 2 ? !side[0] : side[0], i / 2 ? !side[1] : side[1]};
        double normal[3];
        crease_surface_normal(surface, uv, sides, normal);
        for (int c = 0; c < 3; c++)
            sum[c] += normal[c];
    }
}

static void finish_foot(const work *w, const found *best, const double place[3], crease_foot *foot)
{
    double sum[3] = {0};
    const crease_projector *const p = w->projector;
    if (p->surface) {
        crease_surface_point(p->surface, foot->uv, foot->point);
        sum_normals(p->surface, best, foot->uv, sum);
    } else {
        crease_curve_evaluate(p->curve, foot->uv[0], CREASE_SIDE_RIGHT, 0, foot->point);
    }
    double squared = 0.0;
    double along = 0.0;
    for (int c = 0; c < 3; c++) {
        const double way = place[c] - foot->point[c];
        squared += way * way;
        along += way * sum[c];
    }
    foot->distance = along < 0.0 ? -sqrt(squared) : sqrt(squared);
}

static void project_some(void *user, size_t begin, size_t end, int worker)
{
    const work *const w = user;
    for (size_t i = begin; i < end; i++) {
        const double *const place = w->points + 3 * i;
        found best;
        locate(w->projector, place, &w->scratches[worker], &best, w->feet[i].uv);
        finish_foot(w, &best, place, &w->feet[i]);
    }
}

static crease_status make_scratches(crease_context *context, work *w, double **coefficients)
{
    const size_t threads = (size_t)crease_context_threads(context);
    const size_t size = (size_t)(2 * w->projector->bezier.parts.order[0] - 1) *
        (size_t)(2 * w->projector->bezier.parts.order[1] - 1);
    w->scratches = crease_allocate(context, threads, sizeof *w->scratches);
    *coefficients = crease_allocate(context, threads * STACK_BOXES * size, sizeof(double));
    if (!w->scratches || !*coefficients)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < threads * STACK_BOXES; i++)
        w->scratches[i / STACK_BOXES].boxes[i % STACK_BOXES].coefficients =
            *coefficients + i * size;
    return CREASE_OK;
}

static crease_status project(crease_context *context, work *w, size_t count)
{
    double *coefficients = NULL;
    crease_status status = make_scratches(context, w, &coefficients);
    if (status == CREASE_OK) {
        crease_stage(context, "projection");
        status = crease_parallel_for(context, count, GRAIN, project_some, w);
    }
    free(coefficients);
    free(w->scratches);
    return status;
}

static crease_status check(crease_context *context, const double *points, size_t count)
{
    for (size_t i = 0; i < 3 * count; i++)
        if (!isfinite(points[i]))
            return crease_fail(context, CREASE_ERROR_VALUE,
                "projection: point %zu is not finite; remove such points", i / 3);
    return CREASE_OK;
}

crease_status crease_projector_create(
    crease_context *context, const crease_surface *surface, crease_projector **out)
{
    const crease_surface_parts parts = crease_surface_parts_of(surface);
    *out = NULL;
    crease_projector *const p = crease_allocate(context, 1, sizeof *p);
    if (!p)
        return CREASE_ERROR_NO_MEMORY;
    p->surface = surface;
    const crease_status status = prepare(context, &parts, p);
    if (status == CREASE_OK)
        *out = p;
    else
        free(p);
    return status;
}

void crease_projector_free(crease_projector *projector)
{
    if (projector)
        release(projector);
    free(projector);
}

crease_status crease_projector_project(crease_context *context, const crease_projector *projector,
    const double *points, size_t count, crease_foot *feet)
{
    work w = {.projector = projector, .points = points, .feet = feet};
    const crease_status status = check(context, points, count);
    return status == CREASE_OK ? project(context, &w, count) : status;
}

crease_status crease_surface_project(crease_context *context, const crease_surface *surface,
    const double *points, size_t count, crease_foot *feet)
{
    crease_projector *projector = NULL;
    crease_status status = check(context, points, count);
    if (status == CREASE_OK)
        status = crease_projector_create(context, surface, &projector);
    if (status == CREASE_OK)
        status = crease_projector_project(context, projector, points, count, feet);
    crease_projector_free(projector);
    return status;
}

crease_status crease_curve_project(crease_context *context, const crease_curve *curve,
    const double *points, size_t count, crease_foot *feet)
{
    static const double across[2] = {0.0, 1.0};
    const crease_surface_parts parts = {.order = {curve->order, 1},
        .count = {curve->count, 1},
        .knots = {curve->knots, across},
        .control_points = curve->control_points};
    crease_projector p = {.curve = curve};
    work w = {.projector = &p, .points = points, .feet = feet};
    crease_status status = check(context, points, count);
    if (status == CREASE_OK)
        status = prepare(context, &parts, &p);
    if (status == CREASE_OK) {
        status = project(context, &w, count);
        release(&p);
    }
    for (size_t i = 0; i < count && status == CREASE_OK; i++)
        feet[i].uv[1] = 0.0;
    return status;
}
