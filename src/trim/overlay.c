/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Arcs are cut where they cross the cuts; the cuts are inside between one crossing and the next. */
#include "trim/overlay.h"

#include "base/memory.h"
#include "trim/walk.h"

#include <stdlib.h>
#include <string.h>

static const double AT_END = 1e-9; /* of a side: a crossing there is at its end */
#define NONE UINT32_MAX

/* Where the border crosses a cut. */
struct crossing {
    int direction;
    size_t cut;
    double along;
    uint32_t node;
};

struct task {
    crease_context *context;
    const crease_frontier *frontier;
    const crease_cuts *cuts;
    crease_overlay *out;
    size_t crossing_count, crossing_room;
    struct crossing *crossings;
    uint32_t *meetings; /* nodes where two cuts cross, count[0] x count[1], or NONE */
    bool sound;
};

/* ----------------------------------------------------------------------------------- lists -- */

/* Makes room for one element more. */
static crease_status make_room(
    crease_context *context, size_t count, size_t *room, void **items, size_t size)
{
    if (count < *room)
        return CREASE_OK;
    const size_t more = 2 * *room + 64;
    void *const block = crease_reallocate(context, *items, more, size);
    if (!block)
        return CREASE_ERROR_NO_MEMORY;
    *items = block;
    *room = more;
    return CREASE_OK;
}

static crease_status add_node(struct task *task, const double place[2], uint32_t *node)
{
    crease_overlay *const o = task->out;
    void *items = o->nodes;
    const crease_status status =
        make_room(task->context, o->node_count, &o->node_room, &items, 2 * sizeof *o->nodes);
    o->nodes = items;
    if (status != CREASE_OK)
        return status;
    memcpy(o->nodes + 2 * o->node_count, place, 2 * sizeof *place);
    *node = (uint32_t)o->node_count++;
    return CREASE_OK;
}

/* Appends a place to the last edge. */
static crease_status add_place(struct task *task, const double place[2])
{
    crease_overlay *const o = task->out;
    void *items = o->places;
    const crease_status status =
        make_room(task->context, o->place_count, &o->place_room, &items, 2 * sizeof *o->places);
    o->places = items;
    if (status != CREASE_OK)
        return status;
    memcpy(o->places + 2 * o->place_count++, place, 2 * sizeof *place);
    o->edges[o->edge_count - 1].count++;
    return CREASE_OK;
}

/* Begins an edge at a node. */
static crease_status begin_edge(struct task *task, int direction, uint32_t node)
{
    crease_overlay *const o = task->out;
    void *items = o->edges;
    crease_status status =
        make_room(task->context, o->edge_count, &o->edge_room, &items, sizeof *o->edges);
    o->edges = items;
    if (status != CREASE_OK)
        return status;
    o->edges[o->edge_count++] = (crease_overlay_edge){
        .direction = direction, .first = o->place_count, .nodes = {node, NONE}, .faces = {-1, -1}};
    return add_place(task, o->nodes + 2 * (size_t)node);
}

static crease_status end_edge(struct task *task, uint32_t node)
{
    crease_overlay *const o = task->out;
    o->edges[o->edge_count - 1].nodes[1] = node;
    return add_place(task, o->nodes + 2 * (size_t)node);
}

static crease_status add_crossing(struct task *task, const struct crossing *crossing)
{
    void *items = task->crossings;
    const crease_status status = make_room(
        task->context, task->crossing_count, &task->crossing_room, &items, sizeof *task->crossings);
    task->crossings = items;
    if (status == CREASE_OK)
        task->crossings[task->crossing_count++] = *crossing;
    return status;
}

/* ------------------------------------------------------------------------------------ arcs -- */

/* A crossing of one side of an arc. */
struct cut_at {
    double t;
    int direction;
    size_t cut;
};

/* The first crossing of the side from p to q behind the one given; false when none is left. */
static bool next_cut(
    const struct task *task, const double p[2], const double q[2], struct cut_at *out)
{
    const struct cut_at last = *out;
    bool found = false;
    for (int d = 0; d < 2; d++)
        for (size_t i = 0; i < task->cuts->count[d]; i++) {
            const double at = task->cuts->at[d][i];
            if ((p[d] >= at) == (q[d] >= at))
                continue;
            const struct cut_at here = {(at - p[d]) / (q[d] - p[d]), d, i};
            const bool behind = here.t > last.t ||
                (here.t == last.t &&
                    (here.direction > last.direction ||
                        (here.direction == last.direction && here.cut > last.cut)));
            const bool before =
                !found || here.t < out->t || (here.t == out->t && here.direction < out->direction);
            if (behind && before) {
                *out = here;
                found = true;
            }
        }
    return found;
}

/* Cuts the side from p to q; the edge at hand goes on behind its crossings. */
static crease_status add_side(struct task *task, const double p[2], const double q[2], bool first,
    bool last, const uint32_t ends[2])
{
    struct cut_at cut = {-1.0, 0, 0};
    crease_status status = CREASE_OK;
    while (status == CREASE_OK && next_cut(task, p, q, &cut)) {
        const int other = 1 - cut.direction;
        double place[2];
        uint32_t node = NONE;
        place[cut.direction] = task->cuts->at[cut.direction][cut.cut];
        place[other] = p[other] + cut.t * (q[other] - p[other]);
        if (first && cut.t <= AT_END)
            node = ends[0];
        else if (last && cut.t >= 1.0 - AT_END)
            node = ends[1];
        const bool inner = node == NONE;
        if (inner)
            status = add_node(task, place, &node);
        if (status == CREASE_OK)
            status =
                add_crossing(task, &(struct crossing){cut.direction, cut.cut, place[other], node});
        if (status == CREASE_OK && inner)
            status = end_edge(task, node);
        if (status == CREASE_OK && inner)
            status = begin_edge(task, -1, node);
    }
    return status;
}

static crease_status add_arc(struct task *task, size_t arc, const uint32_t ends[2])
{
    const crease_frontier *const f = task->frontier;
    const size_t begin = f->first_place[arc], end = f->first_place[arc + 1];
    crease_status status = begin_edge(task, -1, ends[0]);
    for (size_t i = begin; i + 1 < end && status == CREASE_OK; i++) {
        const double *const p = f->places + 2 * i;
        status = add_side(task, p, p + 2, i == begin, i + 2 == end, ends);
        if (status == CREASE_OK)
            status = i + 2 == end ? end_edge(task, ends[1]) : add_place(task, p + 2);
    }
    return status;
}

static crease_status add_rings(struct task *task)
{
    const crease_frontier *const f = task->frontier;
    crease_status status = CREASE_OK;
    uint32_t node;
    for (size_t a = 0; a < f->arc_count && status == CREASE_OK; a++)
        status = add_node(task, f->places + 2 * f->first_place[a], &node);
    for (size_t r = 0; r < f->ring_count; r++)
        for (size_t a = f->first_arc[r]; a < f->first_arc[r + 1] && status == CREASE_OK; a++) {
            const size_t next = a + 1 < f->first_arc[r + 1] ? a + 1 : f->first_arc[r];
            status = add_arc(task, a, (uint32_t[]){(uint32_t)a, (uint32_t)next});
        }
    return status;
}

/* ------------------------------------------------------------------------------------ cuts -- */

static int by_place(const void *left, const void *right)
{
    const struct crossing *const a = left, *const b = right;
    if (a->direction != b->direction)
        return a->direction - b->direction;
    if (a->cut != b->cut)
        return a->cut < b->cut ? -1 : 1;
    if (a->along != b->along)
        return a->along < b->along ? -1 : 1;
    return (a->node > b->node) - (a->node < b->node);
}

static crease_status meeting_of(
    struct task *task, int direction, size_t cut, size_t other, uint32_t *node)
{
    const crease_cuts *const cuts = task->cuts;
    const size_t i = direction == 0 ? cut : other, k = direction == 0 ? other : cut;
    uint32_t *const known = &task->meetings[i * cuts->count[1] + k];
    crease_status status = CREASE_OK;
    if (*known == NONE)
        status = add_node(task, (double[]){cuts->at[0][i], cuts->at[1][k]}, known);
    *node = *known;
    return status;
}

/* The edges along a cut between two crossings. */
static crease_status add_inside(
    struct task *task, const struct crossing *from, const struct crossing *to)
{
    const int d = from->direction;
    crease_status status = begin_edge(task, d, from->node);
    for (size_t i = 0; i < task->cuts->count[1 - d] && status == CREASE_OK; i++) {
        const double at = task->cuts->at[1 - d][i];
        uint32_t node = NONE;
        if (!(at > from->along && at < to->along))
            continue;
        status = meeting_of(task, d, from->cut, i, &node);
        if (status == CREASE_OK)
            status = end_edge(task, node);
        if (status == CREASE_OK)
            status = begin_edge(task, d, node);
    }
    return status == CREASE_OK ? end_edge(task, to->node) : status;
}

static crease_status add_cuts(struct task *task)
{
    const size_t meetings = task->cuts->count[0] * task->cuts->count[1];
    task->meetings = crease_allocate(task->context, meetings, sizeof *task->meetings);
    if (!task->meetings)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < meetings; i++)
        task->meetings[i] = NONE;
    crease_status status = CREASE_OK;
    if (task->crossing_count)
        qsort(task->crossings, task->crossing_count, sizeof *task->crossings, by_place);
    for (size_t i = 0; i < task->crossing_count && status == CREASE_OK; i += 2) {
        const struct crossing *const from = task->crossings + i;
        if (i + 1 == task->crossing_count || from[1].direction != from->direction ||
            from[1].cut != from->cut || from[1].node == from->node) {
            task->sound = false;
            return CREASE_OK;
        }
        status = add_inside(task, from, from + 1);
    }
    return status;
}

crease_status crease_overlay_find(crease_context *context, const crease_frontier *frontier,
    const crease_cuts *cuts, double least_width, crease_overlay *out, bool *sound)
{
    *out = (crease_overlay){.node_count = 0};
    struct task task = {
        .context = context, .frontier = frontier, .cuts = cuts, .out = out, .sound = true};
    crease_status status = add_rings(&task);
    if (status == CREASE_OK)
        status = add_cuts(&task);
    if (status == CREASE_OK && task.sound)
        status = crease_walk_faces(context, cuts, least_width, out, &task.sound);
    free(task.crossings);
    free(task.meetings);
    *sound = task.sound;
    if (status != CREASE_OK || !task.sound)
        crease_overlay_clear(out);
    return status;
}

void crease_overlay_clear(crease_overlay *overlay)
{
    free(overlay->nodes);
    free(overlay->places);
    free(overlay->edges);
    free(overlay->halves);
    free(overlay->first_half);
    free(overlay->faces);
    *overlay = (crease_overlay){.node_count = 0};
}
