/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* How true a sheet is to the two planes that its points were taken from. */
#ifndef CREASE_FIT_ACCURACY_H
#define CREASE_FIT_ACCURACY_H

#include "cloud/shape.h"

typedef struct crease_accuracy {
    size_t lines; /* crease lines of the sheet */
    /* Root mean square distance of the crease line nearest to the true edge from it, measured
     * across the edge; not a number when the sheet has no crease line. */
    double position;
    double angle; /* dihedral angle at that line, degrees; 180 when there is none */
    /* Length of the sheet, measured on it across the edge, from the place nearest to the edge to
     * both sides, over which its normal is more than 10 degrees off both true planes: the rounded
     * or flattened zone. Mean along the edge. */
    double width;
    /* Distance of the sheet from the true faces: root mean square over its area, and largest. */
    double rms, max;
} crease_accuracy;

/* Measures on 16 sections across the edge of 256 places each. */
crease_accuracy crease_accuracy_measure(const crease_sheet *sheet, const crease_roof *roof);

#endif
