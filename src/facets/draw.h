/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A cloud drawn on a mesh: about evenly, on the curved faces that its facets approximate. */
#ifndef CREASE_FACETS_DRAW_H
#define CREASE_FACETS_DRAW_H

#include "base/context.h"
#include "facets/facets.h"

/* Whether the vertices alone are a cloud of the surface: there are thousands, and next to no
 * triangle is much larger than their distances. */
bool crease_facets_dense(const crease_facets *facets);

/* wanted: about how many points, at least 4; -1: enough for the narrowest faces, and no fewer than
 * the vertices, 10 000 to 100 000. Facets Facets are welded and turned to face the same way. Random
 * with the context's seed. O(n log n) in triangles and points. Errors: VALUE when there is no area,
 * CANCELLED, NO_MEMORY. */
crease_status crease_facets_draw(
    crease_context *context, crease_facets *facets, int wanted, crease_cloud **out);

#endif
