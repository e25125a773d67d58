/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "topology/cycle.h"

#include "base/memory.h"

#include <stdlib.h>

enum { MOST_TRIALS = 4000 /* ends looked at */ };

struct ends {
    size_t count;
    crease_end *items;
};

struct walk {
    const crease_graph *graph;
    const struct ends *ends;
    crease_cycle_visit *visit;
    void *user;
    size_t trials;
};

/* The regions that lack an edge at a vertex; at most `most`. */
static size_t odd_regions(const crease_graph *graph, int32_t vertex, size_t most, uint32_t *out)
{
    const crease_topology *const t = graph->topology;
    size_t count = 0;
    for (size_t e = 0; e < t->edge_count; e++)
        for (int i = 0; i < 2; i++) {
            const uint32_t region = t->edges[e].regions[i];
            size_t k = 0;
            if (t->edges[e].vertices[0] != vertex && t->edges[e].vertices[1] != vertex)
                continue;
            while (k < count && out[k] != region)
                k++;
            if (k == count && count < most && crease_graph_odd(graph, vertex, region))
                out[count++] = region;
        }
    return count;
}

crease_status crease_ends_list(const crease_graph *graph, crease_end **out, size_t *count)
{
    const size_t vertices = graph->topology->vertex_count;
    *count = 0;
    *out = crease_allocate(graph->context, vertices, sizeof **out);
    if (!*out)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t v = 0; v < vertices; v++) {
        uint32_t odd[3];
        if (odd_regions(graph, (int32_t)v, 3, odd) != 2)
            continue;
        const uint32_t low = odd[0] < odd[1] ? odd[0] : odd[1];
        (*out)[(*count)++] = (crease_end){(int32_t)v, {low, odd[0] + odd[1] - low}};
    }
    return CREASE_OK;
}

bool crease_end_is_odd(const crease_graph *graph, const crease_end *end)
{
    return crease_graph_odd(graph, end->vertex, end->regions[0]) &&
        crease_graph_odd(graph, end->vertex, end->regions[1]);
}

static bool has_region(const crease_cycle *cycle, int known, uint32_t region)
{
    for (int i = 0; i < known; i++)
        if (cycle->regions[i] == region)
            return true;
    return false;
}

/* Goes on with every end that leads from the last region of the cycle to a new one, or, for its
 * last side, back to the first. */
static crease_status extend(struct walk *walk, crease_cycle *cycle, int sides)
{
    const uint32_t from = cycle->regions[sides];
    const bool closing = sides + 1 == cycle->count || sides + 1 == CREASE_MOST_SIDES;
    crease_status status = CREASE_OK;
    for (const crease_end *end = cycle->ends[0] + 1;
         end < walk->ends->items + walk->ends->count && status == CREASE_OK; end++) {
        if (end->regions[0] != from && end->regions[1] != from)
            continue;
        const uint32_t to = end->regions[0] == from ? end->regions[1] : end->regions[0];
        if (closing ? to != cycle->regions[0] : has_region(cycle, sides, to))
            continue;
        if (walk->trials++ >= MOST_TRIALS || !crease_end_is_odd(walk->graph, cycle->ends[0]))
            break;
        cycle->ends[sides] = end;
        if (!crease_end_is_odd(walk->graph, end))
            continue;
        if (!closing) {
            cycle->regions[sides + 1] = to;
            status = extend(walk, cycle, sides + 1);
        } else
            status = walk->visit(walk->user, cycle);
    }
    return status;
}

crease_status crease_cycles_visit(crease_graph *graph, crease_cycle_visit *visit, void *user)
{
    struct ends ends = {0, NULL};
    crease_status status = crease_ends_list(graph, &ends.items, &ends.count);
    struct walk walk = {graph, &ends, visit, user, 0};
    for (int count = 3; count <= CREASE_MOST_SIDES && status == CREASE_OK; count++)
        for (size_t i = 0; i < ends.count && status == CREASE_OK; i++) {
            const crease_end *const first = &ends.items[i];
            crease_cycle cycle = {
                .count = count, .ends = {first}, .regions = {first->regions[0], first->regions[1]}};
            status = extend(&walk, &cycle, 1);
        }
    free(ends.items);
    return status;
}
