/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What the noise of the points leaves uncertain of a fitted surface, parameter by parameter. */
#ifndef CREASE_PRIMITIVE_UNCERTAINTY_H
#define CREASE_PRIMITIVE_UNCERTAINTY_H

#include "primitive/model.h"

/* Standard errors; 0 for what a surface does not have. Of places and directions: the root of the
 * mean squared distance from, and angle to, the true one. */
typedef struct crease_uncertainty {
    double place;     /* plane: along the normal; sphere, torus: of the centre; cylinder, cone: of
                         the axis, across it, at the model's centre; height field: its mean along
                         the normal */
    double direction; /* radians */
    double radius;
    double shape;
} crease_uncertainty;

/* From the covariance of the model. planes: the two that a fillet is tangent to, or NULL: with them
 * given, only its radius is free. */
crease_uncertainty crease_model_uncertainty(
    const crease_model *model, const crease_model *const planes[2]);
/* The covariance of the model's parameters as a full, symmetric matrix. */
void crease_model_full_covariance(const crease_model *model, double *out);

#endif
