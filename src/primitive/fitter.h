/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Fits of models to samples. Everything works in a fitter, scratch memory that is made once for
 * each thread, so that fits allocate nothing.
 *
 * All fits are robust: residuals enter as t / (1 + t), t = (r / 3 scale)^2, the scale being the
 * noise or, when larger, the median of the residuals. So a fifth of foreign points does not bend a
 * surface. */
#ifndef CREASE_PRIMITIVE_FITTER_H
#define CREASE_PRIMITIVE_FITTER_H

#include "primitive/model.h"
#include "primitive/sample.h"

enum { CREASE_FITTER_CANDIDATES = 3 };

typedef struct crease_fitter {
    double sigma;                                   /* noise of the points along the normal */
    double *residuals[2], *gradients[2];            /* of the present model and of one on trial */
    double *weights, *local, *deviations;           /* of the sample's points */
    double *matrix, *right, *support;               /* normal equations of height fields */
    double *coefficients[CREASE_FITTER_CANDIDATES]; /* room for those of models on trial */
    double *memory;
    crease_sample sample, screen; /* room for one sample, and for a few of its points */
    crease_model best, trial;     /* the best model so far and the one on trial: see model choice */
} crease_fitter;

/* One fitter for each thread of the context. */
crease_status crease_fitters_create(crease_context *context, crease_fitter **out);
void crease_fitters_free(crease_context *context, crease_fitter *fitters);

/* Each makes *model from the sample, relative to its origin, and returns whether it could. Any
 * coefficients go to where model->patch.coefficients points. A primitive begins with the model as
 * it is, a rough one. */
bool crease_fit_plane(crease_fitter *fitter, const crease_sample *sample, crease_model *model);
bool crease_fit_primitive(crease_fitter *fitter, const crease_sample *sample, crease_model *model);
bool crease_fit_polynomial(
    crease_fitter *fitter, const crease_sample *sample, int degree, crease_model *model);
bool crease_fit_spline(
    crease_fitter *fitter, const crease_sample *sample, int spans, crease_model *model);
/* A round height field, about an axis that the points surround; at least 4 spans. */
bool crease_fit_tube(
    crease_fitter *fitter, const crease_sample *sample, int spans, crease_model *model);
/* The same about a centre. */
bool crease_fit_ball(
    crease_fitter *fitter, const crease_sample *sample, int spans, crease_model *model);

/* Rough models, from normals and linear least squares. */
bool crease_guess_sphere(const crease_sample *sample, crease_model *model);
bool crease_guess_cylinder(const crease_sample *sample, crease_model *model);
/* With the axis along the least curved direction of a polynomial of degree 2. */
bool crease_guess_cylinder_along(
    const crease_sample *sample, const crease_model *polynomial, crease_model *model);
bool crease_guess_cone(const crease_sample *sample, crease_model *model);
bool crease_guess_torus(const crease_sample *sample, crease_model *model);

/* A robust standard deviation: 1.4826 times the median of the absolute values. */
double crease_fit_scale(const crease_fitter *fitter, const double *residuals, size_t count);
/* Derivative of the robust cost of a residual to the residual, over it. */
double crease_fit_weight(double residual, double scale);
/* Fills in the covariance (leverage of height fields) of a model in the cloud's coordinates. */
void crease_fit_covariance(
    const crease_fitter *fitter, const crease_sample *sample, crease_model *model);

/* ------------------------------------------------------------------------------ model choice -- */

/* What an additional parameter must gain. Costs are sums of squared residuals / sigma^2, each cut
 * at CREASE_COST_CUT, plus ... */
typedef enum crease_fit_rule {
    CREASE_RULE_GROWING, /* as BAYES, and a share of the points for richer kinds: a few points must
                            not be followed around a corner */
    CREASE_RULE_BAYES,   /* parameters x log(points): which kind of surface it is */
    CREASE_RULE_AKAIKE   /* parameters x 2: where the surface is, whatever its kind */
} crease_fit_rule;

typedef enum crease_fit_level {
    CREASE_LEVEL_PLANE,
    CREASE_LEVEL_QUADRATIC,
    CREASE_LEVEL_ROUND,  /* and sphere, cylinder */
    CREASE_LEVEL_SOLIDS, /* and cone, torus, polynomials of higher degree */
    CREASE_LEVEL_ALL     /* and splines */
} crease_fit_level;

static const double CREASE_COST_CUT = 9.0;

/* What so many points can decide between. */
crease_fit_level crease_fit_level_for(size_t count);
/* Makes fitter->best the cheapest model of the sample that the level allows, in the cloud's
 * coordinates; warm, a model to begin with, may be NULL. Distances from an axis or a centre are
 * tried where no height over a plane will do, by CREASE_RULE_AKAIKE or when warm is one. Dearer
 * models than the limit need not be found. False when there is none. */
bool crease_fit_choose(crease_fitter *fitter, const crease_sample *sample, crease_fit_rule rule,
    crease_fit_level level, const crease_model *warm, double limit);
/* The same with one kind only; free form means a polynomial of degree 2. */
bool crease_fit_kind(crease_fitter *fitter, const crease_sample *sample, crease_region_type type,
    const crease_model *warm);
/* Cost of a model (in the cloud's coordinates) for a sample by CREASE_RULE_BAYES. */
double crease_fit_cost(const crease_model *model, const crease_sample *sample, double sigma);

#endif
