/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "trim/smoothing.h"

#include "base/memory.h"
#include "base/symmetric.h"
#include "base/vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PASSES = 12, MOST_SPANS = 400, MOST_HARMONICS = 60, TERMS = 4, ROUND_TERMS = 121 };

static const double OUTSIDE = 0.95;        /* weight of points outside; 1 - that inside */
static const double EXACT = 0.02;          /* spacings: raggedness that there is always */
static const double POINTS_PER_TERM = 2.5; /* least */
static const double RIDGE = 1e-9;
static const double TURN = 6.283185307179586476925;

struct terms {
    size_t first, count;
    double value[ROUND_TERMS];
};

/* The functions that are not 0 at a place. */
static void terms_at(const crease_smooth *line, double at, struct terms *out)
{
    const double t = (at - line->begin) / line->length;
    out->first = 0; /* the values beyond `count` stay unset: there are many */
    out->count = line->size;
    if (line->closed) {
        out->value[0] = 1.0;
        for (size_t h = 1; h <= line->spans; h++) {
            out->value[2 * h - 1] = cos(TURN * (double)h * t);
            out->value[2 * h] = sin(TURN * (double)h * t);
        }
        return;
    }
    if (line->spans == 0) {
        out->value[0] = 1.0 - t;
        out->value[1] = t;
        return;
    }
    const double spans = (double)line->spans;
    const double span = fmin(fmax(floor(t * spans), 0.0), spans - 1.0);
    const double x = t * spans - span, y = 1.0 - x;
    out->first = (size_t)span;
    out->count = TERMS;
    out->value[0] = y * y * y / 6.0;
    out->value[1] = (3.0 * x * x * (x - 2.0) + 4.0) / 6.0;
    out->value[2] = (3.0 * y * y * (y - 2.0) + 4.0) / 6.0;
    out->value[3] = x * x * x / 6.0;
}

static void inside_at(const crease_smooth *line, double at, double place[3])
{
    struct terms terms;
    terms_at(line, at, &terms);
    memset(place, 0, 3 * sizeof *place);
    for (size_t i = 0; i < terms.count; i++)
        for (size_t c = 0; c < 3; c++)
            place[c] += terms.value[i] * line->coefficients[3 * (terms.first + i) + c];
}

void crease_smooth_at(const crease_smooth *line, double at, double place[3])
{
    const double end = line->begin + line->length, within = 1e-4 * line->length;
    const double inside = fmin(fmax(at, line->begin), end);
    double near[3];
    inside_at(line, line->closed ? at : inside, place);
    if (line->closed || inside == at)
        return;
    inside_at(line, at > end ? end - within : line->begin + within, near);
    const double share = fabs(at - inside) / within;
    for (int c = 0; c < 3; c++)
        place[c] += share * (place[c] - near[c]);
}

double crease_smooth_cost(double squares, double freedom, size_t count, double spacing)
{
    const double n = (double)count, floor_squares = n * EXACT * EXACT * spacing * spacing;
    return n * log((squares + floor_squares) / n) + freedom * log(n);
}

/* -------------------------------------------------------------------------------- fitting -- */

struct work {
    const crease_strip *strip;
    double *weights;        /* of the points */
    double *matrix, *right; /* size x size, 3 x size */
};

static bool solve(const struct work *work, crease_smooth *line)
{
    const size_t size = line->size;
    const size_t band = line->closed || line->spans == 0 ? size - 1 : TERMS - 1;
    memset(work->matrix, 0, size * size * sizeof *work->matrix);
    memset(work->right, 0, 3 * size * sizeof *work->right);
    for (size_t i = 0; i < work->strip->count; i++) {
        struct terms terms;
        terms_at(line, work->strip->at[i], &terms);
        for (size_t a = 0; a < terms.count; a++) {
            const double value = work->weights[i] * terms.value[a];
            double *const row = work->matrix + (terms.first + a) * size + terms.first;
            for (size_t b = 0; b <= a; b++)
                row[b] += value * terms.value[b];
            for (size_t c = 0; c < 3; c++)
                work->right[c * size + terms.first + a] += value * work->strip->points[3 * i + c];
        }
    }
    for (size_t a = 0; a < size; a++)
        work->matrix[a * size + a] += RIDGE;
    if (!crease_symmetric_factor(work->matrix, size, size, band))
        return false;
    for (size_t c = 0; c < 3; c++) {
        crease_symmetric_solve(work->matrix, size, size, band, work->right + c * size);
        for (size_t a = 0; a < size; a++)
            line->coefficients[3 * a + c] = work->right[c * size + a];
    }
    return true;
}

/* Weighs the points by their sides of the line; sums their squared distances. Whether a weight
 * has changed. */
static bool weigh(const struct work *work, crease_smooth *line)
{
    const crease_strip *const strip = work->strip;
    const double step = 1e-4 * line->length;
    bool changed = false;
    line->squares = 0.0;
    for (size_t i = 0; i < strip->count; i++) {
        double on[3], next[3], away[3], along[3];
        inside_at(line, strip->at[i], on);
        inside_at(line, strip->at[i] + (strip->at[i] > line->begin + step ? -step : step), next);
        for (size_t c = 0; c < 3; c++) {
            away[c] = strip->points[3 * i + c] - on[c];
            along[c] = next[c] - on[c];
        }
        crease_vector_normalise(along);
        const double ahead = crease_vector_dot(away, along);
        const double aside = crease_vector_dot(away, away) - ahead * ahead;
        const bool outside = crease_vector_dot(away, strip->outward + 3 * i) > 0.0;
        const double weight = outside ? OUTSIDE : 1.0 - OUTSIDE;
        changed = changed || weight != work->weights[i];
        work->weights[i] = weight;
        line->squares += 2.0 * weight * fmax(aside, 0.0);
    }
    return changed;
}

static bool fit_spans(const struct work *work, crease_smooth *line, size_t spans)
{
    line->spans = spans;
    line->size = line->closed ? 2 * spans + 1 : spans == 0 ? 2 : spans + 3;
    line->freedom = 2.0 * (double)line->size;
    for (size_t i = 0; i < work->strip->count; i++)
        work->weights[i] = 1.0;
    bool changed = true; /* the same weights give the same line */
    for (int pass = 0; pass < PASSES && changed; pass++) {
        if (!solve(work, line))
            return false;
        changed = weigh(work, line);
    }
    return true;
}

/* Tries more and more freedom; keeps the best in *out. */
static void try_all(const struct work *work, crease_smooth *trial, size_t most, crease_smooth *out)
{
    const crease_strip *const strip = work->strip;
    double best = INFINITY;
    for (size_t spans = trial->closed; spans <= most; spans += 1 + spans / 3) {
        if (!fit_spans(work, trial, spans))
            break;
        const double cost =
            crease_smooth_cost(trial->squares, trial->freedom, strip->count, strip->spacing);
        if (cost < best) {
            double *const kept = out->coefficients;
            best = cost;
            memcpy(kept, trial->coefficients, 3 * trial->size * sizeof *kept);
            *out = *trial;
            out->coefficients = kept;
        }
    }
}

crease_status crease_smooth_fit(
    crease_context *context, const crease_strip *strip, crease_smooth *out)
{
    const size_t limit = strip->closed ? MOST_HARMONICS : MOST_SPANS;
    const double terms = (double)strip->count / POINTS_PER_TERM;
    const double wanted = strip->closed ? 0.5 * (terms - 1.0) : terms - 3.0;
    const size_t most = wanted < 1.0 ? (size_t)strip->closed
        : wanted < (double)limit     ? (size_t)wanted
                                     : limit;
    const size_t size = 2 * most + 4;
    struct work work = {strip, crease_allocate(context, strip->count, sizeof(double)),
        crease_allocate(context, size * size, sizeof(double)),
        crease_allocate(context, 3 * size, sizeof(double))};
    crease_smooth trial = {.closed = strip->closed, .begin = strip->begin, .length = strip->length};
    *out = trial;
    trial.coefficients = crease_allocate(context, size, 3 * sizeof(double));
    out->coefficients = crease_allocate(context, size, 3 * sizeof(double));
    const bool complete =
        work.weights && work.matrix && work.right && trial.coefficients && out->coefficients;
    if (complete)
        try_all(&work, &trial, most, out);
    free(work.weights);
    free(work.matrix);
    free(work.right);
    free(trial.coefficients);
    return complete ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
}

void crease_smooth_clear(crease_smooth *line)
{
    free(line->coefficients);
    *line = (crease_smooth){.size = 0};
}
