/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* How true a sheet is to the two planes that its points were taken from. */
#ifndef CREASE_FIT_ACCURACY_H
#define CREASE_FIT_ACCURACY_H

#include "cloud/shape.h"

/* Measures on 16 sections across the edge of 256 places each. */
crease_accuracy crease_accuracy_measure(const crease_sheet *sheet, const crease_roof *roof);

#endif
