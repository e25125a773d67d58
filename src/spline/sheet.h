/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The sheet: a surface and the lines along which it is sharp. Internal view. Both ways to fit one
 * fill it in place; every pointer is owned by the sheet. */
#ifndef CREASE_SPLINE_SHEET_H
#define CREASE_SPLINE_SHEET_H

#include "base/context.h"
#include "base/frame.h"

struct crease_sheet {
    crease_surface *surface;
    crease_line *lines;
    size_t line_count;
    crease_frame frame;
    size_t point_count;
    double *parameters; /* point_count x 2, or NULL */
    double *projected;  /* point_count x 3 */
    double *deviations; /* point_count */
    double *variance;   /* point_count or NULL */
    double *errors;     /* point_count or NULL: standard errors */
};

/* Angle in degrees by which the surface bends at a place on a line of constant parameter: 0 smooth.
 */
double crease_sheet_bend(const crease_surface *surface, int direction, const double uv[2]);
/* Mean dihedral angle (degrees, 180 = flat) of the surface along a line of constant parameter. */
double crease_sheet_dihedral(const crease_surface *surface, int direction, double parameter);
/* The same over the places of the line that count; over all when none does. */
double crease_sheet_dihedral_where(const crease_surface *surface, int direction, double parameter,
    bool (*counts)(const void *user, double u, double v), const void *user);

#endif
