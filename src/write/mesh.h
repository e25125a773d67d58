/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The writers of meshes, one for each format. None checks its writes: closing the output does. */
#ifndef CREASE_WRITE_MESH_H
#define CREASE_WRITE_MESH_H

#include "write/output.h"

/* Binary little endian: positions in double, normals in float, the owner of each face. */
void crease_mesh_write_ply(crease_output *output, const crease_mesh *mesh);
/* Text: positions, normals, one group for each surface. */
void crease_mesh_write_obj(crease_output *output, const crease_mesh *mesh);
/* Binary: the format knows floats only, so positions far from the origin are rounded. */
void crease_mesh_write_stl(crease_output *output, const crease_mesh *mesh);
/* Binary glTF 2.0, y up as that format has it. Positions are relative to the middle of the mesh,
 * which the node's translation holds in full precision. */
void crease_mesh_write_gltf(crease_output *output, const crease_mesh *mesh);

/* Lowest and highest coordinates of the vertices. */
void crease_mesh_bounds(const crease_mesh *mesh, double lowest[3], double highest[3]);

#endif
