/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What a figure draws above its surfaces: dots and lines, faint where a surface hides them. */
#ifndef CREASE_VIEW_MARKS_H
#define CREASE_VIEW_MARKS_H

#include "view/polylines.h"
#include "view/raster.h"

/* The drawing that marks are put on. */
typedef struct crease_canvas {
    crease_context *context;
    cairo_t *cairo;
    crease_camera camera;
    crease_raster *raster; /* what hides, or NULL when nothing does */
    double unit;           /* 1/1200 of the drawing's width */
    double slack;          /* depth within which a mark counts as lying on a surface */
} crease_canvas;

typedef struct crease_pen {
    crease_colour colour;
    double width;
    double seen, hidden; /* opacity before and behind a surface */
} crease_pen;

typedef struct crease_dot {
    crease_spot spot;
    double radius;
    crease_colour colour;
    size_t order; /* decides between dots of the same depth */
} crease_dot;

/* Strokes every link. */
void crease_marks_draw_lines(
    const crease_canvas *canvas, const crease_polylines *lines, const crease_pen *pen);
/* Sorts the dots and draws them, the farthest first. */
void crease_marks_draw_dots(const crease_canvas *canvas, crease_dot *dots, size_t count);
/* One dot, in full colour. */
void crease_marks_draw_dot(const crease_canvas *canvas, const crease_dot *dot, double opacity);

#endif
