/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Planes and quadrics z = h0 + h1 x + h2 y + h3 x^2 + h4 x y + h5 y^2 through a few points, by
 * least squares. */
#ifndef CREASE_NOISE_QUADRIC_H
#define CREASE_NOISE_QUADRIC_H

enum { CREASE_QUADRIC_TERMS = 6 };

/* Centres the points, and gives the main axes of what is left, ascending; returns the sum of the
 * squared distances from the plane of best fit. */
double crease_quadric_plane(
    double (*points)[3], int count, double centre[3], double values[3], double axes[9]);

/* The quadric over the frame of the plane of centred points, abscissae scaled by `scale`. Returns
 * the sum of squared residuals, or a negative number when the points do not determine it. */
double crease_quadric_fit(double (*points)[3], int count, const double axes[9], double scale,
    double height[CREASE_QUADRIC_TERMS]);

#endif
