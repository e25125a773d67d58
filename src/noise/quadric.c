/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "noise/quadric.h"

#include "base/symmetric.h"
#include "base/vector.h"

#include <math.h>
#include <string.h>

enum { TERMS = CREASE_QUADRIC_TERMS };

double crease_quadric_plane(
    double (*points)[3], int count, double centre[3], double values[3], double axes[9])
{
    double covariance[6] = {0};
    for (int c = 0; c < 3; c++) {
        centre[c] = 0.0;
        for (int j = 0; j < count; j++)
            centre[c] += points[j][c];
        centre[c] /= count;
        for (int j = 0; j < count; j++)
            points[j][c] -= centre[c];
    }
    for (int j = 0; j < count; j++)
        crease_symmetric_add(covariance, 1.0, points[j]);
    crease_symmetric_axes(covariance, values, axes);
    return fmax(values[0], 0.0);
}

double crease_quadric_fit(
    double (*points)[3], int count, const double axes[9], double scale, double height[TERMS])
{
    double matrix[TERMS * TERMS] = {0}, right[TERMS] = {0}, squares = 0.0;
    for (int j = 0; j < count; j++) {
        const double x = crease_vector_dot(points[j], axes + 6) / scale;
        const double y = crease_vector_dot(points[j], axes + 3) / scale;
        const double z = crease_vector_dot(points[j], axes);
        const double terms[TERMS] = {1, x, y, x * x, x * y, y * y};
        squares += z * z;
        for (int r = 0; r < TERMS; r++) {
            right[r] += terms[r] * z;
            for (int c = 0; c <= r; c++)
                matrix[TERMS * r + c] += terms[r] * terms[c];
        }
    }
    for (int r = 0; r < TERMS; r++)
        matrix[(TERMS + 1) * r] += 1e-9 * count;
    memcpy(height, right, sizeof right);
    if (!crease_symmetric_factor(matrix, TERMS, TERMS, TERMS))
        return -1.0;
    crease_symmetric_solve(matrix, TERMS, TERMS, TERMS, height);
    for (int r = 0; r < TERMS; r++)
        squares -= height[r] * right[r];
    return fmax(squares, 0.0);
}
