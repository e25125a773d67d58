/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Meshes from triangles that others made. */
#include "mesh/mesh.h"

#include "base/memory.h"
#include "base/vector.h"

#include <math.h>

static crease_status check(crease_context *context, const crease_mesh_parts *parts)
{
    for (size_t i = 0; i < 3 * parts->vertex_count; i++)
        if (!isfinite(parts->vertices[i]))
            return crease_fail(context, CREASE_ERROR_VALUE,
                "mesh: vertex %zu has a coordinate that is not finite; leave it out", i / 3);
    for (size_t i = 0; i < 3 * parts->triangle_count; i++)
        if (parts->triangles[i] >= parts->vertex_count)
            return crease_fail(context, CREASE_ERROR_ARGUMENT,
                "mesh: triangle %zu names vertex %u, but there are %zu; count from 0", i / 3,
                parts->triangles[i], parts->vertex_count);
    return CREASE_OK;
}

/* Adds the triangle's normal, as long as twice its area, to those of its corners. */
static void add_normal(crease_mesh *mesh, const uint32_t corners[3])
{
    const double *const a = mesh->vertices + 3 * (size_t)corners[0];
    const double *const b = mesh->vertices + 3 * (size_t)corners[1];
    const double *const c = mesh->vertices + 3 * (size_t)corners[2];
    double ab[3], ac[3], normal[3];
    for (int i = 0; i < 3; i++)
        ab[i] = b[i] - a[i], ac[i] = c[i] - a[i];
    crease_vector_cross(ab, ac, normal);
    for (int corner = 0; corner < 3; corner++)
        for (int i = 0; i < 3; i++)
            mesh->normals[3 * (size_t)corners[corner] + (size_t)i] += normal[i];
}

crease_status crease_mesh_from_parts(
    crease_context *context, const crease_mesh_parts *parts, crease_mesh **out)
{
    *out = NULL;
    const crease_status status = check(context, parts);
    if (status != CREASE_OK)
        return status;
    crease_mesh *const mesh = crease_allocate(context, 1, sizeof *mesh);
    if (!mesh)
        return CREASE_ERROR_NO_MEMORY;
    const size_t vertices = mesh->vertex_count = parts->vertex_count;
    const size_t triangles = mesh->triangle_count = parts->triangle_count;
    mesh->vertices = crease_duplicate(context, parts->vertices, vertices, 3 * sizeof(double));
    mesh->normals = crease_allocate(context, vertices, 3 * sizeof(double));
    mesh->triangles = crease_duplicate(context, parts->triangles, triangles, 3 * sizeof(uint32_t));
    mesh->owners = parts->owners
        ? crease_duplicate(context, parts->owners, triangles, sizeof(uint32_t))
        : crease_allocate(context, triangles, sizeof(uint32_t));
    if (!mesh->vertices || !mesh->normals || !mesh->triangles || !mesh->owners) {
        crease_mesh_free(mesh);
        return CREASE_ERROR_NO_MEMORY;
    }
    for (size_t t = 0; t < triangles; t++)
        add_normal(mesh, mesh->triangles + 3 * t);
    for (size_t v = 0; v < vertices; v++)
        crease_vector_normalise(mesh->normals + 3 * v);
    *out = mesh;
    return CREASE_OK;
}
