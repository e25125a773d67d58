/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "detect/neighbourhood.h"

#include "base/simd.h"
#include "detect/bootstrap.h"

#include <math.h>
#include <string.h>

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
    const double sums[CREASE_MOMENTS], double share, crease_matrices *matrices, size_t lane)
{
    matrices->xx[lane] = sums[XX] - sums[X] * sums[X] * share;
    matrices->xy[lane] = sums[XY] - sums[X] * sums[Y] * share;
    matrices->xz[lane] = sums[XZ] - sums[X] * sums[Z] * share;
    matrices->yy[lane] = sums[YY] - sums[Y] * sums[Y] * share;
    matrices->yz[lane] = sums[YZ] - sums[Y] * sums[Z] * share;
    matrices->zz[lane] = sums[ZZ] - sums[Z] * sums[Z] * share;
}

/* Four moments at a time. */
typedef double quad __attribute__((vector_size(32), aligned(8), may_alias));

void crease_neighbourhood_covariance(
    const crease_neighbourhood *neighbourhood, crease_matrices *matrices, size_t lane)
{
    double sums[CREASE_MOMENTS] = {0};
    for (int i = 0; i < neighbourhood->k; i++)
        for (int m = 0; m < CREASE_MOMENTS; m++)
            sums[m] += neighbourhood->moments[i][m];
    centre(sums, 1.0 / neighbourhood->k, matrices, lane);
}

CREASE_VECTORISED void crease_neighbourhood_resample(const crease_neighbourhood *neighbourhood,
    const uint32_t *words, size_t count, crease_matrices *matrices)
{
    const int k = neighbourhood->k;
    const double share = 1.0 / k;
    const size_t stride = crease_bootstrap_words(k);
    uint8_t members[CREASE_MOST_NEIGHBOURS];
    for (size_t lane = 0; lane < count; lane++) {
        quad first = {0}, second = {0}, third = {0};
        crease_bootstrap_members(words, k, members);
        words += stride;
        for (int i = 0; i < k; i++) {
            const quad *const row = (const quad *)neighbourhood->moments[members[i]];
            first += row[0];
            second += row[1];
            third += row[2];
        }
        double sums[CREASE_MOMENTS];
        memcpy(sums, &first, sizeof first);
        memcpy(sums + 4, &second, sizeof second);
        memcpy(sums + 8, &third, sizeof third);
        centre(sums, share, matrices, lane);
    }
}
