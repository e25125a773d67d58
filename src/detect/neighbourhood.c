/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "detect/neighbourhood.h"

#include "base/simd.h"
#include "detect/bootstrap.h"

#include <math.h>

enum { X, Y, Z, XX, XY, XZ, YY, YZ, ZZ };

void crease_neighbourhood_fill(
    const crease_tree *tree, const uint32_t *positions, int k, crease_neighbourhood *out)
{
    const uint32_t self = positions[0];
    double largest = 0;
    for (int i = 0; i < k; i++) {
        double *const row = out->moments[i];
        row[X] = tree->x[positions[i]] - tree->x[self];
        row[Y] = tree->y[positions[i]] - tree->y[self];
        row[Z] = tree->z[positions[i]] - tree->z[self];
        largest = fmax(largest, fmax(fabs(row[X]), fmax(fabs(row[Y]), fabs(row[Z]))));
    }
    const double scale = largest > 0 ? ldexp(1, -ilogb(largest)) : 1;
    for (int i = 0; i < k; i++) {
        double *const row = out->moments[i];
        const double x = row[X] * scale, y = row[Y] * scale, z = row[Z] * scale;
        const double moments[CREASE_MOMENTS] = {x, y, z, x * x, x * y, x * z, y * y, y * z, z * z};
        for (int m = 0; m < CREASE_MOMENTS; m++)
            row[m] = moments[m];
    }
    out->k = k;
}

CREASE_INLINE void centre(
    const double sums[CREASE_MOMENTS], double k, crease_matrices *matrices, size_t lane)
{
    matrices->xx[lane] = sums[XX] - sums[X] * sums[X] / k;
    matrices->xy[lane] = sums[XY] - sums[X] * sums[Y] / k;
    matrices->xz[lane] = sums[XZ] - sums[X] * sums[Z] / k;
    matrices->yy[lane] = sums[YY] - sums[Y] * sums[Y] / k;
    matrices->yz[lane] = sums[YZ] - sums[Y] * sums[Z] / k;
    matrices->zz[lane] = sums[ZZ] - sums[Z] * sums[Z] / k;
}

CREASE_INLINE void add(double sums[CREASE_MOMENTS], const double row[CREASE_MOMENTS])
{
    for (int m = 0; m < CREASE_MOMENTS; m++)
        sums[m] += row[m];
}

void crease_neighbourhood_covariance(
    const crease_neighbourhood *neighbourhood, crease_matrices *matrices, size_t lane)
{
    double sums[CREASE_MOMENTS] = {0};
    for (int i = 0; i < neighbourhood->k; i++)
        add(sums, neighbourhood->moments[i]);
    centre(sums, neighbourhood->k, matrices, lane);
}

CREASE_VECTORISED void crease_neighbourhood_resample(const crease_neighbourhood *neighbourhood,
    const uint32_t *words, size_t count, crease_matrices *matrices)
{
    const int k = neighbourhood->k;
    uint8_t members[CREASE_MOST_NEIGHBOURS];
    for (size_t lane = 0; lane < count; lane++) {
        double sums[CREASE_MOMENTS] = {0};
        crease_bootstrap_members(words, k, members);
        words += crease_bootstrap_words(k);
        for (int i = 0; i < k; i++)
            add(sums, neighbourhood->moments[members[i]]);
        centre(sums, k, matrices, lane);
    }
}
