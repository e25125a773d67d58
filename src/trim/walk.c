/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Loops of edges are walked around, the face on their left; those that turn the other way are
 * around holes. */
#include "trim/walk.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double TURN = 6.283185307179586476925;
static const double BORDER = 0.25; /* share of a sliver's length */
#define NONE UINT32_MAX

/* ----------------------------------------------------------------------------------- loops -- */

struct walk {
    size_t *first; /* of the halves that leave a node, node_count + 1 */
    crease_overlay_half *leaving;
    bool *passed; /* halves */
};

static uint32_t node_of(const crease_overlay *o, crease_overlay_half half, int end)
{
    return o->edges[half / 2].nodes[(half & 1) ? 1 - end : end];
}

/* Faces are on both sides of cuts, and on the left of arcs. */
static bool bounds(const crease_overlay *o, crease_overlay_half half)
{
    return o->edges[half / 2].direction >= 0 || !(half & 1);
}

/* Direction in which a half leaves its first node, or comes to its last one, seen from there. */
static double heading(const crease_overlay *o, crease_overlay_half half, bool at_end)
{
    const crease_overlay_edge *const e = &o->edges[half / 2];
    const bool last = at_end != ((half & 1) != 0);
    const double *const p = o->places + 2 * (e->first + (last ? e->count - 1 : 0));
    const double *const q = last ? p - 2 : p + 2;
    return atan2(q[1] - p[1], q[0] - p[0]);
}

static crease_status find_leaving(crease_context *context, const crease_overlay *o, struct walk *w)
{
    w->first = crease_allocate(context, o->node_count + 2, sizeof *w->first);
    w->leaving = crease_allocate(context, 2 * o->edge_count, sizeof *w->leaving);
    w->passed = crease_allocate(context, 2 * o->edge_count, sizeof *w->passed);
    if (!w->first || !w->leaving || !w->passed)
        return CREASE_ERROR_NO_MEMORY;
    size_t *const next = w->first + 1; /* where the next half of a node goes */
    for (crease_overlay_half h = 0; h < 2 * o->edge_count; h++)
        if (bounds(o, h))
            next[node_of(o, h, 0) + 1]++;
    for (size_t i = 1; i <= o->node_count; i++)
        next[i] += next[i - 1];
    for (crease_overlay_half h = 0; h < 2 * o->edge_count; h++)
        if (bounds(o, h))
            w->leaving[next[node_of(o, h, 0)]++] = h;
    return CREASE_OK;
}

/* The half that goes on along the face on the left: the next one clockwise from the way back. */
static crease_overlay_half next_half(
    const crease_overlay *o, const struct walk *w, crease_overlay_half half)
{
    const uint32_t node = node_of(o, half, 1);
    const double back = heading(o, half, true);
    double least = INFINITY;
    crease_overlay_half next = NONE;
    for (size_t i = w->first[node]; i < w->first[node + 1]; i++) {
        const crease_overlay_half other = w->leaving[i];
        if (other == (half ^ 1U))
            continue;
        double by = back - heading(o, other, false);
        by += by <= 0.0 ? TURN : 0.0;
        if (by < least) {
            least = by;
            next = other;
        }
    }
    return next;
}

static crease_status walk_loops(crease_context *context, crease_overlay *o, bool *sound)
{
    struct walk w = {.first = NULL};
    crease_status status = find_leaving(context, o, &w);
    o->halves = crease_allocate(context, 2 * o->edge_count, sizeof *o->halves);
    o->first_half = crease_allocate(context, 2 * o->edge_count + 1, sizeof *o->first_half);
    if (status == CREASE_OK && (!o->halves || !o->first_half))
        status = CREASE_ERROR_NO_MEMORY;
    for (crease_overlay_half h = 0; status == CREASE_OK && *sound && h < 2 * o->edge_count; h++) {
        if (!bounds(o, h) || w.passed[h])
            continue;
        crease_overlay_half at = h;
        do {
            w.passed[at] = true;
            o->halves[o->half_count++] = at;
            at = next_half(o, &w, at);
        } while (at != NONE && !w.passed[at]);
        *sound = at == h;
        o->first_half[++o->loop_count] = o->half_count;
    }
    free(w.first);
    free(w.leaving);
    free(w.passed);
    return status;
}

/* ----------------------------------------------------------------------------------- faces -- */

struct measure {
    double area, length, low[2], high[2];
    double border; /* length, as far as it is no cut */
};

static struct measure measure_loop(const crease_overlay *o, size_t loop)
{
    struct measure m = {.low = {INFINITY, INFINITY}, .high = {-INFINITY, -INFINITY}};
    for (size_t i = o->first_half[loop]; i < o->first_half[loop + 1]; i++) {
        const crease_overlay_edge *const e = &o->edges[o->halves[i] / 2];
        const double sign = (o->halves[i] & 1) ? -1.0 : 1.0;
        for (size_t k = 0; k + 1 < e->count; k++) {
            const double *const p = o->places + 2 * (e->first + k);
            m.area += sign * 0.5 * (p[0] * p[3] - p[2] * p[1]);
            const double length = hypot(p[2] - p[0], p[3] - p[1]);
            m.length += length;
            m.border += e->direction < 0 ? length : 0.0;
            for (int d = 0; d < 2; d++) {
                m.low[d] = fmin(m.low[d], fmin(p[d], p[2 + d]));
                m.high[d] = fmax(m.high[d], fmax(p[d], p[2 + d]));
            }
        }
    }
    return m;
}

/* Whether a place is inside a loop: a ray to the right crosses it an odd number of times. */
static bool encloses(const crease_overlay *o, size_t loop, const double place[2])
{
    bool inside = false;
    for (size_t i = o->first_half[loop]; i < o->first_half[loop + 1]; i++) {
        const crease_overlay_edge *const e = &o->edges[o->halves[i] / 2];
        for (size_t k = 0; k + 1 < e->count; k++) {
            const double *const p = o->places + 2 * (e->first + k), *const q = p + 2;
            if ((p[1] > place[1]) != (q[1] > place[1]) &&
                place[0] < p[0] + (place[1] - p[1]) / (q[1] - p[1]) * (q[0] - p[0]))
                inside = !inside;
        }
    }
    return inside;
}

/* The smallest loop around a hole; SIZE_MAX: none. */
static size_t around(const crease_overlay *o, const struct measure *measures, size_t hole)
{
    const crease_overlay_edge *const e = &o->edges[o->halves[o->first_half[hole]] / 2];
    const double *const place = o->places + 2 * e->first;
    size_t best = SIZE_MAX;
    for (size_t i = 0; i < o->loop_count; i++)
        if (measures[i].area > 0.0 &&
            (best == SIZE_MAX || measures[i].area < measures[best].area) && encloses(o, i, place))
            best = i;
    return best;
}

static size_t cell_of(const crease_cuts *cuts, int direction, double at)
{
    size_t cell = 0;
    while (cell < cuts->count[direction] && at > cuts->at[direction][cell])
        cell++;
    return cell;
}

/* Puts the loops in the order of their faces. outer: of each loop, itself or the one around it. */
static crease_status sort_loops(crease_context *context, crease_overlay *o, const size_t *outer,
    const struct measure *measures, const crease_cuts *cuts)
{
    crease_overlay_half *const halves = crease_allocate(context, o->half_count, sizeof *halves);
    size_t *const first = crease_allocate(context, o->loop_count + 1, sizeof *first);
    o->faces = crease_allocate(context, o->loop_count, sizeof *o->faces);
    if (!halves || !first || !o->faces) {
        free(halves);
        free(first);
        return CREASE_ERROR_NO_MEMORY;
    }
    size_t loops = 0, n = 0;
    for (size_t i = 0; i < o->loop_count; i++) {
        if (outer[i] != i)
            continue;
        crease_overlay_face *const face = &o->faces[o->face_count++];
        face->first_loop = loops;
        for (int d = 0; d < 2; d++)
            face->cell[d] = cell_of(cuts, d, 0.5 * (measures[i].low[d] + measures[i].high[d]));
        for (size_t pass = 0; pass < 2; pass++)
            for (size_t k = pass ? 0 : i; k < (pass ? o->loop_count : i + 1); k++) {
                if (outer[k] != i || (pass && k == i))
                    continue;
                const size_t size = o->first_half[k + 1] - o->first_half[k];
                memcpy(halves + n, o->halves + o->first_half[k], size * sizeof *halves);
                first[++loops] = n += size;
                face->loop_count++;
            }
    }
    free(o->halves);
    free(o->first_half);
    o->halves = halves;
    o->first_half = first;
    o->half_count = n;
    o->loop_count = loops;
    return CREASE_OK;
}

/* A narrow face along the border is left out; one between two cuts would leave a gap there. */
static bool is_sliver(const struct measure *m, double least_width)
{
    return 2.0 * m->area < least_width * m->length && m->border > BORDER * m->length;
}

static crease_status find_faces(crease_context *context, crease_overlay *o, const crease_cuts *cuts,
    double least_width, bool *sound)
{
    struct measure *const measures = crease_allocate(context, o->loop_count, sizeof *measures);
    size_t *const outer = crease_allocate(context, o->loop_count, sizeof *outer);
    crease_status status = measures && outer ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < o->loop_count && status == CREASE_OK; i++)
        measures[i] = measure_loop(o, i);
    for (size_t i = 0; i < o->loop_count && status == CREASE_OK; i++) {
        outer[i] = measures[i].area > 0.0 ? i : around(o, measures, i);
        *sound = *sound && outer[i] < SIZE_MAX;
    }
    for (size_t i = 0; i < o->loop_count && status == CREASE_OK; i++)
        if (outer[i] == i && is_sliver(&measures[i], least_width))
            outer[i] = SIZE_MAX;
    for (size_t i = 0; i < o->loop_count && status == CREASE_OK && *sound; i++)
        if (measures[i].area <= 0.0 && outer[outer[i]] != outer[i])
            outer[i] = SIZE_MAX;
    if (status == CREASE_OK && *sound)
        status = sort_loops(context, o, outer, measures, cuts);
    *sound = *sound && o->face_count > 0;
    free(measures);
    free(outer);
    return status;
}

/* Leaves out edges without a face, and nodes without an edge. */
static crease_status tidy(crease_context *context, crease_overlay *o)
{
    uint32_t *const edges = crease_allocate(context, o->edge_count, sizeof *edges);
    uint32_t *const nodes = crease_allocate(context, o->node_count, sizeof *nodes);
    crease_status status = edges && nodes ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    size_t edge_count = 0, node_count = 0;
    for (size_t f = 0; f < o->face_count && status == CREASE_OK; f++) {
        const crease_overlay_face *const face = &o->faces[f];
        const size_t last = o->first_half[face->first_loop + face->loop_count];
        for (size_t i = o->first_half[face->first_loop]; i < last; i++)
            o->edges[o->halves[i] / 2].faces[o->halves[i] & 1] = (int32_t)f;
    }
    for (size_t i = 0; i < o->node_count && status == CREASE_OK; i++)
        nodes[i] = NONE;
    for (size_t e = 0; e < o->edge_count && status == CREASE_OK; e++) {
        crease_overlay_edge edge = o->edges[e];
        if (edge.faces[0] < 0 && edge.faces[1] < 0)
            continue;
        nodes[edge.nodes[0]] = nodes[edge.nodes[1]] = 0;
        edges[e] = (uint32_t)edge_count;
        o->edges[edge_count++] = edge;
    }
    for (size_t i = 0; i < o->node_count && status == CREASE_OK; i++)
        if (nodes[i] != NONE) {
            memmove(o->nodes + 2 * node_count, o->nodes + 2 * i, 2 * sizeof *o->nodes);
            nodes[i] = (uint32_t)node_count++;
        }
    for (size_t i = 0; i < o->half_count && status == CREASE_OK; i++)
        o->halves[i] = 2 * edges[o->halves[i] / 2] + (o->halves[i] & 1);
    for (size_t e = 0; e < edge_count && status == CREASE_OK; e++)
        for (int end = 0; end < 2; end++)
            o->edges[e].nodes[end] = nodes[o->edges[e].nodes[end]];
    if (status == CREASE_OK) {
        o->edge_count = edge_count;
        o->node_count = node_count;
    }
    free(edges);
    free(nodes);
    return status;
}

crease_status crease_walk_faces(crease_context *context, const crease_cuts *cuts,
    double least_width, crease_overlay *overlay, bool *sound)
{
    *sound = true;
    crease_status status = walk_loops(context, overlay, sound);
    if (status == CREASE_OK && *sound)
        status = find_faces(context, overlay, cuts, least_width, sound);
    if (status == CREASE_OK && *sound)
        status = tidy(context, overlay);
    return status;
}
