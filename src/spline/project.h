/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The closest point of a whole surface or curve, borders and creases included. */
#ifndef CREASE_SPLINE_PROJECT_H
#define CREASE_SPLINE_PROJECT_H

#include "base/context.h"

/* A surface made ready for projections, again and again. */
typedef struct crease_projector crease_projector;

/* The surface is kept, not copied. Time: as its Bezier patches. Memory: 100 bytes for each.
 * Threaded. Errors: NO_MEMORY, CANCELLED. */
crease_status crease_projector_create(
    crease_context *context, const crease_surface *surface, crease_projector **out);
void crease_projector_free(crease_projector *projector);
/* As crease_surface_project(). */
crease_status crease_projector_project(crease_context *context, const crease_projector *projector,
    const double *points, size_t count, crease_foot *feet);

/* The same as crease_surface_project for a curve: uv[0] is the curve's parameter, uv[1] zero, and
 * the distance is not signed. */
crease_status crease_curve_project(crease_context *context, const crease_curve *curve,
    const double *points, size_t count, crease_foot *feet);

#endif
