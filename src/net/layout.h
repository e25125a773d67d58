/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Where the knots of a sheet stand: crease lines, at which the sheet has a sharp bend, and simple
 * knots spread evenly between them. */
#ifndef CREASE_NET_LAYOUT_H
#define CREASE_NET_LAYOUT_H

#include <stdbool.h>
#include <stddef.h>

enum { CREASE_MOST_LINES = 16 };

typedef struct crease_layout_axis {
    double low, high;                /* the domain */
    double lines[CREASE_MOST_LINES]; /* ascending, inside the domain */
    size_t line_count;
    size_t smooth; /* simple knots, over the whole domain */
} crease_layout_axis;

typedef struct crease_layout {
    int order;
    crease_layout_axis axis[2];
} crease_layout;

/* Number of control points along a direction. */
size_t crease_layout_count(const crease_layout *layout, int direction);
/* The knots: order times at the ends of the domain, order - 1 times at a line. */
void crease_layout_knots(const crease_layout *layout, int direction, double *knots);
/* Adds a line; false when there is no room, or when it would come too near to another line or to
 * the border, measured in spacings of the points. */
bool crease_layout_add(crease_layout *layout, int direction, double at, double spacing);
void crease_layout_remove(crease_layout *layout, int direction, size_t line);
/* The part of the domain between lines that holds t. */
void crease_layout_between(
    const crease_layout *layout, int direction, double t, double interval[2]);

#endif
