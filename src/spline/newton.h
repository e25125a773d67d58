/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The closest point of a Bezier patch within a box of its parameters, from a first guess. */
#ifndef CREASE_SPLINE_NEWTON_H
#define CREASE_SPLINE_NEWTON_H

#include "spline/bernstein.h"

/* Moves `at`, which lies in the box lowest..highest, to a local minimum of the distance in it;
 * returns the squared distance there, never more than at the first guess but for rounding. */
double crease_newton_descend(
    const crease_patch *patch, const double lowest[2], const double highest[2], double at[2]);

#endif
