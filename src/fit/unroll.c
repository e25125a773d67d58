/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Lengths of shortest ways over links between neighbours are the distances along the surface; from
 * a few landmarks to all points they are enough for classical scaling. */
#include "fit/unroll.h"

#include "base/memory.h"

#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LINKS = 12, LANDMARKS = 40 };

typedef struct graph {
    size_t count, links;
    uint32_t *near;   /* count x links, the point itself first */
    double *squares;  /* of the lengths; later the lengths */
    uint32_t *degree; /* links from other points to each */
    uint32_t *begin;  /* count + 1: of each point's links in both directions */
    uint32_t *to;
    double *length;
} graph;

typedef struct heap {
    size_t size;
    uint32_t *items; /* points, the nearest first */
    uint32_t *place; /* of each point, from 1; 0: not in the heap */
    const double *key;
} heap;

static void heap_set(heap *h, size_t at, uint32_t point)
{
    h->items[at] = point;
    h->place[point] = (uint32_t)at + 1;
}

static void heap_rise(heap *h, size_t at)
{
    const uint32_t point = h->items[at];
    while (at > 0 && h->key[h->items[(at - 1) / 2]] > h->key[point]) {
        heap_set(h, at, h->items[(at - 1) / 2]);
        at = (at - 1) / 2;
    }
    heap_set(h, at, point);
}

static uint32_t heap_take(heap *h)
{
    const uint32_t first = h->items[0];
    const uint32_t last = h->items[--h->size];
    size_t at = 0;
    h->place[first] = 0;
    for (size_t next = 1; next < h->size; next = 2 * at + 1) {
        next += next + 1 < h->size && h->key[h->items[next + 1]] < h->key[h->items[next]];
        if (h->key[last] <= h->key[h->items[next]])
            break;
        heap_set(h, at, h->items[next]);
        at = next;
    }
    if (h->size > 0)
        heap_set(h, at, last);
    return first;
}

/* Dijkstra's algorithm. */
static void walk(const graph *g, uint32_t from, heap *h, double *distance)
{
    for (size_t i = 0; i < g->count; i++)
        distance[i] = INFINITY;
    distance[from] = 0.0;
    h->key = distance;
    h->size = 1;
    heap_set(h, 0, from);
    while (h->size > 0) {
        const uint32_t point = heap_take(h);
        for (size_t k = g->begin[point]; k < g->begin[point + 1]; k++) {
            const uint32_t other = g->to[k];
            const double way = distance[point] + g->length[k];
            if (!(way < distance[other]))
                continue;
            distance[other] = way;
            if (h->place[other] == 0)
                heap_set(h, h->size++, other);
            heap_rise(h, h->place[other] - 1);
        }
    }
}

/* Links hold in both directions. */
static void symmetrise(graph *g)
{
    const size_t links = g->links;
    for (size_t i = 0; i < g->count; i++)
        for (size_t k = 1; k < links; k++) {
            g->begin[i + 1]++;
            g->begin[g->near[i * links + k] + 1]++;
        }
    for (size_t i = 0; i < g->count; i++)
        g->begin[i + 1] += g->begin[i];
    memcpy(g->degree, g->begin, g->count * sizeof *g->degree);
    for (size_t i = 0; i < g->count; i++)
        for (size_t k = 1; k < links; k++) {
            const uint32_t ends[2] = {(uint32_t)i, g->near[i * links + k]};
            for (int e = 0; e < 2; e++) {
                const uint32_t at = g->degree[ends[e]]++;
                g->to[at] = ends[1 - e];
                g->length[at] = sqrt(g->squares[i * links + k]);
            }
        }
}

static crease_status link_points(
    crease_context *context, const double *points, size_t count, graph *g)
{
    crease_tree *tree = NULL;
    g->count = count;
    g->links = count < LINKS ? count : LINKS;
    g->near = crease_allocate(context, count, g->links * sizeof *g->near);
    g->squares = crease_allocate(context, count, g->links * sizeof *g->squares);
    g->degree = crease_allocate(context, count, sizeof *g->degree);
    g->begin = crease_allocate(context, count + 1, sizeof *g->begin);
    g->to = crease_allocate(context, count, 2 * g->links * sizeof *g->to);
    g->length = crease_allocate(context, count, 2 * g->links * sizeof *g->length);
    crease_status status = g->near && g->squares && g->degree && g->begin && g->to && g->length
        ? crease_tree_create(context, points, count, &tree)
        : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK)
        status =
            crease_tree_nearest(context, tree, points, count, (int)g->links, g->near, g->squares);
    if (status == CREASE_OK)
        symmetrise(g);
    crease_tree_free(tree);
    return status;
}

static void graph_free(graph *g)
{
    free(g->near);
    free(g->squares);
    free(g->degree);
    free(g->begin);
    free(g->to);
    free(g->length);
}

/* Leaves the points of the largest connected part; returns one of them. distance: of count. */
static uint32_t keep_largest(const graph *g, heap *h, double *distance, double *keep)
{
    size_t most = 0;
    uint32_t seed = 0;
    for (size_t start = 0; start < g->count && 2 * most < g->count; start++) {
        if (!(keep[start] > 0.0))
            continue;
        size_t reached = 0;
        walk(g, (uint32_t)start, h, distance);
        for (size_t i = 0; i < g->count; i++)
            reached += isfinite(distance[i]) != 0;
        if (reached > most) {
            most = reached;
            seed = (uint32_t)start;
        }
        if (start > 64)
            break;
    }
    walk(g, seed, h, distance);
    for (size_t i = 0; i < g->count; i++)
        if (!isfinite(distance[i]))
            keep[i] = 0.0;
    return seed;
}

/* The kept point farthest from all landmarks so far. */
static uint32_t farthest(const double *nearest, const double *keep, size_t count)
{
    uint32_t best = 0;
    double most = -1.0;
    for (size_t i = 0; i < count; i++)
        if (keep[i] > 0.0 && nearest[i] > most) {
            most = nearest[i];
            best = (uint32_t)i;
        }
    return best;
}

/* Squared distances of all points from landmarks that are far from each other: LANDMARKS x count.
 * marks: the landmarks. */
static void measure(const graph *g, heap *h, double *keep, double *squares, uint32_t *marks)
{
    const size_t n = g->count;
    double *const nearest = squares + LANDMARKS * n;
    const uint32_t seed = keep_largest(g, h, nearest, keep);
    walk(g, seed, h, nearest);
    for (size_t l = 0; l < LANDMARKS; l++) {
        double *const row = squares + l * n;
        marks[l] = farthest(nearest, keep, n);
        walk(g, marks[l], h, row);
        for (size_t i = 0; i < n; i++)
            nearest[i] = l == 0 ? row[i] : fmin(nearest[i], row[i]);
    }
    for (size_t i = 0; i < LANDMARKS * n; i++)
        squares[i] *= squares[i];
}

/* The two main axes of the landmarks' doubly centred distances, and the mean of each column. */
static bool scale(const double *squares, const uint32_t *marks, size_t count,
    double axes[2][LANDMARKS], double mean[LANDMARKS])
{
    double a[LANDMARKS * LANDMARKS], values[LANDMARKS], whole = 0.0;
    for (size_t r = 0; r < LANDMARKS; r++) {
        mean[r] = 0.0;
        for (size_t c = 0; c < LANDMARKS; c++) {
            a[r * LANDMARKS + c] =
                0.5 * (squares[r * count + marks[c]] + squares[c * count + marks[r]]);
            mean[r] += a[r * LANDMARKS + c] / LANDMARKS;
        }
        whole += mean[r] / LANDMARKS;
    }
    for (size_t r = 0; r < LANDMARKS; r++)
        for (size_t c = 0; c < LANDMARKS; c++)
            a[r * LANDMARKS + c] = -0.5 * (a[r * LANDMARKS + c] - mean[r] - mean[c] + whole);
    if (LAPACKE_dsyev(LAPACK_COL_MAJOR, 'V', 'L', LANDMARKS, a, LANDMARKS, values) != 0)
        return false;
    for (size_t d = 0; d < 2; d++) {
        const double value = values[LANDMARKS - 1 - d];
        const double *const v = a + (LANDMARKS - 1 - d) * LANDMARKS;
        if (!(value > 1e-9 * values[LANDMARKS - 1]) || !(value > 0.0))
            return false;
        size_t largest = 0;
        for (size_t l = 1; l < LANDMARKS; l++)
            largest = fabs(v[l]) > fabs(v[largest]) + 1e-9 ? l : largest;
        for (size_t l = 0; l < LANDMARKS; l++)
            axes[d][l] = copysign(1.0, v[largest]) * v[l] / sqrt(value);
    }
    return true;
}

static void place(const double *squares, size_t count, double axes[2][LANDMARKS],
    const double mean[LANDMARKS], const double *keep, double *plane)
{
    for (size_t i = 0; i < count; i++)
        for (size_t d = 0; d < 2; d++) {
            double sum = 0.0;
            for (size_t l = 0; l < LANDMARKS && keep[i] > 0.0; l++)
                sum -= 0.5 * axes[d][l] * (squares[l * count + i] - mean[l]);
            plane[2 * i + d] = sum;
        }
}

crease_status crease_unroll(
    crease_context *context, const double *points, size_t count, double *keep, double *plane)
{
    graph g = {0};
    heap h = {0};
    uint32_t marks[LANDMARKS];
    double axes[2][LANDMARKS], mean[LANDMARKS];
    double *const squares = crease_allocate(context, count, (LANDMARKS + 1) * sizeof *squares);
    h.items = crease_allocate(context, count, sizeof *h.items);
    h.place = crease_allocate(context, count, sizeof *h.place);
    crease_status status = squares && h.items && h.place ? link_points(context, points, count, &g)
                                                         : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK) {
        measure(&g, &h, keep, squares, marks);
        if (scale(squares, marks, count, axes, mean))
            place(squares, count, axes, mean, keep, plane);
        else
            status = crease_fail(context, CREASE_ERROR_DEGENERATE,
                "sheet: the points lie along one line; a sheet has two directions");
    }
    graph_free(&g);
    free(squares);
    free(h.items);
    free(h.place);
    return status;
}
