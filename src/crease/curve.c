/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Least squares with chord-length parameters over equal spans. The normal matrix of an open curve
 * is banded; that of a closed one is banded around a ring, and becomes banded when the unknowns are
 * counted alternately from both ends of the opened ring. A trace of second differences makes it
 * definite where a span has no point.
 *
 * Based on: de Boor. A practical guide to splines. 1978, chapter XIV. */
#include "crease/curve.h"

#include "base/memory.h"
#include "base/vector.h"
#include "spline/basis.h"
#include "spline/knots.h"

#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ORDER = 4, BAND = 7, ROWS = BAND + 1 };

static const double STIFFNESS = 1e-9;

struct fit {
    const double *points;
    double *parameters;
    size_t count;
    double length; /* of the polyline, around a closed one */
    bool closed;
    size_t spans;
    size_t unknowns;
    double *knots;   /* spans + 7 */
    double *matrix;  /* unknowns x ROWS: lower band, column by column */
    double *right;   /* 3 columns of unknowns */
    double *control; /* spans + 3 points */
};

/* ------------------------------------------------------------------------------- unknowns -- */

/* The unknown that a control point is, or -1: the ends of an open curve are known. */
static ptrdiff_t unknown_of(const struct fit *fit, size_t control)
{
    if (!fit->closed)
        return control == 0 || control == fit->spans + 2 ? -1 : (ptrdiff_t)control - 1;
    const size_t ring = control % fit->spans, back = fit->spans - 1 - ring;
    return (ptrdiff_t)(ring <= back ? 2 * ring : 2 * back + 1);
}

static const double *known(const struct fit *fit, size_t control)
{
    return fit->points + (control == 0 ? 0 : 3 * (fit->count - 1));
}

/* Adds the equation: sum of weights times four control points from `first` on = target. */
static void add_equation(struct fit *fit, size_t first, const double weights[ORDER],
    const double *target, double importance)
{
    double rest[3] = {0.0, 0.0, 0.0};
    for (size_t i = 0; i < ORDER; i++)
        for (int c = 0; c < 3; c++) {
            rest[c] += !i && target ? target[c] : 0.0;
            if (unknown_of(fit, first + i) < 0)
                rest[c] -= weights[i] * known(fit, first + i)[c];
        }
    for (size_t i = 0; i < ORDER; i++) {
        const ptrdiff_t row = unknown_of(fit, first + i);
        if (row < 0)
            continue;
        for (size_t c = 0; c < 3; c++)
            fit->right[c * fit->unknowns + (size_t)row] += importance * weights[i] * rest[c];
        for (size_t j = 0; j < ORDER; j++) {
            const ptrdiff_t column = unknown_of(fit, first + j);
            if (column >= 0 && column <= row)
                fit->matrix[column * ROWS + row - column] += importance * weights[i] * weights[j];
        }
    }
}

static void assemble(struct fit *fit)
{
    static const double bend[ORDER] = {1.0, -2.0, 1.0, 0.0}, last[ORDER] = {0.0, 1.0, -2.0, 1.0};
    const double stiffness = STIFFNESS * (double)fit->count / (double)fit->spans;
    memset(fit->matrix, 0, fit->unknowns * ROWS * sizeof *fit->matrix);
    memset(fit->right, 0, 3 * fit->unknowns * sizeof *fit->right);
    for (size_t i = 0; i < fit->count; i++) {
        double values[ORDER];
        const double t = fit->parameters[i];
        const size_t span =
            crease_basis_span(fit->knots, ORDER, fit->spans + 3, t, CREASE_SIDE_RIGHT);
        crease_basis_values(fit->knots, ORDER, span, t, values);
        add_equation(fit, span + 1 - ORDER, values, fit->points + 3 * i, 1.0);
    }
    for (size_t i = 0; i < fit->spans; i++)
        add_equation(fit, i, bend, NULL, stiffness);
    if (!fit->closed)
        add_equation(fit, fit->spans - 1, last, NULL, stiffness);
}

/* Solves for the control points; false when the matrix is not definite. */
static bool solve(struct fit *fit)
{
    assemble(fit);
    const lapack_int n = (lapack_int)fit->unknowns;
    if (LAPACKE_dpbsv_work(LAPACK_COL_MAJOR, 'L', n, BAND, 3, fit->matrix, ROWS, fit->right, n))
        return false;
    for (size_t i = 0; i < fit->spans + 3; i++) {
        const ptrdiff_t unknown = unknown_of(fit, i);
        for (size_t c = 0; c < 3; c++)
            fit->control[3 * i + c] =
                unknown < 0 ? known(fit, i)[c] : fit->right[c * fit->unknowns + (size_t)unknown];
    }
    return true;
}

/* ---------------------------------------------------------------------------------- spans -- */

static double farthest(const struct fit *fit)
{
    double most = 0.0;
    for (size_t i = 0; i < fit->count; i++) {
        double values[ORDER], place[3] = {0.0, 0.0, 0.0};
        const double t = fit->parameters[i];
        const size_t span =
            crease_basis_span(fit->knots, ORDER, fit->spans + 3, t, CREASE_SIDE_RIGHT);
        crease_basis_values(fit->knots, ORDER, span, t, values);
        for (size_t k = 0; k < ORDER; k++)
            for (size_t c = 0; c < 3; c++)
                place[c] += values[k] * fit->control[3 * (span + 1 - ORDER + k) + c];
        most = fmax(most, crease_vector_distance(place, fit->points + 3 * i));
    }
    return most;
}

static crease_status fit_spans(crease_context *context, struct fit *fit, double tolerance)
{
    const size_t most = fit->closed ? (fit->count > 8 ? fit->count / 2 : 4)
                                    : (fit->count > 4 ? (fit->count - 1) / 2 : 1);
    for (fit->spans = fit->closed ? 4 : 1;; fit->spans = 2 * fit->spans) {
        fit->spans = fit->spans < most ? fit->spans : most;
        fit->unknowns = fit->closed ? fit->spans : fit->spans + 1;
        if (fit->closed)
            crease_knots_uniform(ORDER, fit->spans + 3, 0.0, fit->length, fit->knots);
        else
            crease_knots_clamped(ORDER, fit->spans + 3, 0.0, fit->length, fit->knots);
        if (!solve(fit))
            return crease_fail(context, CREASE_ERROR_NUMERIC,
                "creases: a curve through %zu points has no solution; leave out doubled points",
                fit->count);
        if (fit->spans == most || farthest(fit) <= tolerance)
            return CREASE_OK;
    }
}

/* Parameters by chord length; false when there is none. */
static bool parametrise(struct fit *fit)
{
    for (size_t i = 1; i < fit->count; i++)
        fit->parameters[i] = fit->parameters[i - 1] +
            crease_vector_distance(fit->points + 3 * i - 3, fit->points + 3 * i);
    fit->length = fit->parameters[fit->count - 1];
    if (fit->closed)
        fit->length += crease_vector_distance(fit->points, fit->points + 3 * (fit->count - 1));
    return fit->length > 0.0;
}

/* Room for the most spans there may be, and for the knots that clamp the ends. */
static crease_status allocate(crease_context *context, struct fit *fit)
{
    const size_t most = fit->count + ORDER;
    fit->parameters = crease_allocate(context, fit->count, sizeof *fit->parameters);
    fit->knots = crease_allocate(context, most + 4 * ORDER, sizeof *fit->knots);
    fit->control = crease_allocate(context, most + 4 * ORDER, 3 * sizeof *fit->control);
    fit->matrix = crease_allocate(context, most, ROWS * sizeof *fit->matrix);
    fit->right = crease_allocate(context, most, 3 * sizeof *fit->right);
    return fit->parameters && fit->knots && fit->control && fit->matrix && fit->right
        ? CREASE_OK
        : CREASE_ERROR_NO_MEMORY;
}

/* Gives a closed curve's knot vector full multiplicity at both ends, as readers of curves expect:
 * the same curve. */
static void clamp(struct fit *fit)
{
    enum { MORE = ORDER - 1 };
    size_t count = fit->spans + 3;
    const crease_rows rows = {1, count + 2 * MORE, 3, fit->control};
    for (int i = 0; i < MORE; i++)
        crease_knots_insert(ORDER, count++, fit->knots, 0.0, &rows);
    for (int i = 0; i < MORE; i++)
        crease_knots_insert(ORDER, count++, fit->knots, fit->length, &rows);
    count = fit->spans + 3;
    memmove(fit->knots, fit->knots + MORE, (count + ORDER) * sizeof *fit->knots);
    memmove(fit->control, fit->control + (size_t)3 * MORE, count * 3 * sizeof *fit->control);
    memcpy(fit->control + 3 * (count - 1), fit->control, 3 * sizeof *fit->control);
}

crease_status crease_curve_fit(crease_context *context, const double *points, size_t count,
    bool closed, double tolerance, crease_curve **out)
{
    struct fit fit = {.points = points, .count = count, .closed = closed};
    *out = NULL;
    crease_status status = allocate(context, &fit);
    if (status == CREASE_OK && !parametrise(&fit))
        status = crease_fail(context, CREASE_ERROR_NUMERIC,
            "creases: the %zu points of a curve are all the same; leave out doubled points", count);
    if (status == CREASE_OK)
        status = fit_spans(context, &fit, tolerance);
    if (status == CREASE_OK) {
        if (closed)
            clamp(&fit);
        status = crease_curve_create(context, ORDER, fit.spans + 3, fit.knots, fit.control, out);
    }
    free(fit.parameters);
    free(fit.knots);
    free(fit.control);
    free(fit.matrix);
    free(fit.right);
    return status;
}
