/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The grid of parameters on which one surface is meshed. */
#ifndef CREASE_MESH_GRID_H
#define CREASE_MESH_GRID_H

#include "base/context.h"

/* A grid line: a parameter, and from which side normals are taken on it. At a crease inside the
 * surface two lines have the same place. */
typedef struct crease_grid_line {
    double t;
    crease_side side;
    size_t place; /* number of the parameter among the distinct ones */
} crease_grid_line;

typedef struct crease_axis {
    size_t span_count;
    double *breaks;    /* span_count + 1 */
    double *divisions; /* span_count whole numbers */
    bool *sharp;       /* span_count + 1: a crease runs along this break */
    size_t line_count, place_count;
    crease_grid_line *lines;
} crease_axis;

/* Vertex number (i, j) of the grid is first_vertex + i * axes[1].line_count + j. */
typedef struct crease_grid {
    crease_surface *surface; /* clamped */
    crease_axis axes[2];
    size_t first_vertex;
} crease_grid;

/* Finds breaks, creases and how often each span must be divided for the tolerance; no lines yet.
 * Release the grid also after a failure. */
crease_status crease_grid_prepare(
    crease_context *context, const crease_surface *surface, double tolerance, crease_grid *out);
/* Makes the lines that the divisions ask for. ARGUMENT when they are too many. */
crease_status crease_grid_draw(crease_context *context, crease_grid *grid);
void crease_grid_release(crease_grid *grid);

#endif
