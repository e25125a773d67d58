/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "write/mesh.h"

#include "base/vector.h"

#include <stdio.h>

static void write_triangle(crease_output *output, const crease_mesh *mesh, size_t triangle)
{
    const double *corners[3];
    double edges[2][3], normal[3];
    for (size_t k = 0; k < 3; k++)
        corners[k] =
            crease_mesh_vertices(mesh) + 3 * (size_t)crease_mesh_triangles(mesh)[3 * triangle + k];
    for (int c = 0; c < 3; c++) {
        edges[0][c] = corners[1][c] - corners[0][c];
        edges[1][c] = corners[2][c] - corners[0][c];
    }
    crease_vector_cross(edges[0], edges[1], normal);
    crease_vector_normalise(normal);
    for (int c = 0; c < 3; c++)
        crease_output_binary_f32(output, (float)normal[c]);
    for (int k = 0; k < 3; k++)
        for (int c = 0; c < 3; c++)
            crease_output_binary_f32(output, (float)corners[k][c]);
    crease_output_binary_u16(output, 0);
}

void crease_mesh_write_stl(crease_output *output, const crease_mesh *mesh)
{
    char header[80] = {0};
    snprintf(header, sizeof header, "crease %s", crease_version());
    crease_output_bytes(output, header, sizeof header);
    crease_output_binary_u32(output, (uint32_t)crease_mesh_triangle_count(mesh));
    for (size_t i = 0; i < crease_mesh_triangle_count(mesh); i++)
        write_triangle(output, mesh, i);
}
