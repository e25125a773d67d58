/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Closest points on a mesh. The tree of the triangles' centroids serves as a tree of boxes: every
 * node gets the box around its triangles, and the search leaves out boxes that are farther than
 * what it has.
 *
 * Based on: Ericson. Real-time collision detection. 2005, 5.1.5 (closest point on a triangle). */
#include "mesh/mesh.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "base/vector.h"
#include "space/kdtree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { GRAIN = 256 };

/* Squared distances that differ by less, of themselves and of the coordinates' squared size, are as
 * close as each other. */
static const double same_distance = 1e-9, same_place = 1e-28;

typedef struct box {
    double low[3], high[3];
} box;

typedef struct projection {
    const crease_mesh *mesh;
    crease_tree *tree; /* of the centroids */
    box *boxes;        /* of the tree's nodes */
    const double *points;
    crease_mesh_foot *feet;
} projection;

/* ------------------------------------------------------------------------------------ boxes -- */

static const double *corner_of(const crease_mesh *mesh, size_t triangle, size_t corner)
{
    return mesh->vertices + 3 * (size_t)mesh->triangles[3 * triangle + corner];
}

static void box_add(box *around, const double low[3], const double high[3])
{
    for (int c = 0; c < 3; c++) {
        around->low[c] = fmin(around->low[c], low[c]);
        around->high[c] = fmax(around->high[c], high[c]);
    }
}

/* Children have higher numbers than their parents. */
static void make_boxes(projection *run)
{
    const crease_node *const nodes = run->tree->nodes;
    for (size_t n = run->tree->node_count; n-- > 0;) {
        box *const around = &run->boxes[n];
        *around = (box){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
        if (nodes[n].second) {
            box_add(around, run->boxes[n + 1].low, run->boxes[n + 1].high);
            box_add(around, run->boxes[nodes[n].second].low, run->boxes[nodes[n].second].high);
            continue;
        }
        for (size_t i = nodes[n].begin; i < nodes[n].end; i++)
            for (size_t corner = 0; corner < 3; corner++) {
                const double *const vertex = corner_of(run->mesh, run->tree->index[i], corner);
                box_add(around, vertex, vertex);
            }
    }
}

static crease_status make_tree(crease_context *context, projection *run)
{
    const size_t count = run->mesh->triangle_count;
    double *const centroids = crease_allocate(context, count, 3 * sizeof *centroids);
    if (!centroids)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < 3 * count; i++)
        for (size_t corner = 0; corner < 3; corner++)
            centroids[i] += corner_of(run->mesh, i / 3, corner)[i % 3] / 3.0;
    crease_status status = crease_tree_create(context, centroids, count, &run->tree);
    free(centroids);
    if (status != CREASE_OK)
        return status;
    run->boxes = crease_allocate(context, run->tree->node_count, sizeof *run->boxes);
    if (!run->boxes)
        return CREASE_ERROR_NO_MEMORY;
    make_boxes(run);
    return CREASE_OK;
}

static double squared_distance_to_box(const box *around, const double place[3])
{
    double sum = 0.0;
    for (int c = 0; c < 3; c++) {
        const double away = fmax(fmax(around->low[c] - place[c], place[c] - around->high[c]), 0.0);
        sum += away * away;
    }
    return sum;
}

/* ---------------------------------------------------------------------------- one triangle -- */

/* The point a + v ab + w ac. */
static void combine(
    const double a[3], const double ab[3], double v, const double ac[3], double w, double out[3])
{
    for (int c = 0; c < 3; c++)
        out[c] = a[c] + v * ab[c] + w * ac[c];
}

/* Part of the way from a to b that is closest, from the products with ab of what lies between. */
static double part(double from_start, double from_end)
{
    return from_start / (from_start - from_end);
}

static void closest_on_triangle(
    const double a[3], const double b[3], const double c[3], const double place[3], double out[3])
{
    double ab[3], ac[3], to_a[3], to_b[3], to_c[3];
    for (int i = 0; i < 3; i++) {
        ab[i] = b[i] - a[i], ac[i] = c[i] - a[i];
        to_a[i] = place[i] - a[i], to_b[i] = place[i] - b[i], to_c[i] = place[i] - c[i];
    }
    const double d1 = crease_vector_dot(ab, to_a), d2 = crease_vector_dot(ac, to_a);
    const double d3 = crease_vector_dot(ab, to_b), d4 = crease_vector_dot(ac, to_b);
    const double d5 = crease_vector_dot(ab, to_c), d6 = crease_vector_dot(ac, to_c);
    const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
    if (d1 <= 0.0 && d2 <= 0.0)
        combine(a, ab, 0.0, ac, 0.0, out);
    else if (d3 >= 0.0 && d4 <= d3)
        combine(a, ab, 1.0, ac, 0.0, out);
    else if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0)
        combine(a, ab, part(d1, d3), ac, 0.0, out);
    else if (d6 >= 0.0 && d5 <= d6)
        combine(a, ab, 0.0, ac, 1.0, out);
    else if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0)
        combine(a, ab, 0.0, ac, part(d2, d6), out);
    else if (va <= 0.0 && d4 >= d3 && d5 >= d6)
        combine(a, ab, 1.0 - part(d4 - d3, d6 - d5), ac, part(d4 - d3, d6 - d5), out);
    else
        combine(a, ab, vb / (va + vb + vc), ac, vc / (va + vb + vc), out);
}

/* -------------------------------------------------------------------------------- one point -- */

/* What the search has found. At an edge several triangles are equally close; the sign of the
 * distance is that of the one that faces the point most. */
typedef struct finding {
    const double *place;
    double squared, rounding; /* squared distance, and what it may be off near 0 */
    double facing;            /* cosine of the place's direction against the triangle's normal */
    uint32_t triangle;
    double foot[3];
} finding;

/* Squared distance up to which a triangle is worth a look. */
static double reach(const finding *found)
{
    return found->squared * (1.0 + same_distance) + found->rounding;
}

static double facing(const crease_mesh *mesh, size_t triangle, const double away[3])
{
    const double *const a = corner_of(mesh, triangle, 0), *const b = corner_of(mesh, triangle, 1);
    const double *const c = corner_of(mesh, triangle, 2);
    double ab[3], ac[3], normal[3];
    for (int i = 0; i < 3; i++)
        ab[i] = b[i] - a[i], ac[i] = c[i] - a[i];
    crease_vector_cross(ab, ac, normal);
    const double size = crease_vector_length(normal) * crease_vector_length(away);
    return size > 0.0 ? crease_vector_dot(normal, away) / size : 0.0;
}

static void try_triangle(const projection *run, uint32_t triangle, finding *found)
{
    double foot[3], away[3];
    closest_on_triangle(corner_of(run->mesh, triangle, 0), corner_of(run->mesh, triangle, 1),
        corner_of(run->mesh, triangle, 2), found->place, foot);
    for (int c = 0; c < 3; c++)
        away[c] = found->place[c] - foot[c];
    const double squared = crease_vector_dot(away, away);
    if (!(squared <= reach(found)))
        return;
    const double cosine = facing(run->mesh, triangle, away);
    const bool same = found->squared <= squared * (1.0 + same_distance) + found->rounding;
    if (same &&
        (fabs(cosine) < fabs(found->facing) ||
            (fabs(cosine) == fabs(found->facing) && triangle > found->triangle)))
        return;
    found->squared = same ? fmin(squared, found->squared) : squared;
    found->facing = cosine;
    found->triangle = triangle;
    memcpy(found->foot, foot, sizeof foot);
}

static void search(const projection *run, finding *found)
{
    const crease_node *const nodes = run->tree->nodes;
    uint32_t stack[CREASE_TREE_DEPTH];
    int height = 0;
    stack[height++] = 0;
    while (height > 0) {
        const uint32_t n = stack[--height];
        if (squared_distance_to_box(&run->boxes[n], found->place) > reach(found))
            continue;
        if (!nodes[n].second) {
            for (size_t i = nodes[n].begin; i < nodes[n].end; i++)
                try_triangle(run, run->tree->index[i], found);
            continue;
        }
        const uint32_t first = n + 1, second = nodes[n].second;
        const bool swap = squared_distance_to_box(&run->boxes[second], found->place) <
            squared_distance_to_box(&run->boxes[first], found->place);
        stack[height++] = swap ? first : second;
        stack[height++] = swap ? second : first;
    }
}

static void project(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const projection *run = user;
    const box *const whole = run->boxes;
    double size = 0.0;
    for (int c = 0; c < 3; c++)
        size = fmax(size, fmax(fabs(whole->low[c]), fabs(whole->high[c])));
    for (size_t i = begin; i < end; i++) {
        finding found = {.place = run->points + 3 * i,
            .squared = INFINITY,
            .rounding = same_place * size * size,
            .triangle = UINT32_MAX};
        search(run, &found);
        crease_mesh_foot *const foot = &run->feet[i];
        memcpy(foot->point, found.foot, sizeof foot->point);
        foot->distance = copysign(crease_vector_distance(found.foot, found.place), found.facing);
        foot->triangle = found.triangle;
    }
}

crease_status crease_mesh_project(crease_context *context, const crease_mesh *mesh,
    const double *points, size_t count, crease_mesh_foot *feet)
{
    if (mesh->triangle_count == 0)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "mesh: it has no triangles to project points onto; give one that has");
    for (size_t i = 0; i < 3 * count; i++)
        if (!isfinite(points[i]))
            return crease_fail(context, CREASE_ERROR_VALUE,
                "mesh: point %zu has a coordinate that is not finite; leave it out", i / 3);
    projection run = {.mesh = mesh, .points = points, .feet = feet};
    crease_status status = make_tree(context, &run);
    if (status == CREASE_OK)
        status = crease_parallel_for(context, count, GRAIN, project, &run);
    free(run.boxes);
    crease_tree_free(run.tree);
    return status;
}
