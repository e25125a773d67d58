/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Newton's method for half the squared distance, within a box: a parameter at a border stays there
 * while the distance falls towards the outside, steps end at the border, and a step that does not
 * lessen the distance is halved. Where the matrix of second derivatives is not positive, that of
 * Gauss and Newton takes its place.
 *
 * Based on: Nocedal, Wright. Numerical optimization. 2006, sections 3.1, 10.3 and 16.7. */
#include "spline/newton.h"

#include "base/vector.h"

#include <math.h>

enum { MOST_STEPS = 50, MOST_HALVINGS = 40 };

static const double SMALL_STEP = 1e-14;
/* Relative rounding error of a squared distance: less is no change. */
static const double ROUNDING = 1e-13;

typedef struct quadratic {
    double gradient[2];
    double hessian[3]; /* uu, uv, vv */
    double gauss[3];   /* the same without second derivatives: never negative */
} quadratic;

static quadratic expand(const crease_patch_point *p)
{
    quadratic q = {.gradient = {crease_vector_dot(p->s, p->u), crease_vector_dot(p->s, p->v)},
        .gauss = {crease_vector_dot(p->u, p->u), crease_vector_dot(p->u, p->v),
            crease_vector_dot(p->v, p->v)}};
    q.hessian[0] = q.gauss[0] + crease_vector_dot(p->s, p->uu);
    q.hessian[1] = q.gauss[1] + crease_vector_dot(p->s, p->uv);
    q.hessian[2] = q.gauss[2] + crease_vector_dot(p->s, p->vv);
    return q;
}

/* Step of one parameter alone. */
static double step_alone(const quadratic *q, int d)
{
    const double newton = q->hessian[2 * d];
    const double matrix = newton > 1e-9 * q->gauss[2 * d] ? newton : q->gauss[2 * d];
    return matrix > 0.0 ? -q->gradient[d] / matrix : 0.0;
}

static bool solve(const double matrix[3], const double gradient[2], double step[2])
{
    const double determinant = matrix[0] * matrix[2] - matrix[1] * matrix[1];
    if (!(matrix[0] > 0.0 && determinant > 1e-12 * matrix[0] * matrix[2]))
        return false;
    step[0] = (matrix[1] * gradient[1] - matrix[2] * gradient[0]) / determinant;
    step[1] = (matrix[1] * gradient[0] - matrix[0] * gradient[1]) / determinant;
    return true;
}

/* True when a parameter stands at a border and would go beyond. */
static bool blocked(
    const double lowest[2], const double highest[2], const double at[2], int d, double step)
{
    return (at[d] <= lowest[d] && step <= 0.0) || (at[d] >= highest[d] && step >= 0.0);
}

static void choose_step(const quadratic *q, const double lowest[2], const double highest[2],
    const double at[2], double step[2])
{
    bool held[2];
    for (int d = 0; d < 2; d++)
        held[d] = blocked(lowest, highest, at, d, -q->gradient[d]);
    if (!held[0] && !held[1]) {
        if (!solve(q->hessian, q->gradient, step) && !solve(q->gauss, q->gradient, step)) {
            step[0] = step_alone(q, 0);
            step[1] = step_alone(q, 1);
        }
        for (int d = 0; d < 2; d++)
            held[d] = blocked(lowest, highest, at, d, step[d]);
        if (!held[0] && !held[1])
            return;
    }
    for (int d = 0; d < 2; d++) {
        const double alone = step_alone(q, d);
        step[d] = held[d] || blocked(lowest, highest, at, d, alone) ? 0.0 : alone;
    }
}

/* The share of the step that leads to the border of the box, at most 1. */
static double share_inside(
    const double lowest[2], const double highest[2], const double at[2], const double step[2])
{
    double share = 1.0;
    for (int d = 0; d < 2; d++) {
        const double room = (step[d] > 0.0 ? highest[d] : lowest[d]) - at[d];
        if (step[d] != 0.0 && fabs(share * step[d]) > fabs(room))
            share = room / step[d];
    }
    return share;
}

/* Goes a share of the step; false when the distance does not fall however small the share. */
static bool advance(const crease_patch *patch, const double lowest[2], const double highest[2],
    const double step[2], double at[2], crease_patch_point *point)
{
    const double before = crease_vector_dot(point->s, point->s);
    double share = share_inside(lowest, highest, at, step);
    for (int i = 0; i < MOST_HALVINGS; i++, share *= 0.5) {
        double next[2];
        for (int d = 0; d < 2; d++) {
            next[d] = at[d] + share * step[d];
            const bool beyond = fabs(next[d] - lowest[d]) < 1e-15 || next[d] < lowest[d];
            next[d] = beyond ? lowest[d] : fmin(next[d], highest[d]);
        }
        crease_patch_point there;
        crease_patch_evaluate(patch, next, &there);
        if (crease_vector_dot(there.s, there.s) <= before * (1.0 + ROUNDING)) {
            at[0] = next[0];
            at[1] = next[1];
            *point = there;
            return true;
        }
    }
    return false;
}

double crease_newton_descend(
    const crease_patch *patch, const double lowest[2], const double highest[2], double at[2])
{
    crease_patch_point point;
    crease_patch_evaluate(patch, at, &point);
    for (int i = 0; i < MOST_STEPS; i++) {
        const quadratic q = expand(&point);
        double step[2];
        choose_step(&q, lowest, highest, at, step);
        if (!(fabs(step[0]) > SMALL_STEP || fabs(step[1]) > SMALL_STEP))
            break;
        if (!advance(patch, lowest, highest, step, at, &point))
            break;
    }
    return crease_vector_dot(point.s, point.s);
}
