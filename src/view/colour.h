/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Colours: those of the paper, two colour maps, and the range of a field that a map covers.
 *
 * The maps are paths through OKLCh, a space whose lightness, chroma and hue are those that the eye
 * sees, so that equal steps of a value look like equal steps of colour, and lightness alone tells
 * the order in print without colour.
 * Based on: Ottosson. A perceptual color space for image processing. 2020. */
#ifndef CREASE_VIEW_COLOUR_H
#define CREASE_VIEW_COLOUR_H

#include "crease/crease.h"

/* Red, green and blue, 0..1, as they are sent to the screen (sRGB). */
typedef struct crease_colour {
    double red, green, blue;
} crease_colour;

typedef enum crease_map {
    CREASE_MAP_SEQUENTIAL, /* dark violet, blue, green, light yellow: from little to much */
    CREASE_MAP_DIVERGING   /* blue, white, red: below and above zero */
} crease_map;

/* What a colour bar covers. */
typedef struct crease_range {
    double lowest, highest;
    crease_map map;
    bool below, above; /* values lie beyond the end: it takes its colour */
} crease_range;

/* The colour of a lightness 0..1, chroma and hue in degrees; chroma is lessened until a screen can
 * show it. */
crease_colour crease_colour_of_lch(double lightness, double chroma, double hue);
/* The colour at t of 0..1 (moved to the ends when outside). */
crease_colour crease_map_at(crease_map map, double t);
/* The map as 256 triples of bytes. */
void crease_map_table(crease_map map, uint8_t table[256][3]);

/* The range of the finite values of a field. When a few far values would leave the others one
 * colour, the 1st to the 99th of a hundred is taken instead. Values of both signs get the diverging
 * map and a range that is even about zero. Errors: NO_MEMORY. O(n log n). */
crease_status crease_range_of_field(
    crease_context *context, const crease_field *field, size_t count, crease_range *out);
/* The colour of a value; grey when it is not finite. */
crease_colour crease_range_colour(const crease_range *range, double value);

#endif
