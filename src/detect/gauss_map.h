/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Clusters of the normals of the triangles that a point forms with pairs of its neighbours. */
#ifndef CREASE_DETECT_GAUSS_MAP_H
#define CREASE_DETECT_GAUSS_MAP_H

#include "detect/neighbourhood.h"

/* The greatest distance at which two clusters of normals that both count are still apart: 0 where
 * all normals are one, up to 1. O(k^2) up to k = 16, beyond that constant. */
double crease_gauss_map_separation(const crease_neighbourhood *neighbourhood);

#endif
