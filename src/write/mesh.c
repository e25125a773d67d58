/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "write/mesh.h"

#include "base/vector.h"

#include <float.h>
#include <math.h>

enum { PLY, OBJ, STL, GLB, FORMAT_COUNT };

static const char *const extensions[FORMAT_COUNT] = {"ply", "obj", "stl", "glb"};

static void (*const writers[FORMAT_COUNT])(crease_output *, const crease_mesh *) = {
    crease_mesh_write_ply, crease_mesh_write_obj, crease_mesh_write_stl, crease_mesh_write_gltf};

void crease_mesh_bounds(const crease_mesh *mesh, double lowest[3], double highest[3])
{
    const double *const vertices = crease_mesh_vertices(mesh);
    for (int c = 0; c < 3; c++)
        lowest[c] = highest[c] = vertices[c];
    for (size_t i = 3; i < 3 * crease_mesh_vertex_count(mesh); i++) {
        lowest[i % 3] = fmin(lowest[i % 3], vertices[i]);
        highest[i % 3] = fmax(highest[i % 3], vertices[i]);
    }
}

/* STL's floats: what they lose matters when it is not small beside the mesh. */
static void warn_of_rounding(crease_context *context, const crease_mesh *mesh, const char *path)
{
    double lowest[3], highest[3];
    crease_mesh_bounds(mesh, lowest, highest);
    const double size = crease_vector_distance(lowest, highest);
    const double far = fmax(crease_vector_length(lowest), crease_vector_length(highest));
    if (far * (double)FLT_EPSILON > 1e-5 * size)
        crease_warn(context,
            "%s: STL holds floats, which round these positions by up to %g; write PLY or GLB", path,
            far * (double)FLT_EPSILON / 2.0);
}

/* The formats count bytes and triangles in 32 bits. */
static crease_status check_size(crease_context *context, const crease_mesh *mesh, const char *path)
{
    if (crease_mesh_triangle_count(mesh) == 0)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "%s: the mesh has no triangle; mesh a surface with an area", path);
    const double bytes = 24.0 * (double)crease_mesh_vertex_count(mesh) +
        12.0 * (double)crease_mesh_triangle_count(mesh);
    if (bytes > 4.0e9)
        return crease_fail(context, CREASE_ERROR_ARGUMENT,
            "%s: %zu triangles are too many for one file; mesh with a larger tolerance", path,
            crease_mesh_triangle_count(mesh));
    return CREASE_OK;
}

crease_status crease_mesh_write(crease_context *context, const crease_mesh *mesh, const char *path)
{
    size_t format = 0;
    crease_output *output = NULL;
    crease_status status = crease_output_choose(context, path, extensions, FORMAT_COUNT, &format);
    if (status == CREASE_OK)
        status = check_size(context, mesh, path);
    if (status == CREASE_OK)
        status = crease_output_open(context, path, &output);
    if (status != CREASE_OK)
        return status;
    writers[format](output, mesh);
    status = crease_output_close(context, output, CREASE_OK);
    if (status == CREASE_OK && format == STL)
        warn_of_rounding(context, mesh, path);
    return status;
}
