/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Based on: Briggs, Henson, McCormick. A multigrid tutorial. 2000 (cycle, nested iteration);
 * Adams, Brezina, Hu, Tuminaro. Parallel multigrid smoothing: polynomial versus Gauss-Seidel. 2003;
 * Saad. Iterative methods for sparse linear systems. 2003 (algorithms 9.1 and 12.1). */
#include "net/multigrid.h"

#include "base/memory.h"
#include "base/random.h"
#include "net/level.h"

#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    MOST_LEVELS = 16,
    COARSEST = 1024,
    MOST_ITERATIONS = 200,
    POWERS = 8,
    SWEEPS = 2,
    NESTED = 2
};

/* Of a sum of squares: what is left of it below is rounding. */
static const double ROUNDING = 1e-14;
static const double SAFETY = 1.2;     /* the largest eigenvalue is found from below */
static const double SMOOTHED = 0.125; /* share of the spectrum, from above, that smoothing damps */

struct crease_multigrid {
    size_t levels;
    crease_level level[MOST_LEVELS]; /* finest first */
    double *factor;                  /* of the coarsest, banded */
    size_t stride[2], width;
    double *vectors; /* conjugate gradients: direction, image, residual; nested: solution, right */
};

/* ------------------------------------------------------------------------------------- levels --
 */

static crease_status create_levels(crease_context *context, const crease_height *height,
    const crease_gaps *gaps, crease_multigrid *m)
{
    crease_status status = crease_level_create(context, height, gaps, &m->level[0]);
    m->levels = 1;
    while (
        status == CREASE_OK && m->levels < MOST_LEVELS && m->level[m->levels - 1].size > COARSEST) {
        bool coarser;
        status = crease_level_coarser(
            context, &m->level[m->levels - 1], gaps, &m->level[m->levels], &coarser);
        if (!coarser)
            break;
        m->levels++;
    }
    return status;
}

crease_status crease_multigrid_create(crease_context *context, const crease_height *height,
    const crease_gaps *gaps, crease_multigrid **out)
{
    crease_multigrid *const m = *out = crease_allocate(context, 1, sizeof *m);
    if (!m)
        return CREASE_ERROR_NO_MEMORY;
    crease_status status = create_levels(context, height, gaps, m);
    if (status == CREASE_OK) {
        const crease_level *const last = &m->level[m->levels - 1];
        const size_t degree = (size_t)height->order - 1, *const count = last->count;
        const bool upright = count[1] <= count[0];
        m->stride[0] = upright ? count[1] : 1;
        m->stride[1] = upright ? 1 : count[0];
        m->width = degree * (upright ? count[1] : count[0]) + degree + 1;
        m->factor = crease_allocate(context, last->size, m->width * sizeof *m->factor);
        m->vectors = crease_allocate(context, m->level[0].size, 5 * sizeof *m->vectors);
        status = m->factor && m->vectors ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    }
    if (status != CREASE_OK) {
        crease_multigrid_free(m);
        *out = NULL;
    }
    return status;
}

void crease_multigrid_free(crease_multigrid *multigrid)
{
    if (!multigrid)
        return;
    for (size_t l = 0; l < MOST_LEVELS; l++)
        crease_level_free(&multigrid->level[l]);
    free(multigrid->factor);
    free(multigrid->vectors);
    free(multigrid);
}

crease_status crease_multigrid_coarsen(
    crease_context *context, crease_multigrid *multigrid, const crease_stencil *normal)
{
    multigrid->level[0].normal = normal;
    crease_status status = CREASE_OK;
    for (size_t l = 0; l + 1 < multigrid->levels && status == CREASE_OK; l++)
        status = crease_level_carry(context, &multigrid->level[l], &multigrid->level[l + 1]);
    return status;
}

/* Largest eigenvalue of the relaxed matrix, from above in all likelihood. */
static crease_status bound_spectrum(crease_context *context, crease_level *level)
{
    double size = 0.0;
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < level->size; i++)
        level->x[i] = 2.0 * crease_random_uniform(0, 0x5bec, i) - 1.0;
    for (int p = 0; p < POWERS && status == CREASE_OK; p++) {
        const double before = cblas_dnrm2((int)level->size, level->x, 1);
        cblas_dscal((int)level->size, before > 0.0 ? 1.0 / before : 0.0, level->x, 1);
        status = crease_stencil_multiply(context, &level->whole, level->x, level->r);
        if (status == CREASE_OK)
            status = crease_relaxation_apply(context, &level->relaxation, level->r, level->x);
        size = cblas_dnrm2((int)level->size, level->x, 1);
    }
    level->largest = SAFETY * size;
    return status;
}

crease_status crease_multigrid_weigh(crease_context *context, crease_multigrid *multigrid,
    double weight, double tension, bool *solvable)
{
    crease_status status = CREASE_OK;
    const crease_level *const last = &multigrid->level[multigrid->levels - 1];
    for (size_t l = 0; l < multigrid->levels && status == CREASE_OK; l++) {
        crease_level *const level = &multigrid->level[l];
        status = crease_level_weigh(context, level, weight, tension);
        if (status == CREASE_OK && level != last)
            status = bound_spectrum(context, level);
    }
    if (status != CREASE_OK)
        return status;
    crease_stencil_band(&last->whole, multigrid->stride, multigrid->width, multigrid->factor);
    *solvable =
        LAPACKE_dpbtrf_work(LAPACK_COL_MAJOR, 'L', (lapack_int)last->size,
            (lapack_int)multigrid->width - 1, multigrid->factor, (lapack_int)multigrid->width) == 0;
    return CREASE_OK;
}

/* -------------------------------------------------------------------------------------- cycle --
 */

/* x = inverse b on the coarsest net. */
static void solve_coarsest(const crease_multigrid *m)
{
    const crease_level *const last = &m->level[m->levels - 1];
    const size_t *const count = last->count;
    for (size_t i = 0; i < count[0]; i++)
        for (size_t j = 0; j < count[1]; j++)
            last->r[m->stride[0] * i + m->stride[1] * j] = last->b[i * count[1] + j];
    LAPACKE_dpbtrs_work(LAPACK_COL_MAJOR, 'L', (lapack_int)last->size, (lapack_int)m->width - 1, 1,
        m->factor, (lapack_int)m->width, last->r, (lapack_int)last->size);
    for (size_t i = 0; i < count[0]; i++)
        for (size_t j = 0; j < count[1]; j++)
            last->x[i * count[1] + j] = last->r[m->stride[0] * i + m->stride[1] * j];
}

static crease_status subtract_image(crease_context *context, crease_level *level, const double *x)
{
    const crease_status status = crease_stencil_multiply(context, &level->whole, x, level->z);
    cblas_daxpy((int)level->size, -1.0, level->z, 1, level->r, 1);
    return status;
}

/* A Chebyshev polynomial of the relaxed matrix: x gets nearer, r remains what is left. */
static crease_status smooth(crease_context *context, crease_level *level, bool last)
{
    const int n = (int)level->size;
    const double middle = 0.5 * level->largest * (1.0 + SMOOTHED);
    const double half = 0.5 * level->largest * (1.0 - SMOOTHED);
    double rho = half / middle;
    crease_status status = crease_relaxation_apply(context, &level->relaxation, level->r, level->p);
    cblas_dscal(n, 1.0 / middle, level->p, 1);
    for (int sweep = 1; status == CREASE_OK; sweep++) {
        cblas_daxpy(n, 1.0, level->p, 1, level->x, 1);
        if (sweep < SWEEPS || !last)
            status = subtract_image(context, level, level->p);
        if (sweep == SWEEPS || status != CREASE_OK)
            break;
        status = crease_relaxation_apply(context, &level->relaxation, level->r, level->z);
        const double next = 1.0 / (2.0 * middle / half - rho);
        cblas_dscal(n, next * rho, level->p, 1);
        cblas_daxpy(n, 2.0 * next / half, level->z, 1, level->p, 1);
        rho = next;
    }
    return status;
}

/* x of the level becomes about inverse b. */
static crease_status cycle(crease_context *context, crease_multigrid *m, size_t l)
{
    crease_level *const level = &m->level[l];
    if (l + 1 == m->levels) {
        solve_coarsest(m);
        return CREASE_OK;
    }
    memset(level->x, 0, level->size * sizeof *level->x);
    memcpy(level->r, level->b, level->size * sizeof *level->r);
    crease_status status = smooth(context, level, false);
    if (status == CREASE_OK) {
        crease_level_restrict(level, &m->level[l + 1], level->r);
        status = cycle(context, m, l + 1);
    }
    if (status == CREASE_OK) {
        crease_level_prolong(level, &m->level[l + 1], level->p);
        cblas_daxpy((int)level->size, 1.0, level->p, 1, level->x, 1);
        status = subtract_image(context, level, level->p);
    }
    return status == CREASE_OK ? smooth(context, level, true) : status;
}

/* When to stop, see crease_multigrid_solve(). */
typedef struct target {
    double square, tolerance;
    int most; /* iterations */
} target;

/* Conjugate gradients on a level, from the solution at hand. */
static crease_status iterate(crease_context *context, crease_multigrid *m, size_t l,
    const double *right, const target *aim, double *x)
{
    crease_level *const level = &m->level[l];
    const int n = (int)level->size;
    double *const p = m->vectors, *const image = p + n, *const r = image + n;
    double before = 0.0;
    crease_status status = crease_stencil_multiply(context, &level->whole, x, image);
    for (int i = 0; i < n; i++)
        r[i] = right[i] - image[i];
    for (int k = 0; k < aim->most && status == CREASE_OK; k++) {
        memcpy(level->b, r, level->size * sizeof *r);
        status = cycle(context, m, l);
        const double now = cblas_ddot(n, r, 1, level->x, 1);
        const double explained = fabs(cblas_ddot(n, right, 1, x, 1));
        const double rest =
            aim->square > 0.0 ? fmax(aim->square - explained, ROUNDING * aim->square) : explained;
        if (status != CREASE_OK || !(now > aim->tolerance * aim->tolerance * rest))
            break;
        cblas_dscal(n, k ? now / before : 0.0, p, 1);
        cblas_daxpy(n, 1.0, level->x, 1, p, 1);
        status = crease_stencil_multiply(context, &level->whole, p, image);
        const double step = now / cblas_ddot(n, p, 1, image, 1);
        cblas_daxpy(n, step, p, 1, x, 1);
        cblas_daxpy(n, -step, image, 1, r, 1);
        before = now;
    }
    return status;
}

/* A first solution: the coarsest net's, made better on each finer one. */
static crease_status nest(
    crease_context *context, crease_multigrid *m, const double *right, double *solution)
{
    const size_t finest = m->level[0].size;
    const target nested = {.most = NESTED};
    memcpy(m->level[0].b, right, finest * sizeof *right);
    for (size_t l = 0; l + 1 < m->levels; l++)
        crease_level_restrict(&m->level[l], &m->level[l + 1], m->level[l].b);
    solve_coarsest(m);
    crease_status status = CREASE_OK;
    for (size_t l = m->levels - 1; l-- > 1 && status == CREASE_OK;) {
        crease_level *const level = &m->level[l];
        double *const x = m->vectors + 3 * finest, *const b = x + level->size;
        crease_level_prolong(level, &m->level[l + 1], x);
        memcpy(b, level->b, level->size * sizeof *b);
        status = iterate(context, m, l, b, &nested, x);
        memcpy(level->x, x, level->size * sizeof *x);
    }
    if (m->levels > 1)
        crease_level_prolong(&m->level[0], &m->level[1], solution);
    else
        memcpy(solution, m->level[0].x, finest * sizeof *solution);
    return status;
}

crease_status crease_multigrid_solve(crease_context *context, crease_multigrid *multigrid,
    const double *right, double square, double tolerance, double *solution)
{
    const target aim = {.square = square, .tolerance = tolerance, .most = MOST_ITERATIONS};
    const size_t n = multigrid->level[0].size;
    crease_status status = CREASE_OK;
    bool zero = true;
    for (size_t i = 0; i < n && zero; i++)
        zero = solution[i] == 0.0;
    if (zero)
        status = nest(context, multigrid, right, solution);
    if (status == CREASE_OK)
        status = iterate(context, multigrid, 0, right, &aim, solution);
    return status;
}
