/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#ifndef CREASE_MESH_MESH_H
#define CREASE_MESH_MESH_H

#include "base/context.h"

struct crease_mesh {
    size_t vertex_count, triangle_count;
    double *vertices, *normals;   /* vertex_count x 3 */
    uint32_t *triangles, *owners; /* triangle_count x 3, triangle_count */
};

#endif
