/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Lines of text on a drawing, placed by their middle. */
#ifndef CREASE_VIEW_LETTERING_H
#define CREASE_VIEW_LETTERING_H

#include <cairo.h>
#include <stdbool.h>

typedef struct crease_lettering {
    const char *text; /* clean text */
    const char *note; /* set upright behind the text, or NULL */
    int power;        /* set as an exponent behind the note when it is not 0 */
    double x, y;      /* the middle */
    double size;
    bool italic, bold; /* of the text, not of the note */
    bool upright;      /* turned by 90 degrees, read from below */
} crease_lettering;

typedef struct crease_extent {
    double width, height;
} crease_extent;

/* Sets what makes text look the same on every target. */
void crease_lettering_prepare(cairo_t *cairo);
/* The extent of plain text; the height is that of digits and capitals. */
crease_extent crease_lettering_measure(cairo_t *cairo, const char *text, double size);
/* The extent on the drawing, turned if the text is. */
crease_extent crease_lettering_extent(cairo_t *cairo, const crease_lettering *lettering);
/* Draws in the current colour. */
void crease_lettering_draw(cairo_t *cairo, const crease_lettering *lettering);
/* The text with its end replaced by an ellipsis so that it fits the width; changes the text, which
 * must have room for three bytes more. */
void crease_lettering_fit(cairo_t *cairo, char *text, double size, bool bold, double width);

#endif
