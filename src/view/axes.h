/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The box around a scene: panes behind it, a grid, numbered ticks along three of its edges. */
#ifndef CREASE_VIEW_AXES_H
#define CREASE_VIEW_AXES_H

#include "view/camera.h"
#include "view/ticks.h"

#include <cairo.h>
#include <stdbool.h>

/* A rectangle of the drawing. */
typedef struct crease_area {
    double left, top, right, bottom;
} crease_area;

typedef struct crease_axis {
    double from[3], to[3];       /* the numbered edge of the box */
    double outward_x, outward_y; /* away from the box, a unit vector of the drawing */
    crease_ticks ticks;
    double reach; /* of the longest label along outward */
} crease_axis;

typedef struct crease_axes {
    double lowest[3], highest[3]; /* the box */
    crease_axis axes[3];
    double font, unit; /* size of the numbers; how long 1/1200 of the drawing's width is */
} crease_axes;

/* The box of a scene: a little larger than its bounds, and never flat. */
void crease_axes_enclose(crease_axes *axes, const double lowest[3], const double highest[3]);
/* Chooses edges and ticks for the camera. */
void crease_axes_arrange(crease_axes *axes, cairo_t *cairo, const crease_camera *camera);
/* What the box with all its numbers covers on the drawing. */
crease_area crease_axes_cover(
    const crease_axes *axes, cairo_t *cairo, const crease_camera *camera, bool numbered);
void crease_axes_draw(const crease_axes *axes, cairo_t *cairo, const crease_camera *camera);

#endif
