/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Least squares for the control points of a form. */
#ifndef CREASE_FIT_FORM_FIT_H
#define CREASE_FIT_FORM_FIT_H

#include "fit/form.h"

/* What a fit pulls the form to. */
typedef enum crease_pull {
    CREASE_PULL_POINTS, /* the points themselves, at the parameters of their feet */
    CREASE_PULL_PLANES  /* the planes through the points along the normals at their feet: the form
                           may glide along itself, so lines between strips go where the surfaces of
                           both sides meet */
} crease_pull;

/* Fits the net to the points with their weights and parameters; for planes, foot and normal must be
 * those of the form. `smoothing`: weight of the squared second divided differences of the control
 * points between lines, in shares of the data's; small, so that parts without points are
 * determined. *freedom: control points that points have a say in. False in *solved: the net stays.
 * Based on: Wang, Pottmann, Liu. Fitting B-spline curves to point clouds by curvature-based squared
 * distance minimization. 2006 (section 2, tangent distance); Eilers, Marx. Flexible smoothing with
 * B-splines and penalties. 1996. Errors: NO_MEMORY, CANCELLED. */
crease_status crease_form_fit(crease_context *context, crease_form *form, const crease_feet *feet,
    crease_pull pull, double smoothing, size_t *freedom, bool *solved);

#endif
