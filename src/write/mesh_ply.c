/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "write/mesh.h"

void crease_mesh_write_ply(crease_output *output, const crease_mesh *mesh)
{
    const size_t vertices = crease_mesh_vertex_count(mesh);
    const size_t triangles = crease_mesh_triangle_count(mesh);
    crease_output_format(output,
        "ply\nformat binary_little_endian 1.0\ncomment crease %s\nelement vertex %zu\n"
        "property double x\nproperty double y\nproperty double z\n"
        "property float nx\nproperty float ny\nproperty float nz\n"
        "element face %zu\nproperty list uchar int vertex_indices\nproperty int surface\n"
        "end_header\n",
        crease_version(), vertices, triangles);
    for (size_t i = 0; i < vertices; i++) {
        for (size_t c = 0; c < 3; c++)
            crease_output_binary_f64(output, crease_mesh_vertices(mesh)[3 * i + c]);
        for (size_t c = 0; c < 3; c++)
            crease_output_binary_f32(output, (float)crease_mesh_normals(mesh)[3 * i + c]);
    }
    const unsigned char corners = 3;
    for (size_t i = 0; i < triangles && !crease_output_failed(output); i++) {
        crease_output_bytes(output, &corners, 1);
        for (size_t c = 0; c < 3; c++)
            crease_output_binary_u32(output, crease_mesh_triangles(mesh)[3 * i + c]);
        crease_output_binary_u32(output, crease_mesh_owners(mesh)[i]);
    }
}
