/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What a mesh is the approximation of: which of its triangles are facets of curved faces, and the
 * normals that these have at the vertices. */
#ifndef CREASE_FACETS_SHADING_H
#define CREASE_FACETS_SHADING_H

#include "facets/facets.h"

typedef struct crease_shading {
    double *normals; /* of each corner of each triangle, of unit length: 9 numbers a triangle */
    bool *curved;    /* of each triangle */
    double *areas;   /* of each triangle */
    double area;     /* of all */
    double narrow;   /* width of the narrowest faces, but for a few thousandths of the area */
} crease_shading;

/* Neighbours that turn by up to 20 degrees are facets of one face; those in one plane are one
 * facet. A facet is curved where a neighbour is that is about as wide or wider, and turns on two
 * sides: a flat face beside a fillet is much wider than the fillet's facets. At a corner where
 * curved facets meet a flat one the normal is that of the flat one, otherwise the mean of the
 * facets', weighted by their angles (Thürmer and Wüthrich. Computing vertex normals from polygonal
 * facets. 1998). Turns triangles so that they face the same way. O(n log n). Errors: NO_MEMORY. */
crease_status crease_shading_find(
    crease_context *context, crease_facets *facets, crease_shading *out);
void crease_shading_free(crease_shading *shading);

/* A place of the curved triangle through three corners with their normals: weights of the corners,
 * which add up to 1. (Vlachos, Peters, Boyd, Mitchell. Curved PN triangles. 2001: the cubic of
 * section 3.) */
void crease_shading_place(const crease_facets *facets, const crease_shading *shading,
    size_t triangle, const double weights[3], double place[3]);

#endif
