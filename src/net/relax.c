/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "net/relax.h"

#include "base/memory.h"
#include "base/parallel.h"
#include "base/simd.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Below SMALL unknowns a thread is not worth its while; COLUMNS and ROWS are worked on at a time.
 */
enum { SMALL = 16384, COLUMNS = 64, ROWS = 8 };

static double *entry(const crease_relaxation *r, int d, size_t i, size_t before)
{
    return r->factor[d] + i * r->order + before;
}

/* The matrix of integrals of products, its lower band row by row. */
static void fill(crease_relaxation *r, int d, const crease_strip *strip, size_t block)
{
    for (size_t s = 0; s < strip->spans; s++) {
        const double *pair = strip->whole + s * block;
        for (size_t a = 0; a < r->order; a++)
            for (size_t b = a; b < r->order; b++)
                *entry(r, d, strip->first[s] + b, b - a) += *pair++;
    }
}

static void scale_to_unit_diagonal(crease_relaxation *r, int d)
{
    for (size_t i = r->count[d]; i-- > 0;)
        for (size_t k = 0; k < r->order && k <= i; k++) {
            const double both = *entry(r, d, i, 0) * *entry(r, d, i - k, 0);
            if (k > 0)
                *entry(r, d, i, k) /= sqrt(both);
        }
    for (size_t i = 0; i < r->count[d]; i++)
        *entry(r, d, i, 0) = 1.0;
}

static void factorise(crease_relaxation *r, int d)
{
    for (size_t i = 0; i < r->count[d]; i++)
        for (size_t k = i < r->order - 1 ? i + 1 : r->order; k-- > 0;) {
            const size_t j = i - k;
            double sum = *entry(r, d, i, k);
            for (size_t m = k + 1; m < r->order && m <= i; m++)
                if (m - k < r->order)
                    sum -= *entry(r, d, i, m) * *entry(r, d, j, m - k);
            *entry(r, d, i, k) = k ? sum * *entry(r, d, j, 0) : 1.0 / sqrt(sum);
        }
}

crease_status crease_relaxation_create(crease_context *context, const crease_bending *bending,
    const size_t count[2], crease_relaxation *out)
{
    *out = (crease_relaxation){.order = (size_t)bending->order, .count = {count[0], count[1]}};
    for (int d = 0; d < 2; d++)
        out->factor[d] = crease_allocate(context, count[d], out->order * sizeof(double));
    out->scale = crease_allocate(context, count[0], count[1] * sizeof(double));
    if (!out->factor[0] || !out->factor[1] || !out->scale) {
        crease_relaxation_free(out);
        return CREASE_ERROR_NO_MEMORY;
    }
    for (int d = 0; d < 2; d++) {
        fill(out, d, &bending->strip[d], bending->block);
        scale_to_unit_diagonal(out, d);
        factorise(out, d);
    }
    return CREASE_OK;
}

void crease_relaxation_free(crease_relaxation *relaxation)
{
    free(relaxation->factor[0]);
    free(relaxation->factor[1]);
    free(relaxation->scale);
    *relaxation = (crease_relaxation){.order = 0};
}

void crease_relaxation_set(crease_relaxation *relaxation, const crease_stencil *stencil)
{
    for (size_t i = 0; i < stencil->count[0]; i++)
        for (size_t j = 0; j < stencil->count[1]; j++) {
            const double own = crease_stencil_diagonal(stencil, i, j);
            relaxation->scale[i * stencil->count[1] + j] = own > 0.0 ? 1.0 / sqrt(own) : 0.0;
        }
}

/* ------------------------------------------------------------------------------------ solving --
 */

typedef struct work {
    const crease_relaxation *relaxation;
    const double *r;
    double *z;
} work;

CREASE_VECTORISED static void subtract(
    const double *restrict x, double factor, size_t count, double *restrict y)
{
    for (size_t j = 0; j < count; j++)
        y[j] -= factor * x[j];
}

CREASE_VECTORISED static void multiply(
    const double *restrict x, const double *restrict s, size_t count, double *restrict y)
{
    for (size_t j = 0; j < count; j++)
        y[j] = s[j] * x[j];
}

CREASE_VECTORISED static void scale_by(double factor, size_t count, double *restrict y)
{
    for (size_t j = 0; j < count; j++)
        y[j] *= factor;
}

/* Along the first direction, for some columns: the scaled right side in, the product's part out. */
static void solve_columns(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const work *const w = user;
    const crease_relaxation *const r = w->relaxation;
    const size_t rows = r->count[0], n = r->count[1], width = end - begin;
    for (size_t i = 0; i < rows; i++) {
        double *const y = w->z + i * n + begin;
        multiply(w->r + i * n + begin, r->scale + i * n + begin, width, y);
        for (size_t k = 1; k < r->order && k <= i; k++)
            subtract(y - k * n, *entry(r, 0, i, k), width, y);
        scale_by(*entry(r, 0, i, 0), width, y);
    }
    for (size_t i = rows; i-- > 0;) {
        double *const y = w->z + i * n + begin;
        for (size_t k = 1; k < r->order && i + k < rows; k++)
            subtract(y + k * n, *entry(r, 0, i + k, k), width, y);
        scale_by(*entry(r, 0, i, 0), width, y);
    }
}

/* Along the second direction ROWS rows at a time, whose numbers do not wait for one another. */
static void solve_row_group(const crease_relaxation *r, double *y, size_t rows)
{
    const size_t n = r->count[1];
    for (size_t j = 0; j < n; j++)
        for (size_t row = 0; row < rows; row++) {
            double *const at = y + row * n + j;
            for (size_t k = 1; k < r->order && k <= j; k++)
                at[0] -= *entry(r, 1, j, k) * *(at - k);
            at[0] *= *entry(r, 1, j, 0);
        }
    for (size_t j = n; j-- > 0;)
        for (size_t row = 0; row < rows; row++) {
            double *const at = y + row * n + j;
            for (size_t k = 1; k < r->order && j + k < n; k++)
                at[0] -= *entry(r, 1, j + k, k) * at[k];
            at[0] *= *entry(r, 1, j, 0);
        }
}

static void solve_rows(void *user, size_t begin, size_t end, int worker)
{
    (void)worker;
    const work *const w = user;
    const size_t n = w->relaxation->count[1];
    for (size_t i = begin; i < end; i += ROWS)
        solve_row_group(w->relaxation, w->z + i * n, end - i < ROWS ? end - i : ROWS);
    for (size_t i = begin * n; i < end * n; i++)
        w->z[i] *= w->relaxation->scale[i];
}

crease_status crease_relaxation_apply(
    crease_context *context, const crease_relaxation *relaxation, const double *r, double *z)
{
    work w = {.relaxation = relaxation, .r = r, .z = z};
    const size_t *const count = relaxation->count;
    const bool small = count[0] * count[1] < SMALL;
    crease_status status =
        crease_parallel_for(context, count[1], small ? count[1] : COLUMNS, solve_columns, &w);
    if (status == CREASE_OK)
        status = crease_parallel_for(context, count[0], small ? count[0] : ROWS, solve_rows, &w);
    return status;
}
