/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A fitted primitive that is to meet conditions: each takes it to the most probable place, by its
 * covariance, that meets it, and what is known of the rest is known on that condition. */
#ifndef CREASE_SNAP_BODY_H
#define CREASE_SNAP_BODY_H

#include "primitive/primitive.h"
#include "snap/cluster.h"

enum { CREASE_BODY_FUNCTIONS = 2 };

typedef struct crease_body {
    crease_model model;
    double covariance[CREASE_PRIMITIVE_PARAMETERS * CREASE_PRIMITIVE_PARAMETERS];
} crease_body;

/* Linear functions of a small change of the parameters. */
typedef struct crease_functions {
    int count;
    double rows[CREASE_BODY_FUNCTIONS][CREASE_PRIMITIVE_PARAMETERS];
} crease_functions;

/* The model must live as long; coefficients are not copied. */
crease_body crease_body_of(const crease_model *model);

/* How far the axis tilts towards two directions. */
crease_functions crease_body_tilts(const crease_body *body, double towards[2][3]);
/* How far the centre moves along so many directions, one or two. */
crease_functions crease_body_moves(const crease_body *body, int count, double along[][3]);
crease_functions crease_body_growth(void);

/* Covariance of the functions: xx xy yy. */
void crease_body_covariance(
    const crease_body *body, const crease_functions *functions, double out[3]);
/* Changes the body so that the functions take the given values. False when they are not free to. */
bool crease_body_condition(
    crease_body *body, const crease_functions *functions, const double values[2]);
/* Turns the axis into a unit vector near to it, or near to its opposite. */
bool crease_body_turn(crease_body *body, const double axis[3]);
/* Gives the model that the body was made of the body's surface. Its covariance remains that of the
 * fit, carried along. */
void crease_body_replace(const crease_body *body, crease_model *model);

#endif
