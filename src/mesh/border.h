/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Borders that two surfaces share: the same order, control points and knots, but for rounding, a
 * change of the parameter's scale and the direction of travel. */
#ifndef CREASE_MESH_BORDER_H
#define CREASE_MESH_BORDER_H

#include "mesh/grid.h"

/* One of the four borders of a surface: where the parameter of `direction` is lowest or highest. */
typedef struct crease_border {
    size_t surface;
    int direction;
    bool highest;
    double key; /* the same for borders that coincide, but for rounding */
} crease_border;

/* `second` runs along `first`, backwards when reversed. */
typedef struct crease_match {
    crease_border first, second;
    bool reversed;
} crease_match;

/* All pairs of borders that coincide within the tolerance. The caller frees *out. */
crease_status crease_borders_match(crease_context *context, const crease_grid *grids, size_t count,
    double tolerance, crease_match **out, size_t *match_count);

#endif
