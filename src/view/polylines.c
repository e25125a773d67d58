/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "view/polylines.h"

#include "base/memory.h"

#include <stdlib.h>
#include <string.h>

void crease_polylines_free(crease_polylines *lines)
{
    free(lines->nodes);
    free(lines->links);
    *lines = (crease_polylines){0};
}

/* Makes room for so many further nodes and links. */
static crease_status reserve(
    crease_context *context, crease_polylines *lines, size_t nodes, size_t links)
{
    if (lines->node_count + nodes > UINT32_MAX)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "scene: a layer of more than %u nodes; add fewer curves or surfaces", UINT32_MAX);
    if (lines->node_count + nodes > lines->node_room) {
        const size_t room = 2 * lines->node_room + nodes;
        double *grown = crease_reallocate(context, lines->nodes, 3 * room, sizeof *grown);
        if (!grown)
            return CREASE_ERROR_NO_MEMORY;
        lines->nodes = grown;
        lines->node_room = room;
    }
    if (lines->link_count + links > lines->link_room) {
        const size_t room = 2 * lines->link_room + links;
        uint32_t *grown = crease_reallocate(context, lines->links, 2 * room, sizeof *grown);
        if (!grown)
            return CREASE_ERROR_NO_MEMORY;
        lines->links = grown;
        lines->link_room = room;
    }
    return CREASE_OK;
}

static double *next_node(crease_polylines *lines)
{
    return &lines->nodes[3 * lines->node_count++];
}

static void link(crease_polylines *lines, size_t from, size_t to)
{
    uint32_t *pair = &lines->links[2 * lines->link_count++];
    pair[0] = (uint32_t)from;
    pair[1] = (uint32_t)to;
}

/* Joins the last `count` nodes in order. */
static void chain(crease_polylines *lines, size_t count)
{
    for (size_t i = lines->node_count - count + 1; i < lines->node_count; i++)
        link(lines, i - 1, i);
}

/* Parameters along a knot vector: every knot of the domain, and between two of them so many more
 * that a line of few spans looks smooth. The caller frees them. */
static double *parameters(
    crease_context *context, int order, size_t count, const double *knots, size_t *found)
{
    size_t spans = 0;
    for (size_t i = (size_t)order - 1; i < count; i++)
        spans += knots[i + 1] > knots[i];
    const size_t steps = order <= 2 ? 1 : spans < 24 ? 96 / (spans ? spans : 1) : 4;
    double *out = crease_allocate(context, spans * steps + 1, sizeof *out);
    if (!out)
        return NULL;
    size_t used = 0;
    for (size_t i = (size_t)order - 1; i < count; i++)
        for (size_t step = 0; step < steps && knots[i + 1] > knots[i]; step++)
            out[used++] = knots[i] + (knots[i + 1] - knots[i]) * (double)step / (double)steps;
    out[used++] = knots[count];
    *found = used;
    return out;
}

crease_status crease_polylines_add_curve(
    crease_context *context, crease_polylines *lines, const crease_curve *curve)
{
    size_t count = 0;
    double *t = parameters(context, crease_curve_order(curve), crease_curve_count(curve),
        crease_curve_knots(curve), &count);
    crease_status status = t ? reserve(context, lines, count, count) : CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; status == CREASE_OK && i < count; i++)
        crease_curve_evaluate(curve, t[i], CREASE_SIDE_RIGHT, 0, next_node(lines));
    if (status == CREASE_OK)
        chain(lines, count);
    free(t);
    return status;
}

/* The lines on which the parameter of one direction is constant. */
static crease_status add_direction(crease_context *context, crease_polylines *lines,
    const crease_surface *surface, int constant, int cells)
{
    const crease_surface_parts parts = crease_surface_parts_of(surface);
    const int along = 1 - constant;
    double domain[2];
    crease_surface_domain(surface, constant, domain);
    size_t count = 0;
    double *t =
        parameters(context, parts.order[along], parts.count[along], parts.knots[along], &count);
    crease_status status = t ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    for (int line = 0; status == CREASE_OK && line <= cells; line++) {
        status = reserve(context, lines, count, count);
        for (size_t i = 0; status == CREASE_OK && i < count; i++) {
            double uv[2];
            uv[constant] = domain[0] + (domain[1] - domain[0]) * line / cells;
            uv[along] = t[i];
            crease_surface_point(surface, uv, next_node(lines));
        }
        if (status == CREASE_OK)
            chain(lines, count);
    }
    free(t);
    return status;
}

crease_status crease_polylines_add_surface(
    crease_context *context, crease_polylines *lines, const crease_surface *surface, int cells)
{
    const crease_status status = add_direction(context, lines, surface, 0, cells);
    return status == CREASE_OK ? add_direction(context, lines, surface, 1, cells) : status;
}

crease_status crease_polylines_add_net(
    crease_context *context, crease_polylines *lines, const crease_surface *surface)
{
    const crease_surface_parts parts = crease_surface_parts_of(surface);
    const size_t rows = parts.count[0], columns = parts.count[1], first = lines->node_count;
    const crease_status status = reserve(context, lines, rows * columns, 2 * rows * columns);
    if (status != CREASE_OK)
        return status;
    memcpy(&lines->nodes[3 * first], parts.control_points, 3 * rows * columns * sizeof(double));
    lines->node_count += rows * columns;
    for (size_t i = 0; i < rows * columns; i++) {
        if (i % columns + 1 < columns)
            link(lines, first + i, first + i + 1);
        if (i / columns + 1 < rows)
            link(lines, first + i, first + i + columns);
    }
    return CREASE_OK;
}

static int by_value(const void *a, const void *b)
{
    const uint64_t x = *(const uint64_t *)a, y = *(const uint64_t *)b;
    return (x > y) - (x < y);
}

/* The sides of all triangles, each as its lower and higher vertex in one number, sorted. */
static uint64_t *sides_of(crease_context *context, const crease_mesh *mesh, size_t count)
{
    const uint32_t *const corners = crease_mesh_triangles(mesh);
    uint64_t *const sides = crease_allocate(context, count, sizeof *sides);
    if (!sides)
        return NULL;
    for (size_t i = 0; i < count; i++) {
        const uint64_t a = corners[i], b = corners[i % 3 == 2 ? i - 2 : i + 1];
        sides[i] = a < b ? a << 32 | b : b << 32 | a;
    }
    qsort(sides, count, sizeof *sides, by_value);
    return sides;
}

crease_status crease_polylines_add_borders(
    crease_context *context, crease_polylines *lines, const crease_mesh *mesh)
{
    const double *const vertices = crease_mesh_vertices(mesh);
    const size_t count = 3 * crease_mesh_triangle_count(mesh);
    uint64_t *const sides = sides_of(context, mesh, count);
    crease_status status = sides ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < count && status == CREASE_OK; i++) {
        if ((i > 0 && sides[i] == sides[i - 1]) || (i + 1 < count && sides[i] == sides[i + 1]))
            continue;
        status = reserve(context, lines, 2, 1);
        if (status != CREASE_OK)
            break;
        memcpy(next_node(lines), vertices + 3 * (sides[i] >> 32), 3 * sizeof *vertices);
        memcpy(next_node(lines), vertices + 3 * (sides[i] & UINT32_MAX), 3 * sizeof *vertices);
        chain(lines, 2);
    }
    free(sides);
    return status;
}
