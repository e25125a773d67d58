/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "net/stencil.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "base/simd.h"
#include "spline/basis.h"

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* Below this number of control points a thread is not worth its while. */
enum { SMALL = 16384 };

crease_status crease_stencil_create(
    crease_context *context, int order, const size_t count[2], crease_stencil *out)
{
    const size_t degree = (size_t)order - 1;
    *out = (crease_stencil){.order = (size_t)order,
        .count = {count[0], count[1]},
        .width = 2 * degree * (degree + 1) + 1};
    out->values = crease_allocate(context, count[0] * out->width, count[1] * sizeof(double));
    return out->values ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
}

void crease_stencil_free(crease_stencil *stencil)
{
    free(stencil->values);
    *stencil = (crease_stencil){.order = 0};
}

static size_t numbers_of(const crease_stencil *s)
{
    return s->count[0] * s->width * s->count[1];
}

void crease_stencil_clear(crease_stencil *stencil)
{
    memset(stencil->values, 0, numbers_of(stencil) * sizeof *stencil->values);
}

void crease_stencil_copy(const crease_stencil *from, crease_stencil *to)
{
    memcpy(to->values, from->values, numbers_of(from) * sizeof *from->values);
}

void crease_stencil_add_scaled(const crease_stencil *from, double factor, crease_stencil *to)
{
    const size_t count = numbers_of(from);
    for (size_t i = 0; i < count; i++)
        to->values[i] += factor * from->values[i];
}

size_t crease_stencil_pairs(size_t order)
{
    return order * (order + 1) / 2;
}

void crease_stencil_pack(const double *values, size_t order, double *pairs)
{
    for (size_t a = 0; a < order; a++)
        for (size_t b = a; b < order; b++)
            *pairs++ = values[a] * values[b];
}

static double *row_of(const crease_stencil *s, size_t i, size_t k)
{
    return s->values + (i * s->width + k) * s->count[1];
}

void crease_stencil_add(crease_stencil *stencil, const size_t first[2], const double *product)
{
    const size_t order = stencil->order, span = 2 * order - 1;
    for (size_t a = 0; a < order; a++)
        for (size_t b = a; b < order; b++)
            for (size_t c = 0; c < order; c++)
                for (size_t d = c; d < order; d++) {
                    const double value = *product++;
                    const size_t k = span * (b - a), across = d - c;
                    row_of(stencil, first[0] + a, k + across)[first[1] + c] += value;
                    if (b > a && across > 0)
                        row_of(stencil, first[0] + a, k - across)[first[1] + d] += value;
                }
}

double crease_stencil_diagonal(const crease_stencil *stencil, size_t i, size_t j)
{
    return row_of(stencil, i, 0)[j];
}

double crease_stencil_trace(const crease_stencil *stencil)
{
    double sum = 0.0;
    for (size_t i = 0; i < stencil->count[0]; i++) {
        const double *const row = row_of(stencil, i, 0);
        for (size_t j = 0; j < stencil->count[1]; j++)
            sum += row[j];
    }
    return sum;
}

/* ----------------------------------------------------------------------------------- products --
 */

typedef struct product {
    const crease_stencil *stencil;
    const double *x;
    double *y;
} product;

CREASE_VECTORISED static void add_products(
    const double *restrict a, const double *restrict x, size_t count, double *restrict y)
{
    for (size_t j = 0; j < count; j++)
        y[j] += a[j] * x[j];
}

/* Adds `terms` products at each place: number t of a[t stride + j] with x[t step + j]. All at once,
 * so that y is read and written once. */
CREASE_INLINE void add_all(const double *restrict a, size_t stride, const double *restrict x,
    ptrdiff_t step, size_t terms, size_t count, double *restrict y)
{
    for (size_t j = 0; j < count; j++) {
        double sum = y[j];
        for (size_t t = 0; t < terms; t++)
            sum += a[t * stride + j] * x[(ptrdiff_t)t * step + (ptrdiff_t)j];
        y[j] = sum;
    }
}

enum { BICUBIC_TERMS = 7, BICUBIC_HALF = 3 };

CREASE_VECTORISED static void add_seven(const double *restrict a, size_t stride,
    const double *restrict x, ptrdiff_t step, size_t count, double *restrict y)
{
    if (step > 0)
        add_all(a, stride, x, 1, BICUBIC_TERMS, count, y);
    else
        add_all(a, stride, x, -1, BICUBIC_TERMS, count, y);
}

CREASE_VECTORISED static void add_three(const double *restrict a, size_t stride,
    const double *restrict x, ptrdiff_t step, size_t count, double *restrict y)
{
    if (step > 0)
        add_all(a, stride, x, 1, BICUBIC_HALF, count, y);
    else
        add_all(a, stride, x, -1, BICUBIC_HALF, count, y);
}

/* The couplings of one row of control points with another: number t of `terms` couples place j of
 * this one with place j + step (t - from) of the other, and stands at a[t stride + j]. */
typedef struct couplings {
    const double *a, *x;
    size_t stride, terms;
    ptrdiff_t step, from;
} couplings;

/* Places begin .. end - 1 of one coupling, as far as the other row reaches. */
static void add_one(const couplings *c, size_t t, size_t begin, size_t end, size_t n, double *y)
{
    const ptrdiff_t shift = c->step * ((ptrdiff_t)t - c->from);
    const size_t low = shift < 0 ? (size_t)-shift : 0, high = shift > 0 ? n - (size_t)shift : n;
    const size_t first = begin > low ? begin : low, last = end < high ? end : high;
    const double *const a = c->a + t * c->stride;
    for (size_t j = first; j < last; j++)
        y[j] += a[j] * c->x[(ptrdiff_t)j + shift];
}

static void add_couplings_of(const couplings *c, size_t degree, size_t n, double *y)
{
    const bool seven = c->terms == BICUBIC_TERMS, three = c->terms == BICUBIC_HALF;
    const bool once = (seven || three) && degree == BICUBIC_HALF && n > 2 * degree;
    const size_t low = once ? degree : n, high = once ? n - degree : n;
    for (size_t t = 0; t < c->terms; t++) {
        add_one(c, t, 0, low, n, y);
        add_one(c, t, high, n, n, y);
    }
    if (once)
        (seven ? add_seven : add_three)(c->a + low, c->stride,
            c->x + (ptrdiff_t)low - c->step * c->from, c->step, high - low, y + low);
}

/* What couplings to the control points after those of the row give it, and to those before. */
static void add_rows(const product *p, size_t i, size_t di, double *y)
{
    const crease_stencil *const s = p->stencil;
    const size_t degree = s->order - 1, n = s->count[1], span = 2 * degree + 1;
    if (di == 0) {
        const double *const x = p->x + i * n;
        add_products(row_of(s, i, 0), x, n, y);
        const couplings after = {row_of(s, i, 1), x, n, degree, 1, -1};
        /* their mirror images stand where the other control point is */
        const couplings before = {row_of(s, i, 1) - 1, x, n - 1, degree, -1, -1};
        add_couplings_of(&after, degree, n, y);
        add_couplings_of(&before, degree, n, y);
        return;
    }
    const size_t k = span * di - degree;
    const ptrdiff_t from = (ptrdiff_t)degree;
    if (i + di < s->count[0]) {
        const couplings after = {row_of(s, i, k), p->x + (i + di) * n, n, span, 1, from};
        add_couplings_of(&after, degree, n, y);
    }
    if (di <= i) {
        const couplings before = {
            row_of(s, i - di, k) + degree, p->x + (i - di) * n, n - 1, span, -1, from};
        add_couplings_of(&before, degree, n, y);
    }
}

static void multiply_rows(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const product *const p = user;
    for (size_t i = begin; i < end; i++) {
        double *const y = p->y + i * p->stencil->count[1];
        memset(y, 0, p->stencil->count[1] * sizeof *y);
        for (size_t di = 0; di < p->stencil->order; di++)
            add_rows(p, i, di, y);
    }
}

/* Rows of control points for a thread at a time. */
static size_t grain_of(const crease_stencil *stencil)
{
    return stencil->count[0] * stencil->count[1] < SMALL ? stencil->count[0] : 8;
}

crease_status crease_stencil_multiply(
    crease_context *context, const crease_stencil *stencil, const double *x, double *y)
{
    product p = {.stencil = stencil, .x = x, .y = y};
    return crease_parallel_for(context, stencil->count[0], grain_of(stencil), multiply_rows, &p);
}

void crease_stencil_band(
    const crease_stencil *stencil, const size_t stride[2], size_t width, double *band)
{
    const size_t degree = stencil->order - 1, n = stencil->count[1];
    memset(band, 0, stencil->count[0] * n * width * sizeof *band);
    for (size_t i = 0; i < stencil->count[0]; i++)
        for (size_t k = 0; k < stencil->width; k++) {
            const double *const row = row_of(stencil, i, k);
            const size_t di = (k + degree) / (2 * degree + 1);
            const size_t shift = k + degree - di * (2 * degree + 1);
            for (size_t j = shift < degree ? degree - shift : 0; j < n; j++) {
                if (i + di >= stencil->count[0] || j + shift >= n + degree)
                    break;
                const size_t a = stride[0] * i + stride[1] * j;
                const size_t b = stride[0] * (i + di) + stride[1] * (j + shift - degree);
                band[a < b ? a * width + (b - a) : b * width + (a - b)] = row[j];
            }
        }
}

/* --------------------------------------------------------------------------------- coarser nets --
 */

typedef struct coarsening {
    const crease_stencil *fine;
    const size_t *const *first;
    const double *const *weights;
    crease_stencil *coarse;
    size_t *begin;   /* for each coarse row of control points the first fine one that it enters */
    size_t *end;     /* and the one after the last */
    double *scratch; /* for each worker: order x (2 order - 1) x fine count[1] */
    size_t room;     /* of a worker */
} coarsening;

static double weight_of(const coarsening *c, int direction, size_t fine, size_t coarse)
{
    const size_t order = c->fine->order, first = c->first[direction][fine];
    return coarse >= first && coarse < first + order
        ? c->weights[direction][fine * order + coarse - first]
        : 0.0;
}

CREASE_VECTORISED static void add_scaled(
    const double *restrict a, double scale, size_t count, double *restrict y)
{
    for (size_t j = 0; j < count; j++)
        y[j] += scale * a[j];
}

/* Adds the couplings of fine row i with fine row k, all 2 order - 1 of them, times a weight. */
static void add_couplings(const coarsening *c, size_t i, size_t k, double weight, double *out)
{
    const size_t degree = c->fine->order - 1, n = c->fine->count[1], span = 2 * degree + 1;
    const size_t di = k >= i ? k - i : i - k;
    for (size_t b = 0; b < span; b++) {
        const size_t shift = b > degree ? b - degree : degree - b;
        if (shift >= n)
            continue;
        /* (i, j) with (k, j + b - degree); where only its mirror image is kept, that one */
        const bool kept = k > i || (k == i && b >= degree);
        const size_t from = b < degree ? shift : 0, width = n - shift;
        const double *const row = kept
            ? row_of(c->fine, i, span * di + b - degree) + from
            : row_of(c->fine, k, span * di + degree - b) + (b > degree ? shift : 0);
        add_scaled(row, weight, width, out + b * n + from);
    }
}

/* Couplings between coarse rows I and I + step over the fine columns. */
static void coarsen_rows(const coarsening *c, size_t row, size_t step, double *out)
{
    const size_t degree = c->fine->order - 1;
    for (size_t i = c->begin[row]; i < c->end[row]; i++) {
        const double here = weight_of(c, 0, i, row);
        const size_t low = c->begin[row + step] + degree > i ? c->begin[row + step] : i - degree;
        for (size_t k = low; k < c->end[row + step] && k <= i + degree && here != 0.0; k++) {
            const double both = here * weight_of(c, 0, k, row + step);
            if (both != 0.0)
                add_couplings(c, i, k, both, out);
        }
    }
}

/* Adds fine column j's coupling with column k to the coarse columns that both enter. rows: those of
 * the coarse matrix by the step along the second direction; NULL where only the mirror image is
 * kept. */
static void spread(const coarsening *c, size_t j, size_t k, double value, double *const *rows)
{
    const size_t order = c->fine->order, degree = order - 1;
    const size_t *const first = c->first[1];
    const double *const here = c->weights[1] + j * order, *const there = c->weights[1] + k * order;
    for (size_t a = 0; a < order; a++) {
        const double left = here[a] * value;
        for (size_t b = 0; b < order && left != 0.0; b++) {
            const size_t step = first[k] + b + degree - first[j] - a;
            if (there[b] != 0.0 && step <= 2 * degree && rows[step])
                rows[step][first[j] + a] += left * there[b];
        }
    }
}

static void coarsen_columns(const coarsening *c, size_t row, size_t step, const double *across)
{
    const size_t degree = c->fine->order - 1, n = c->fine->count[1], span = 2 * degree + 1;
    double *rows[2 * CREASE_ORDER_MAX - 1];
    for (size_t b = 0; b < span; b++)
        rows[b] = step || b >= degree ? row_of(c->coarse, row, span * step + b - degree) : NULL;
    for (size_t b = 0; b < span; b++)
        for (size_t j = b < degree ? degree - b : 0; j < n && j + b < n + degree; j++)
            spread(c, j, j + b - degree, across[b * n + j], rows);
}

static void coarsen_some(void *user, size_t begin, size_t end, int worker)
{
    const coarsening *const c = user;
    double *const across = c->scratch + (size_t)worker * c->room;
    for (size_t row = begin; row < end; row++)
        for (size_t step = 0; step < c->fine->order && row + step < c->coarse->count[0]; step++) {
            memset(across, 0, c->room * sizeof *across);
            coarsen_rows(c, row, step, across);
            coarsen_columns(c, row, step, across);
        }
}

/* Which fine rows enter each coarse one. */
static void find_children(const coarsening *c)
{
    for (size_t row = 0; row < c->coarse->count[0]; row++)
        c->begin[row] = c->fine->count[0];
    for (size_t i = 0; i < c->fine->count[0]; i++)
        for (size_t r = 0; r < c->fine->order; r++) {
            const size_t row = c->first[0][i] + r;
            if (weight_of(c, 0, i, row) == 0.0)
                continue;
            c->begin[row] = c->begin[row] < i ? c->begin[row] : i;
            c->end[row] = i + 1;
        }
}

crease_status crease_stencil_coarsen(crease_context *context, const crease_stencil *stencil,
    const size_t *const first[2], const double *const weights[2], crease_stencil *coarse)
{
    coarsening c = {.fine = stencil,
        .first = first,
        .weights = weights,
        .coarse = coarse,
        .room = (2 * stencil->order - 1) * stencil->count[1]};
    c.begin = crease_allocate(context, coarse->count[0], sizeof *c.begin);
    c.end = crease_allocate(context, coarse->count[0], sizeof *c.end);
    c.scratch =
        crease_allocate(context, (size_t)context->options.threads, c.room * sizeof *c.scratch);
    crease_status status = c.begin && c.end && c.scratch ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK) {
        find_children(&c);
        status =
            crease_parallel_for(context, coarse->count[0], grain_of(stencil), coarsen_some, &c);
    }
    free(c.begin);
    free(c.end);
    free(c.scratch);
    return status;
}
