/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The neighbours of one point, prepared for many weighted covariances. */
#ifndef CREASE_DETECT_NEIGHBOURHOOD_H
#define CREASE_DETECT_NEIGHBOURHOOD_H

#include "detect/eigen.h"
#include "space/kdtree.h"

/* Coordinates relative to the point in units of its distance to the farthest neighbour, and their
 * products: x y z xx xy xz yy yz zz, then zeros up to a whole number of vectors. */
enum { CREASE_MOMENTS = 12 };

typedef struct crease_neighbourhood {
    int k;
    double moments[CREASE_MOST_NEIGHBOURS][CREASE_MOMENTS];
} crease_neighbourhood;

/* positions: the k neighbours, the point itself first. */
void crease_neighbourhood_fill(
    const crease_tree *tree, const uint32_t *positions, int k, crease_neighbourhood *out);

/* Covariance (times k) of all k neighbours as matrix `lane`. */
void crease_neighbourhood_covariance(
    const crease_neighbourhood *neighbourhood, crease_matrices *matrices, size_t lane);

/* Covariances (times k) of count resamples made from words (see bootstrap.h); count at most
 * CREASE_BATCH. */
void crease_neighbourhood_resample(const crease_neighbourhood *neighbourhood, const uint32_t *words,
    size_t count, crease_matrices *matrices);

#endif
