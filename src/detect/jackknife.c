/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The normal is a function of the weights of the neighbours, each 1/k. A resample changes them at
 * random, with mean 1/k and covariance (I - 1 1'/k) / k^2. To first order the normal then changes
 * by the sum of the neighbours' influences U_i, and the trace of its covariance is
 *
 *     v = 1/k^2 sum |U_i|^2,     U_i = -(C - l0 I)^+ d_i (d_i . n),
 *
 * d_i being a neighbour less the mean, C the covariance, l0 its least eigenvalue and n the normal:
 * the derivative of an eigenvector along d_i d_i' - C. U_i lies in the tangent plane. A change of
 * length t there turns the normal by arctan t, and the mean of such unit normals falls short of 1
 * by a variance of t^2 / (1 + t^2): hence v / (1 + v), which is below 1 as the bootstrap's is.
 *
 * Based on: Jaeckel. The infinitesimal jackknife. 1972.
 * Based on: Efron. The jackknife, the bootstrap and other resampling plans. 1982 (chapter 6).
 * Based on: Critchley. Influence in principal components analysis. 1985 (of an eigenvector). */
#include "detect/jackknife.h"

#include "base/vector.h"

#include <math.h>

/* A variance below is rounding: see normal_bootstrap.c. */
static const double rounding = 1e-20;

/* Two unit vectors across n and each other. */
static void tangents(const double n[3], double u[3], double w[3])
{
    const int axis = fabs(n[0]) < fabs(n[1]) ? (fabs(n[0]) < fabs(n[2]) ? 0 : 2)
                                             : (fabs(n[1]) < fabs(n[2]) ? 1 : 2);
    const double least[3] = {axis == 0, axis == 1, axis == 2};
    crease_vector_cross(n, least, u);
    crease_vector_normalise(u);
    crease_vector_cross(n, u, w);
}

double crease_jackknife_variance(
    const crease_neighbourhood *neighbourhood, const crease_principal *principal)
{
    const int k = neighbourhood->k;
    double u[3], w[3], places[CREASE_MOST_NEIGHBOURS][3], uu = 0, uw = 0, ww = 0, sum = 0;
    tangents(principal->normal, u, w);
    for (int i = 0; i < k; i++) {
        double away[3];
        for (int axis = 0; axis < 3; axis++)
            away[axis] = neighbourhood->moments[i][axis] - principal->mean[axis];
        const double a = crease_vector_dot(away, u), b = crease_vector_dot(away, w);
        uu += a * a / k, uw += a * b / k, ww += b * b / k;
        places[i][0] = a, places[i][1] = b;
        places[i][2] = crease_vector_dot(away, principal->normal);
    }
    uu -= principal->least, ww -= principal->least;
    const double determinant = uu * ww - uw * uw;
    for (int i = 0; i < k; i++) {
        const double a = ww * places[i][0] - uw * places[i][1];
        const double b = uu * places[i][1] - uw * places[i][0];
        sum += (a * a + b * b) * places[i][2] * places[i][2];
    }
    /* v = sum / (determinant k)^2; no finite v when the middle eigenvalue is the least, too */
    const double scale = determinant > 0 ? determinant * determinant * k * k : 0;
    const double variance = sum > 0 ? sum / (sum + scale) : 0;
    return variance < rounding ? 0 : variance;
}
