/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Plane, sphere, cylinder, cone, torus: distances and how they change with the parameters. */
#ifndef CREASE_PRIMITIVE_PRIMITIVE_H
#define CREASE_PRIMITIVE_PRIMITIVE_H

#include "primitive/model.h"

/* Parameters of a small change of any primitive: a move, a turn about a pivot, growth of the
 * radius, change of the shape. Those that leave a primitive as it is, or that it does not have,
 * have zero derivatives. */
enum { CREASE_PRIMITIVE_PARAMETERS = 8 };

double crease_primitive_distance(
    const crease_model *model, const double place[3], double gradient[3]);
/* The same of many places. */
void crease_primitive_distances(const crease_model *model, const double *places, size_t count,
    double *distances, double *gradients);
/* Derivatives of the distance of a place, given the distance and its gradient. */
void crease_primitive_derivatives(const crease_model *model, const double place[3], double distance,
    const double gradient[3], const double pivot[3], double out[CREASE_PRIMITIVE_PARAMETERS]);
/* The model after such a change. */
void crease_primitive_change(
    crease_model *model, const double pivot[3], const double step[CREASE_PRIMITIVE_PARAMETERS]);
/* Completes axes[6..8], a unit vector, to a right-handed orthonormal frame. */
void crease_primitive_frame(double axes[9]);

#endif
