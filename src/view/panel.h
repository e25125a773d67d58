/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* One scene drawn into a rectangle: title, box, surfaces, marks, legend, colour bar. */
#ifndef CREASE_VIEW_PANEL_H
#define CREASE_VIEW_PANEL_H

#include "view/axes.h"
#include "view/scene.h"

typedef struct crease_panel {
    const crease_scene *scene;
    crease_figure_options options; /* width and height are those of the panel */
    double left, top;              /* its corner on the drawing */
    char letter;                   /* of a figure with several panels, or 0 */
    double density;                /* pixels per unit of the drawing, for what is not lines */
} crease_panel;

/* Draws the panel. Errors: ARGUMENT (nothing to show, no such field), NO_MEMORY. */
crease_status crease_panel_draw(crease_context *context, const crease_panel *panel, cairo_t *cairo);

#endif
