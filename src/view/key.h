/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What explains a figure: the legend of its layers and the colour bar of a field. */
#ifndef CREASE_VIEW_KEY_H
#define CREASE_VIEW_KEY_H

#include "view/axes.h"
#include "view/marks.h"

typedef struct crease_entry {
    char name[128];
    crease_colour colour;
    bool dot, line, patch; /* what its symbol is made of */
    double width;          /* of the line */
} crease_entry;

typedef struct crease_legend {
    crease_entry *entries;
    size_t count;
    double font;
} crease_legend;

/* The height of the legend when its rows are no longer than the width. Long names are cut. */
double crease_legend_measure(const crease_canvas *canvas, crease_legend *legend, double width);
/* Draws the rows, each in the middle of left..right, downwards from top. */
void crease_legend_draw(
    const crease_canvas *canvas, const crease_legend *legend, const crease_area *area);

typedef struct crease_bar {
    crease_range range;
    crease_ticks ticks;
    char title[128];
    double font, thickness;
} crease_bar;

/* The width of a colour bar of this height with its numbers and title. */
double crease_bar_measure(const crease_canvas *canvas, crease_bar *bar, double height);
/* Draws it from the area's left and within its top and bottom. */
void crease_bar_draw(const crease_canvas *canvas, const crease_bar *bar, const crease_area *area);

#endif
