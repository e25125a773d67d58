/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "write/mesh.h"

static void write_triple(crease_output *output, const char *word, const double *values, bool single)
{
    crease_output_text(output, word);
    for (int c = 0; c < 3; c++) {
        crease_output_text(output, " ");
        if (single)
            crease_output_float(output, (float)values[c]);
        else
            crease_output_double(output, values[c]);
    }
    crease_output_text(output, "\n");
}

void crease_mesh_write_obj(crease_output *output, const crease_mesh *mesh)
{
    const uint32_t *const owners = crease_mesh_owners(mesh);
    crease_output_format(output, "# crease %s\n", crease_version());
    for (size_t i = 0; i < crease_mesh_vertex_count(mesh); i++)
        write_triple(output, "v", crease_mesh_vertices(mesh) + 3 * i, false);
    for (size_t i = 0; i < crease_mesh_vertex_count(mesh); i++)
        write_triple(output, "vn", crease_mesh_normals(mesh) + 3 * i, true);
    for (size_t i = 0; i < crease_mesh_triangle_count(mesh); i++) {
        if (i == 0 || owners[i] != owners[i - 1])
            crease_output_format(output, "g surface_%u\n", owners[i] + 1);
        crease_output_text(output, "f");
        for (size_t c = 0; c < 3; c++) {
            const uint64_t number = (uint64_t)crease_mesh_triangles(mesh)[3 * i + c] + 1;
            crease_output_format(
                output, " %llu//%llu", (unsigned long long)number, (unsigned long long)number);
        }
        crease_output_text(output, "\n");
    }
}
