/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Round numbers along an axis and how they are written. */
#ifndef CREASE_VIEW_TICKS_H
#define CREASE_VIEW_TICKS_H

enum { CREASE_TICKS_MOST = 12, CREASE_TICK_SIZE = 32 };

typedef struct crease_ticks {
    int count;
    double values[CREASE_TICKS_MOST];
    char labels[CREASE_TICKS_MOST][CREASE_TICK_SIZE]; /* of (value - offset) / 10^power */
    double offset;
    int power;
    char note[2 * CREASE_TICK_SIZE]; /* " − 512300", " / 10" or ""; power is set as an exponent */
} crease_ticks;

/* About `wanted` (2..10) multiples of 1, 2 or 5 times a power of ten within lowest..highest. Long
 * numbers are shortened by an offset or a power that the note tells. */
crease_ticks crease_ticks_between(double lowest, double highest, int wanted);
/* A number with so many decimals, with a point and a true minus sign in any locale. */
void crease_tick_print(double value, int decimals, char out[CREASE_TICK_SIZE]);

#endif
