/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Corners of a ragged border. */
#ifndef CREASE_TRIM_BEND_H
#define CREASE_TRIM_BEND_H

#include "trim/contour.h"

/* Numbers of the points at which the border has a corner, ascending; room for all. at: how far
 * along the border each point is; length: of the border once round, if closed. */
size_t crease_bends_find(const crease_rag *rag, const double *at, double length, size_t *corners);

#endif
