/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "detect/principal.h"

#include "base/vector.h"

#include <string.h>

/* A variation below is rounding of coordinates of about 1. */
static const double rounding = 1e-28;

void crease_principal_compute(const crease_neighbourhood *neighbourhood, crease_principal *out)
{
    const int k = neighbourhood->k;
    crease_matrices matrices;
    crease_directions found;
    memset(&matrices, 0, sizeof matrices);
    crease_neighbourhood_covariance(neighbourhood, &matrices, 0);
    crease_eigen_smallest(&matrices, 1, &found);
    *out = (crease_principal){.normal = {found.x[0], found.y[0], found.z[0]},
        .trace = (matrices.xx[0] + matrices.yy[0] + matrices.zz[0]) / k,
        .degenerate = !(found.spread[0] > CREASE_LINE_SPREAD)};
    for (int i = 0; i < k; i++)
        for (int axis = 0; axis < 3; axis++)
            out->mean[axis] += neighbourhood->moments[i][axis] / k;
    for (int i = 0; i < k; i++) {
        const double *const at = neighbourhood->moments[i];
        const double away[3] = {at[0] - out->mean[0], at[1] - out->mean[1], at[2] - out->mean[2]};
        const double height = crease_vector_dot(away, out->normal);
        out->least += height * height / k;
    }
}

double crease_principal_variation(const crease_principal *principal)
{
    const double variation = principal->least / principal->trace;
    return variation < rounding ? 0 : variation;
}
