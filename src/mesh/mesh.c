/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Tessellation. Every surface gets a grid of parameters with its knots among the lines. Borders
 * that coincide are divided alike and get the same positions, so that the mesh has no gaps.
 * Vertices belong to one surface and one side of a crease, so that normals stay sharp. */
#include "mesh/mesh.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "base/vector.h"
#include "mesh/border.h"
#include "mesh/grid.h"
#include "spline/surface.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { GRAIN = 256 };

typedef struct work {
    crease_grid *grids;
    size_t count;
    crease_match *matches;
    size_t match_count;
    crease_mesh *mesh;
} work;

/* Length of the diagonal of the box around all control points. */
static double extent(const crease_surface *const *surfaces, size_t count)
{
    double lowest[3] = {INFINITY, INFINITY, INFINITY};
    double highest[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t s = 0; s < count; s++)
        for (size_t i = 0; i < 3 * surfaces[s]->count[0] * surfaces[s]->count[1]; i++) {
            lowest[i % 3] = fmin(lowest[i % 3], surfaces[s]->control_points[i]);
            highest[i % 3] = fmax(highest[i % 3], surfaces[s]->control_points[i]);
        }
    return crease_vector_distance(lowest, highest);
}

/* ----------------------------------------------------------------------------------- grids -- */

/* Gives both borders of a match the finer of their divisions; true when something changed. */
static bool level(crease_grid *grids, const crease_match *match)
{
    crease_axis *const a = &grids[match->first.surface].axes[1 - match->first.direction];
    crease_axis *const b = &grids[match->second.surface].axes[1 - match->second.direction];
    bool changed = false;
    for (size_t i = 0; i < a->span_count; i++) {
        double *const one = &a->divisions[i];
        double *const other = &b->divisions[match->reversed ? a->span_count - 1 - i : i];
        changed = changed || *one != *other;
        *one = *other = fmax(*one, *other);
    }
    return changed;
}

static void level_all(work *w)
{
    for (bool changed = true; changed;) {
        changed = false;
        for (size_t i = 0; i < w->match_count; i++)
            changed = level(w->grids, &w->matches[i]) || changed;
    }
}

static crease_status make_grids(crease_context *context, const crease_surface *const *surfaces,
    double tolerance, double size, work *w)
{
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < w->count && status == CREASE_OK; i++)
        status = crease_grid_prepare(context, surfaces[i], tolerance, &w->grids[i]);
    if (status == CREASE_OK)
        status = crease_borders_match(
            context, w->grids, w->count, 1e-12 * size, &w->matches, &w->match_count);
    if (status == CREASE_OK)
        level_all(w);
    for (size_t i = 0; i < w->count && status == CREASE_OK; i++)
        status = crease_grid_draw(context, &w->grids[i]);
    return status;
}

/* -------------------------------------------------------------------------------- vertices -- */

static void place_vertices(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const work *const w = user;
    size_t g = 0;
    for (size_t vertex = begin; vertex < end; vertex++) {
        while (g + 1 < w->count && w->grids[g + 1].first_vertex <= vertex)
            g++;
        const crease_grid *const grid = &w->grids[g];
        const size_t width = grid->axes[1].line_count;
        const size_t number = vertex - grid->first_vertex;
        const crease_grid_line *const u = &grid->axes[0].lines[number / width];
        const crease_grid_line *const v = &grid->axes[1].lines[number % width];
        const double uv[2] = {u->t, v->t};
        const crease_side sides[2] = {u->side, v->side};
        crease_surface_evaluate(grid->surface, uv, sides, 0, w->mesh->vertices + 3 * vertex);
        crease_surface_normal(grid->surface, uv, sides, w->mesh->normals + 3 * vertex);
    }
}

/* Vertex of the line number `along` on a border. */
static size_t border_vertex(const crease_grid *grids, const crease_border *border, size_t along)
{
    const crease_grid *const grid = &grids[border->surface];
    const size_t width = grid->axes[1].line_count;
    const size_t row = border->highest ? grid->axes[border->direction].line_count - 1 : 0;
    return grid->first_vertex +
        (border->direction == 0 ? row * width + along : along * width + row);
}

/* The lowest vertex at the same place, as far as known. */
static uint32_t find(uint32_t *same, uint32_t vertex)
{
    while (same[vertex] != vertex)
        vertex = same[vertex] = same[same[vertex]];
    return vertex;
}

static void unite(uint32_t *same, size_t one, size_t other)
{
    const uint32_t a = find(same, (uint32_t)one);
    const uint32_t b = find(same, (uint32_t)other);
    if (a < b)
        same[b] = a;
    else
        same[a] = b;
}

static void unite_borders(const crease_grid *grids, const crease_match *match, uint32_t *same)
{
    const crease_axis *const a = &grids[match->first.surface].axes[1 - match->first.direction];
    const crease_axis *const b = &grids[match->second.surface].axes[1 - match->second.direction];
    size_t from = 0;
    for (size_t k = 0; k < b->line_count; k++) {
        const size_t to = match->reversed ? b->line_count - 1 - k : k;
        const size_t place =
            match->reversed ? b->place_count - 1 - b->lines[to].place : b->lines[to].place;
        while (a->lines[from].place < place)
            from++;
        unite(same, border_vertex(grids, &match->first, from),
            border_vertex(grids, &match->second, to));
    }
}

/* Both lines of a crease inside a surface. */
static void unite_doubled(const crease_grid *grid, uint32_t *same)
{
    const crease_axis *const u = &grid->axes[0];
    const crease_axis *const v = &grid->axes[1];
    for (size_t i = 0; i < u->line_count; i++)
        for (size_t j = 0; j < v->line_count; j++) {
            const size_t vertex = grid->first_vertex + i * v->line_count + j;
            if (i && u->lines[i].place == u->lines[i - 1].place)
                unite(same, vertex, vertex - v->line_count);
            if (j && v->lines[j].place == v->lines[j - 1].place)
                unite(same, vertex, vertex - 1);
        }
}

/* Gives vertices at the same place the same position, to the last bit. */
static crease_status close_gaps(crease_context *context, const work *w)
{
    const size_t count = w->mesh->vertex_count;
    uint32_t *same = crease_allocate(context, count, sizeof *same);
    if (!same)
        return CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; i < count; i++)
        same[i] = (uint32_t)i;
    for (size_t i = 0; i < w->count; i++)
        unite_doubled(&w->grids[i], same);
    for (size_t i = 0; i < w->match_count; i++)
        unite_borders(w->grids, &w->matches[i], same);
    for (size_t i = 0; i < count; i++) {
        const size_t first = find(same, (uint32_t)i);
        if (first != i)
            memcpy(w->mesh->vertices + 3 * i, w->mesh->vertices + 3 * first, 3 * sizeof(double));
    }
    free(same);
    return CREASE_OK;
}

/* ------------------------------------------------------------------------------- triangles -- */

/* Adds a triangle unless it has no area. */
static void add_triangle(crease_mesh *mesh, const uint32_t corners[3], uint32_t owner)
{
    const double *const at[3] = {mesh->vertices + 3 * (size_t)corners[0],
        mesh->vertices + 3 * (size_t)corners[1], mesh->vertices + 3 * (size_t)corners[2]};
    double edges[2][3], normal[3];
    for (int c = 0; c < 3; c++) {
        edges[0][c] = at[1][c] - at[0][c];
        edges[1][c] = at[2][c] - at[0][c];
    }
    crease_vector_cross(edges[0], edges[1], normal);
    const double longest =
        fmax(crease_vector_length(edges[0]), crease_vector_distance(at[1], at[2]));
    if (!(crease_vector_length(normal) > 1e-14 * longest * longest))
        return;
    memcpy(mesh->triangles + 3 * mesh->triangle_count, corners, 3 * sizeof *corners);
    mesh->owners[mesh->triangle_count++] = owner;
}

static double diagonal(const double *vertices, uint32_t a, uint32_t b)
{
    return crease_vector_distance(vertices + 3 * (size_t)a, vertices + 3 * (size_t)b);
}

/* Two triangles along the shorter diagonal, turning the way of the surface's normal. */
static void add_cell(crease_mesh *mesh, uint32_t corner, uint32_t width, uint32_t owner)
{
    const uint32_t a = corner;
    const uint32_t b = corner + width;
    const uint32_t c = b + 1;
    const uint32_t d = a + 1;
    const bool first = diagonal(mesh->vertices, a, c) <= diagonal(mesh->vertices, b, d);
    const uint32_t lower[3] = {a, b, first ? c : d};
    const uint32_t upper[3] = {first ? a : b, c, d};
    add_triangle(mesh, lower, owner);
    add_triangle(mesh, upper, owner);
}

static void add_triangles(crease_mesh *mesh, const crease_grid *grid, uint32_t owner)
{
    const crease_axis *const u = &grid->axes[0];
    const crease_axis *const v = &grid->axes[1];
    for (size_t i = 0; i + 1 < u->line_count; i++)
        for (size_t j = 0; j + 1 < v->line_count; j++)
            if (u->lines[i].place != u->lines[i + 1].place &&
                v->lines[j].place != v->lines[j + 1].place)
                add_cell(mesh, (uint32_t)(grid->first_vertex + i * v->line_count + j),
                    (uint32_t)v->line_count, owner);
}

/* ------------------------------------------------------------------------------------ mesh -- */

/* Numbers the vertices and makes room for everything. */
static crease_status make_room(crease_context *context, work *w)
{
    size_t vertices = 0;
    size_t cells = 0;
    for (size_t i = 0; i < w->count; i++) {
        const crease_axis *const axes = w->grids[i].axes;
        w->grids[i].first_vertex = vertices;
        vertices += axes[0].line_count * axes[1].line_count;
        cells += (axes[0].place_count - 1) * (axes[1].place_count - 1);
        if (vertices > UINT32_MAX)
            return crease_fail(context, CREASE_ERROR_ARGUMENT,
                "mesh: the tolerance asks for too many triangles; give a larger one");
    }
    crease_mesh *const mesh = w->mesh;
    mesh->vertex_count = vertices;
    mesh->vertices = crease_allocate(context, vertices, 3 * sizeof *mesh->vertices);
    mesh->normals = crease_allocate(context, vertices, 3 * sizeof *mesh->normals);
    mesh->triangles = crease_allocate(context, 2 * cells, 3 * sizeof *mesh->triangles);
    mesh->owners = crease_allocate(context, 2 * cells, sizeof *mesh->owners);
    return mesh->vertices && mesh->normals && mesh->triangles && mesh->owners
        ? CREASE_OK
        : CREASE_ERROR_NO_MEMORY;
}

static crease_status tessellate(
    crease_context *context, const crease_surface *const *surfaces, double tolerance, work *w)
{
    const double size = extent(surfaces, w->count);
    const double chosen = tolerance > 0.0 ? tolerance : size / 2000.0;
    crease_status status = make_grids(context, surfaces, chosen, size, w);
    if (status == CREASE_OK)
        status = make_room(context, w);
    if (status != CREASE_OK)
        return status;
    crease_stage(context, "tessellation");
    status = crease_parallel_for(context, w->mesh->vertex_count, GRAIN, place_vertices, w);
    if (status == CREASE_OK)
        status = close_gaps(context, w);
    for (size_t i = 0; i < w->count && status == CREASE_OK; i++)
        add_triangles(w->mesh, &w->grids[i], (uint32_t)i);
    return status;
}

crease_status crease_mesh_create(crease_context *context, const crease_surface *const *surfaces,
    size_t count, double tolerance, crease_mesh **out)
{
    *out = NULL;
    if (!(tolerance >= 0.0))
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "mesh: the tolerance is %g; give a length, or 0 for the default", tolerance);
    if (count == 0 || count > UINT32_MAX / 4)
        return crease_fail(
            context, CREASE_ERROR_ARGUMENT, "mesh: %zu surfaces; give at least one", count);
    work w = {.count = count};
    w.grids = crease_allocate(context, count, sizeof *w.grids);
    w.mesh = crease_allocate(context, 1, sizeof *w.mesh);
    const crease_status status =
        w.grids && w.mesh ? tessellate(context, surfaces, tolerance, &w) : CREASE_ERROR_NO_MEMORY;
    for (size_t i = 0; w.grids && i < count; i++)
        crease_grid_release(&w.grids[i]);
    free(w.grids);
    free(w.matches);
    if (status == CREASE_OK)
        *out = w.mesh;
    else
        crease_mesh_free(w.mesh);
    return status;
}

void crease_mesh_free(crease_mesh *mesh)
{
    if (!mesh)
        return;
    free(mesh->vertices);
    free(mesh->normals);
    free(mesh->triangles);
    free(mesh->owners);
    free(mesh);
}

size_t crease_mesh_vertex_count(const crease_mesh *mesh)
{
    return mesh->vertex_count;
}

size_t crease_mesh_triangle_count(const crease_mesh *mesh)
{
    return mesh->triangle_count;
}

const double *crease_mesh_vertices(const crease_mesh *mesh)
{
    return mesh->vertices;
}

const double *crease_mesh_normals(const crease_mesh *mesh)
{
    return mesh->normals;
}

const uint32_t *crease_mesh_triangles(const crease_mesh *mesh)
{
    return mesh->triangles;
}

const uint32_t *crease_mesh_owners(const crease_mesh *mesh)
{
    return mesh->owners;
}
