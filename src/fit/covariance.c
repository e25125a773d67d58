/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "fit/covariance.h"

#include "base/memory.h"
#include "base/parallel.h"

#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { GRAIN = 4096, MOST = CREASE_MOST_PLACES };

/* Overwrites the Cholesky factor of a band matrix, as LAPACK stores it, with the same band of the
 * inverse Z: from the last column up, of Z L = L^-T, whose lower part is known. column: width. */
static void invert(double *band, size_t size, size_t width, double *column)
{
    for (size_t j = size; j-- > 0;) {
        double *const here = band + j * width;
        const size_t below = size - j < width ? size - 1 - j : width - 1;
        const double pivot = here[0];
        memcpy(column, here + 1, below * sizeof *column);
        if (below > 0)
            cblas_dsbmv(CblasColMajor, CblasLower, (int)below, (int)width - 1, -1.0 / pivot,
                here + width, (int)width, column, 1, 0.0, here + 1, 1);
        here[0] = (1.0 / pivot - cblas_ddot((int)below, column, 1, here + 1, 1)) / pivot;
    }
}

static crease_status invert_band(crease_context *context, crease_covariance *out)
{
    const crease_system *const system = &out->draft->system;
    double *const column = crease_allocate(context, system->width, sizeof *column);
    out->inverse =
        crease_duplicate(context, system->factor, system->size, system->width * sizeof(double));
    const bool room = column && out->inverse;
    if (room)
        invert(out->inverse, system->size, system->width, column);
    free(column);
    return room ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
}

/* Variance that goes with the inverse of the weighted equations: for psi(r) = w(r) r of mean slope
 * m, the sum of psi^2 over n - p, times K^2 mean(w) / m^2; the slope is w (2 w - 1) for Cauchy's
 * weights and w^3 for the smoothed absolute value. Based on: Huber. Robust statistics. 1981
 * (equations 7.6.5 and 7.6.11). */
static double variance_of(const crease_draft *draft)
{
    const crease_samples *const s = draft->samples;
    double square = 0.0, weight = 0.0, slope = 0.0, spread = 0.0, n = 0.0;
    for (size_t i = 0; i < s->count; i++) {
        if (!(s->prior[i] > 0.0))
            continue;
        const double w = s->weight[i] / s->prior[i], psi = w * s->residual[i];
        const double here = draft->redescending ? w * (2.0 * w - 1.0) : w * w * w;
        square += psi * psi;
        weight += w;
        slope += here;
        spread += here * here;
        n += 1.0;
    }
    const double mean = slope / n;
    if (!(mean > 0.0)) /* mostly outliers: nothing better is known */
        return square / fmax(1.0, n - draft->freedom);
    const double k = 1.0 + draft->freedom / n * fmax(spread / n - mean * mean, 0.0) / (mean * mean);
    return k * k * square / fmax(1.0, n - draft->freedom) * (weight / n) / (mean * mean);
}

static void invert_places(crease_covariance *out)
{
    const lapack_int n = (lapack_int)crease_places_pack(&out->places, out->inner, out->place);
    if (n == 0 || LAPACKE_dpotrf_work(LAPACK_COL_MAJOR, 'L', n, out->inner, n) != 0 ||
        LAPACKE_dpotri_work(LAPACK_COL_MAJOR, 'L', n, out->inner, n) != 0)
        return;
    out->free = (size_t)n;
    for (size_t a = 0; a < out->free; a++)
        for (size_t b = 0; b < a; b++)
            out->inner[a * out->free + b] = out->inner[b * out->free + a];
}

crease_status crease_covariance_create(
    crease_context *context, crease_draft *draft, bool turn, crease_covariance *out)
{
    *out = (crease_covariance){.draft = draft};
    crease_status status = crease_places_sum(context, draft, turn, &out->places);
    if (status == CREASE_OK)
        status = invert_band(context, out);
    if (status == CREASE_OK) {
        out->variance = variance_of(draft);
        invert_places(out);
    }
    return status;
}

void crease_covariance_free(crease_covariance *covariance)
{
    crease_places_free(&covariance->places);
    free(covariance->inverse);
    covariance->inverse = NULL;
}

void crease_covariance_lines(
    const crease_covariance *covariance, double errors[2 * CREASE_MOST_LINES])
{
    memset(errors, 0, 2 * CREASE_MOST_LINES * sizeof *errors);
    for (size_t a = 0; a < covariance->free; a++)
        if (covariance->place[a] < covariance->places.lines)
            errors[covariance->place[a]] =
                sqrt(covariance->variance * covariance->inner[a * covariance->free + a]);
}

/* ------------------------------------------------------------------------------------ points --
 */

/* The functions at a place, and their numbers in the band and among the control points. */
typedef struct local {
    size_t count;
    double value[CREASE_HEIGHT_ORDER_MAX * CREASE_HEIGHT_ORDER_MAX];
    size_t banded[CREASE_HEIGHT_ORDER_MAX * CREASE_HEIGHT_ORDER_MAX];
    size_t number[CREASE_HEIGHT_ORDER_MAX * CREASE_HEIGHT_ORDER_MAX];
} local;

static void look(const crease_draft *draft, const double uv[2], double tilt, local *out)
{
    const crease_side sides[2] = {CREASE_SIDE_RIGHT, CREASE_SIDE_RIGHT};
    const crease_system *const system = &draft->system;
    const size_t order = (size_t)draft->height.order;
    crease_support s;
    crease_height_support(&draft->height, uv, sides, 0, &s);
    out->count = 0;
    for (size_t a = 0; a < order; a++)
        for (size_t b = 0; b < order; b++, out->count++) {
            const size_t i = s.first[0] + a, j = s.first[1] + b;
            out->value[out->count] = tilt * s.values[0][a] * s.values[1][b];
            out->banded[out->count] = system->stride[0] * i + system->stride[1] * j;
            out->number[out->count] = i * system->count[1] + j;
        }
}

/* b^T inverse b. */
static double of_control_points(const crease_covariance *c, const local *at)
{
    const size_t width = c->draft->system.width;
    double sum = 0.0;
    for (size_t a = 0; a < at->count; a++) {
        double row = 0.5 * at->value[a] * c->inverse[at->banded[a] * width];
        for (size_t b = 0; b < a; b++) {
            const size_t p = at->banded[a], q = at->banded[b];
            row += at->value[b] *
                (p < q ? c->inverse[p * width + q - p] : c->inverse[q * width + p - q]);
        }
        sum += 2.0 * at->value[a] * row;
    }
    return sum;
}

/* What the places add: (column - b^T inverse mixed) squared by their inverse. */
static double of_places(const crease_covariance *c, size_t i, const local *at)
{
    const size_t size = c->draft->system.size;
    double columns[MOST], rest[MOST], sum = 0.0;
    crease_places_columns(c->draft, i, c->places.count, columns);
    for (size_t a = 0; a < c->free; a++) {
        rest[a] = columns[c->place[a]];
        const double *const solved = c->places.solved + c->place[a] * size;
        for (size_t k = 0; k < at->count; k++)
            rest[a] -= at->value[k] * solved[at->number[k]];
    }
    for (size_t a = 0; a < c->free; a++)
        for (size_t b = 0; b < c->free; b++)
            sum += rest[a] * c->inner[a * c->free + b] * rest[b];
    return sum;
}

typedef struct work {
    const crease_covariance *covariance;
    double *errors;
} work;

static void measure_some(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const work *const w = user;
    const crease_covariance *const c = w->covariance;
    const crease_samples *const s = c->draft->samples;
    for (size_t i = begin; i < end; i++) {
        local at;
        look(c->draft, s->uv + 2 * i, s->tilt[i], &at);
        const double square = of_control_points(c, &at) + of_places(c, i, &at);
        w->errors[crease_samples_number(s, i)] = sqrt(c->variance * fmax(square, 0.0));
    }
}

crease_status crease_covariance_points(
    crease_context *context, const crease_covariance *covariance, double *errors)
{
    work w = {.covariance = covariance, .errors = errors};
    return crease_parallel_for(context, covariance->draft->samples->count, GRAIN, measure_some, &w);
}
