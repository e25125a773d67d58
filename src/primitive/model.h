/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The surface of a region: a primitive of solid modelling, or a height field for anything else. It
 * can be asked everywhere, also far from the points it was fitted to: primitives are infinite,
 * height fields go on linearly. */
#ifndef CREASE_PRIMITIVE_MODEL_H
#define CREASE_PRIMITIVE_MODEL_H

#include "base/context.h"

#include <stdint.h>

/* A height z = f(x, y) over the frame of its model, by the coefficients of a polynomial or of a
 * uniform bicubic B-spline with spans x spans cells. Beyond low..high it goes on linearly. Or, a
 * spline, a distance: of a round one f(angle, z) from the frame's z axis, periodic in the angle
 * about it; of a ball f(x, y) from its origin, the direction by its stereographic projection
 * (base.h). */
typedef struct crease_patch {
    bool spline, round, ball;
    int degree;             /* of the polynomial, 2..4 */
    int spans;              /* of the spline, 3..24 in both directions */
    double low[2], high[2]; /* the rectangle of the data */
    double unit[2];         /* polynomial: half the longer side (both); spline: a cell's sides */
    size_t coefficient_count;
    double *coefficients;
} crease_patch;

typedef struct crease_model {
    crease_region_type type;
    double centre[3]; /* plane: mean of the points; sphere, torus: centre; cylinder, cone: the point
                         of the axis beside the mean; height field: origin of the frame */
    double axes[9]; /* orthonormal, row by row: x, y and z, which is the normal of a plane, the axis
                       of cylinder, cone and torus, the direction of heights */
    double radius; /* sphere, cylinder; cone: where its axis passes the centre; torus: of the circle
                      along which the tube runs */
    double shape;  /* cone: growth of the radius along z; torus: radius of the tube; else 0 */
    crease_patch patch;    /* CREASE_REGION_FREEFORM only */
    double pivot[3];       /* place and covariance of the parameters in the sense of */
    double covariance[36]; /* primitive.h, lower triangle row by row; zero before it is estimated */
    double leverage;       /* height field: mean variance of the surface at its points */
    double parameter_count; /* what the model costs in the comparison of models; rarer kinds more */
    double cost;            /* of the fit: sum of squared residuals / sigma^2, cut at 9, plus
                               parameter_count log(points) */
    double chi;             /* mean of the squared residuals / sigma^2, cut at 9 */
    int tangent_count;      /* of regions that the surface is tangent to by construction */
    int32_t tangent[2];     /* and their numbers */
} crease_model;

/* Signed distance of a place from the model (patch fields: to first order) and its gradient, which
 * has length 1. Positive on the side that the normals of the fit pointed to for planes and height
 * fields, outside for the others. */
double crease_model_distance(const crease_model *model, const double place[3], double gradient[3]);

/* Variance of the position of the surface at a place beside it, along its normal, from the noise of
 * the points that it was fitted to. */
double crease_model_variance(const crease_model *model, const double place[3]);

/* A copy that owns its coefficients. */
crease_status crease_model_copy(
    crease_context *context, const crease_model *model, crease_model *out);
/* Frees what the model owns, not the model. */
void crease_model_clear(crease_model *model);

#endif
