/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "facets/facets.h"

#include "base/memory.h"
#include "base/vector.h"
#include "cloud/weld.h"

#include <stdlib.h>
#include <string.h>

crease_status crease_facets_begin(crease_context *context, crease_facets *facets, const char *name,
    const double *vertices, size_t count)
{
    facets->name = name;
    facets->vertices = crease_duplicate(context, vertices, count, 3 * sizeof *vertices);
    facets->vertex_count = count;
    return facets->vertices ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
}

static crease_status add_triangle(
    crease_context *context, crease_facets *facets, const uint32_t corners[3])
{
    if (facets->triangle_count == facets->room) {
        const size_t room = facets->room ? 2 * facets->room : 64;
        uint32_t *const grown =
            crease_reallocate(context, facets->corners, room, 3 * sizeof *grown);
        if (!grown)
            return CREASE_ERROR_NO_MEMORY;
        facets->corners = grown;
        facets->room = room;
    }
    memcpy(facets->corners + 3 * facets->triangle_count++, corners, 3 * sizeof *corners);
    return CREASE_OK;
}

crease_status crease_facets_add(
    crease_context *context, crease_facets *facets, crease_polygon *polygon, double vertex)
{
    if (!(vertex >= 0 && vertex < (double)facets->vertex_count))
        return crease_fail(context, CREASE_ERROR_FORMAT,
            "%s: a face has vertex %.0f, counted from 0, of %zu; mend the file, or read its "
            "vertices "
            "alone with --mesh-points 0",
            facets->name, vertex, facets->vertex_count);
    const uint32_t corners[3] = {polygon->first, polygon->last, (uint32_t)vertex};
    if (polygon->corners++ == 0)
        polygon->first = corners[2];
    polygon->last = corners[2];
    return polygon->corners > 2 ? add_triangle(context, facets, corners) : CREASE_OK;
}

static bool has_area(const crease_facets *facets, size_t triangle)
{
    double normal[3];
    crease_facets_normal(facets, triangle, normal);
    return crease_vector_length(normal) > 0;
}

crease_status crease_facets_weld(crease_context *context, crease_facets *facets)
{
    uint32_t *const numbers = crease_allocate(context, facets->vertex_count, sizeof *numbers);
    const crease_status status = numbers ? crease_weld(context, facets->vertices,
                                               facets->vertex_count, numbers, &facets->vertex_count)
                                         : CREASE_ERROR_NO_MEMORY;
    size_t kept = 0;
    for (size_t i = 0; i < facets->triangle_count && status == CREASE_OK; i++) {
        for (size_t c = 0; c < 3; c++)
            facets->corners[3 * kept + c] = numbers[facets->corners[3 * i + c]];
        kept += has_area(facets, kept);
    }
    facets->triangle_count = kept;
    free(numbers);
    return status;
}

void crease_facets_normal(const crease_facets *facets, size_t triangle, double normal[3])
{
    const double *const a = crease_facets_corner(facets, triangle, 0);
    const double *const b = crease_facets_corner(facets, triangle, 1);
    const double *const c = crease_facets_corner(facets, triangle, 2);
    const double ab[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const double ac[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    crease_vector_cross(ab, ac, normal);
}

void crease_facets_free(crease_facets *facets)
{
    free(facets->vertices);
    free(facets->corners);
    *facets = (crease_facets){0};
}
