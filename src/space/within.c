/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* All points in a ball. The indices found are kept in a heap with the highest on top, so that when
 * there is no room for all of them the lowest stay, and then sorted in place. */
#include "space/kdtree.h"

struct ball {
    const crease_tree *tree;
    double place[3];
    double squared;
    size_t capacity, found;
    uint32_t *heap;
};

static double outside(double low, double high, double value)
{
    const double below = low - value, above = value - high;
    const double away = below > above ? below : above;
    return away > 0 ? away : 0;
}

static void exchange(uint32_t *a, uint32_t *b)
{
    const uint32_t kept = *a;
    *a = *b;
    *b = kept;
}

static void sift_down(uint32_t *heap, size_t count)
{
    for (size_t at = 0, child = 1; child < count; child = 2 * at + 1) {
        if (child + 1 < count && heap[child + 1] > heap[child])
            child++;
        if (heap[at] >= heap[child])
            return;
        exchange(&heap[at], &heap[child]);
        at = child;
    }
}

static void sift_up(uint32_t *heap, size_t at)
{
    for (; at > 0 && heap[(at - 1) / 2] < heap[at]; at = (at - 1) / 2)
        exchange(&heap[at], &heap[(at - 1) / 2]);
}

static void keep(struct ball *ball, uint32_t index)
{
    const size_t found = ball->found++;
    if (found < ball->capacity) {
        ball->heap[found] = index;
        sift_up(ball->heap, found);
    } else if (ball->capacity > 0 && index < ball->heap[0]) {
        ball->heap[0] = index;
        sift_down(ball->heap, ball->capacity);
    }
}

static bool near(const struct ball *ball, const crease_node *node)
{
    const double dx = outside(node->low[0], node->high[0], ball->place[0]);
    const double dy = outside(node->low[1], node->high[1], ball->place[1]);
    const double dz = outside(node->low[2], node->high[2], ball->place[2]);
    return dx * dx + dy * dy + dz * dz <= ball->squared;
}

static void search_leaf(struct ball *ball, const crease_node *leaf)
{
    const crease_tree *const tree = ball->tree;
    for (uint32_t i = leaf->begin; i < leaf->end; i++) {
        const double dx = tree->x[i] - ball->place[0];
        const double dy = tree->y[i] - ball->place[1];
        const double dz = tree->z[i] - ball->place[2];
        if (dx * dx + dy * dy + dz * dz <= ball->squared)
            keep(ball, tree->index[i]);
    }
}

static void search(struct ball *ball)
{
    const crease_node *const nodes = ball->tree->nodes;
    uint32_t stack[CREASE_TREE_DEPTH];
    int height = 0;
    stack[height++] = 0;
    while (height > 0) {
        const crease_node *const node = nodes + stack[--height];
        if (!near(ball, node))
            continue;
        if (node->second) {
            stack[height++] = node->second;
            stack[height++] = (uint32_t)(node + 1 - nodes);
        } else {
            search_leaf(ball, node);
        }
    }
}

crease_status crease_tree_within(const crease_tree *tree, const double place[3], double radius,
    size_t capacity, uint32_t *indices, size_t *found)
{
    *found = 0;
    if (!(radius >= 0))
        return CREASE_ERROR_ARGUMENT;
    struct ball ball = {
        tree, {place[0], place[1], place[2]}, radius * radius, capacity, 0, indices};
    if (tree->count > 0)
        search(&ball);
    for (size_t left = ball.found < capacity ? ball.found : capacity; left > 1; left--) {
        exchange(&indices[0], &indices[left - 1]);
        sift_down(indices, left - 1);
    }
    *found = ball.found;
    return CREASE_OK;
}
