/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The triangles of a mesh, as a file holds them: vertices, and three numbers of them each. */
#ifndef CREASE_FACETS_FACETS_H
#define CREASE_FACETS_FACETS_H

#include "crease/crease.h"

typedef struct crease_facets {
    const char *name; /* of the file, for sentences */
    double *vertices; /* vertex_count x 3 */
    size_t vertex_count;
    uint32_t *corners; /* triangle_count x 3 */
    size_t triangle_count, room;
} crease_facets;

/* The corners of a polygon that were added so far. */
typedef struct crease_polygon {
    size_t corners;
    uint32_t first, last;
} crease_polygon;

/* Copies the vertices; there are no triangles yet. Errors: NO_MEMORY. */
crease_status crease_facets_begin(crease_context *context, crease_facets *facets, const char *name,
    const double *vertices, size_t count);
/* Adds the next corner of a polygon, which begins as {0}; from the third one on each makes a
 * triangle with the first and the last. Errors: FORMAT when there is no such vertex, its sentence
 * says which; NO_MEMORY. */
crease_status crease_facets_add(
    crease_context *context, crease_facets *facets, crease_polygon *polygon, double vertex);
/* Makes vertices at one place one, and leaves out triangles that have no area. Errors: NO_MEMORY.
 */
crease_status crease_facets_weld(crease_context *context, crease_facets *facets);
void crease_facets_free(crease_facets *facets);

/* Corner 0..2 of a triangle. */
static inline const double *crease_facets_corner(
    const crease_facets *facets, size_t triangle, int corner)
{
    return facets->vertices + 3 * (size_t)facets->corners[3 * triangle + (size_t)corner];
}
/* The normal, as long as twice the area. */
void crease_facets_normal(const crease_facets *facets, size_t triangle, double normal[3]);

#endif
