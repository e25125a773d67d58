/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "net/system.h"

#include "base/memory.h"
#include "base/random.h"

#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STREAM_PROBES = 0xf17, FEW_UNKNOWNS = 128, PROBES = 8, PROBES_OF_MANY = 1 };

/* Products that a banded factorisation may take; with more of them iterations are faster. */
static const double BANDED = 4e8;
/* Weight of the tension in shares of the data's: enough to determine what the data do not; for
 * iterations, enough to see it. */
static const double LEAST_HOLD = 1e-13, LEAST_HOLD_ITERATED = 1e-8;
/* Errors of iterated solutions, see crease_multigrid_solve(); that of a trace is chance's anyway.
 */
static const double TOLERANCE = 1e-3, TOLERANCE_OF_TRACE = 3e-2;

/* Random signs, for an estimated trace; set once. */
static void set_signs(crease_system *system)
{
    const size_t *const count = system->count;
    for (size_t k = 0; k < system->probe_count; k++)
        for (size_t i = 0, n = 0; i < count[0]; i++)
            for (size_t j = 0; j < count[1]; j++, n++) {
                const size_t draw = system->stride[0] * i + system->stride[1] * j;
                uint32_t bits[4];
                crease_random_block(0, STREAM_PROBES + k, draw / 32, bits);
                system->probes[k * system->size + n] = bits[0] >> draw % 32 & 1 ? 1.0 : -1.0;
            }
}

/* The order of unknowns that makes the band narrow. */
static void lay_out_band(crease_system *system, int order)
{
    const size_t *const count = system->count, degree = (size_t)order - 1;
    const bool upright = count[1] <= count[0];
    system->stride[0] = upright ? count[1] : 1;
    system->stride[1] = upright ? 1 : count[0];
    system->width = degree * (upright ? count[1] : count[0]) + degree + 1;
}

static crease_status create_band(
    crease_context *context, const crease_height *height, crease_system *system)
{
    const bool gaps = system->gaps.empty > 0;
    system->factor = crease_allocate(context, system->size, system->width * sizeof(double));
    if (system->stride[1] != 1)
        system->permuted = crease_allocate(context, system->size, sizeof(double));
    crease_status status = system->factor && (system->permuted || system->stride[1] == 1)
        ? crease_stencil_create(context, height->order, height->count, &system->whole)
        : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK)
        status = crease_stencil_create(context, height->order, height->count, &system->bending);
    if (status == CREASE_OK && gaps)
        status = crease_stencil_create(context, height->order, height->count, &system->tension);
    if (status == CREASE_OK)
        status = crease_bending_add(context, &system->energy, 1.0, 0.0, &system->bending);
    if (status == CREASE_OK && gaps)
        status = crease_bending_add(context, &system->energy, 0.0, 1.0, &system->tension);
    return status;
}

crease_status crease_system_create(crease_context *context, const crease_height *height,
    size_t sides, crease_gaps *gaps, crease_system *out)
{
    const size_t *const count = height->count;
    *out = (crease_system){
        .size = count[0] * count[1], .sides = sides, .count = {count[0], count[1]}, .gaps = *gaps};
    *gaps = (crease_gaps){.empty = 0};
    lay_out_band(out, height->order);
    const double width = (double)out->width, products = (double)out->size * width * width;
    out->probe_count = products > BANDED ? PROBES_OF_MANY : PROBES;
    const size_t besides = products > BANDED ? out->probe_count : 0;
    out->right = crease_allocate(context, out->size, (sides + besides) * sizeof(double));
    out->squares = crease_allocate(context, sides, sizeof(double));
    out->probes =
        crease_allocate(context, out->size, (products > BANDED ? 1 : PROBES + 2) * sizeof(double));
    crease_status status = out->right && out->squares && out->probes
        ? crease_stencil_create(context, height->order, count, &out->normal)
        : CREASE_ERROR_NO_MEMORY;
    if (status == CREASE_OK)
        status = crease_bending_create(context, height, &out->gaps, &out->energy);
    if (status == CREASE_OK)
        status = products > BANDED
            ? crease_multigrid_create(context, height, &out->gaps, &out->multigrid)
            : create_band(context, height, out);
    if (status == CREASE_OK)
        crease_bending_traces(&out->energy, out->traces);
    if (status != CREASE_OK)
        crease_system_free(out);
    else if (!out->multigrid && out->size > FEW_UNKNOWNS)
        set_signs(out);
    return status;
}

void crease_system_free(crease_system *system)
{
    crease_gaps_free(&system->gaps);
    crease_bending_free(&system->energy);
    crease_stencil_free(&system->normal);
    crease_stencil_free(&system->bending);
    crease_stencil_free(&system->tension);
    crease_stencil_free(&system->whole);
    crease_multigrid_free(system->multigrid);
    free(system->right);
    free(system->squares);
    free(system->probes);
    free(system->factor);
    free(system->permuted);
    *system = (crease_system){0};
}

void crease_system_clear(crease_system *system)
{
    crease_stencil_clear(&system->normal);
    const size_t besides = system->multigrid ? system->probe_count : 0;
    memset(system->right, 0, system->size * (system->sides + besides) * sizeof *system->right);
    system->added = 0;
    system->carried = false;
    memset(system->squares, 0, system->sides * sizeof *system->squares);
}

crease_status crease_system_add(crease_context *context, crease_system *system,
    const crease_height *height, const crease_observations *observations)
{
    const crease_observations *const o = observations;
    for (size_t i = 0; i < o->count; i++)
        for (size_t s = 0; s < o->sides; s++) {
            const double target = (o->tilt ? o->tilt[i] : 1.0) * o->target[i * o->sides + s];
            system->squares[s] += o->weight[i] * target * target;
        }
    crease_observations all = *observations;
    all.probes = system->multigrid ? system->probe_count : 0;
    all.first = system->added;
    system->added += all.count;
    system->carried = false;
    return crease_assemble(context, height, &all, &system->normal, system->right);
}

crease_status crease_system_factor(
    crease_context *context, crease_system *system, double lambda, bool *solvable)
{
    const double all = crease_stencil_trace(&system->normal);
    const double share = lambda * all / system->traces[0];
    const double least = system->multigrid ? LEAST_HOLD_ITERATED : LEAST_HOLD;
    const double hold =
        system->gaps.empty ? fmax(system->hold, least * all / system->traces[1]) : 0.0;
    system->lambda = lambda;
    if (system->multigrid) {
        const crease_status status = system->carried
            ? CREASE_OK
            : crease_multigrid_coarsen(context, system->multigrid, &system->normal);
        system->carried = status == CREASE_OK;
        return status == CREASE_OK
            ? crease_multigrid_weigh(context, system->multigrid, share, hold, solvable)
            : status;
    }
    crease_stencil_copy(&system->normal, &system->whole);
    crease_stencil_add_scaled(&system->bending, share, &system->whole);
    if (system->gaps.empty)
        crease_stencil_add_scaled(&system->tension, hold, &system->whole);
    crease_stencil_band(&system->whole, system->stride, system->width, system->factor);
    *solvable = LAPACKE_dpbtrf_work(LAPACK_COL_MAJOR, 'L', (lapack_int)system->size,
                    (lapack_int)system->width - 1, system->factor, (lapack_int)system->width) == 0;
    return CREASE_OK;
}

/* To the band's order, or back. */
static void permute(const crease_system *system, const double *from, double *to, bool back)
{
    size_t ours = 0;
    for (size_t i = 0; i < system->count[0]; i++)
        for (size_t j = 0; j < system->count[1]; j++, ours++) {
            const size_t its = system->stride[0] * i + system->stride[1] * j;
            to[back ? ours : its] = from[back ? its : ours];
        }
}

static void solve_band(const crease_system *system, const double *side, double *solution)
{
    double *const x = system->permuted ? system->permuted : solution;
    if (system->permuted)
        permute(system, side, x, false);
    else
        memcpy(x, side, system->size * sizeof *x);
    LAPACKE_dpbtrs_work(LAPACK_COL_MAJOR, 'L', (lapack_int)system->size,
        (lapack_int)system->width - 1, 1, system->factor, (lapack_int)system->width, x,
        (lapack_int)system->size);
    if (system->permuted)
        permute(system, x, solution, true);
}

static crease_status solve(crease_context *context, crease_system *system, const double *side,
    double square, double tolerance, double *solution)
{
    if (system->multigrid)
        return crease_multigrid_solve(
            context, system->multigrid, side, square, tolerance, solution);
    solve_band(system, side, solution);
    return CREASE_OK;
}

crease_status crease_system_solve(crease_context *context, crease_system *system, double *solutions)
{
    crease_status status = CREASE_OK;
    for (size_t s = 0; s < system->sides && status == CREASE_OK; s++)
        status = solve(context, system, system->right + s * system->size, system->squares[s],
            TOLERANCE, solutions + s * system->size);
    return status;
}

crease_status crease_system_solve_others(crease_context *context, crease_system *system,
    const double *sides, size_t count, double *solutions)
{
    crease_status status = CREASE_OK;
    for (size_t s = 0; s < count * system->size && status == CREASE_OK; s += system->size)
        status = solve(context, system, sides + s, 0.0, TOLERANCE, solutions + s);
    return status;
}

/* z^T factor^-1 normal z. */
static crease_status probe(
    crease_context *context, crease_system *system, const double *z, double *sum)
{
    const size_t n = system->size;
    double *const image = system->probes + system->probe_count * n, *const solved = image + n;
    memset(solved, 0, n * sizeof *solved);
    crease_status status = crease_stencil_multiply(context, &system->normal, z, image);
    if (status == CREASE_OK)
        status = solve(context, system, image, 0.0, TOLERANCE_OF_TRACE, solved);
    *sum += cblas_ddot((int)n, z, 1, solved, 1);
    return status;
}

/* The sum over all unit vectors. */
static crease_status exact_freedom(crease_context *context, crease_system *system, double *freedom)
{
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < system->size && status == CREASE_OK; i++) {
        memset(system->probes, 0, system->size * sizeof *system->probes);
        system->probes[i] = 1.0;
        status = probe(context, system, system->probes, freedom);
    }
    return status;
}

/* w^T factor^-1 w, w being the sum over the observations with random signs. */
static crease_status probe_observations(
    crease_context *context, crease_system *system, const double *w, double *sum)
{
    double *const solved = system->probes;
    memset(solved, 0, system->size * sizeof *solved);
    const crease_status status = solve(context, system, w, 0.0, TOLERANCE_OF_TRACE, solved);
    *sum += cblas_ddot((int)system->size, w, 1, solved, 1);
    return status;
}

crease_status crease_system_freedom(crease_context *context, crease_system *system, double *freedom)
{
    *freedom = 0.0;
    if (system->size <= FEW_UNKNOWNS)
        return exact_freedom(context, system, freedom);
    crease_status status = CREASE_OK;
    for (size_t k = 0; k < system->probe_count && status == CREASE_OK; k++)
        status = system->multigrid
            ? probe_observations(
                  context, system, system->right + (system->sides + k) * system->size, freedom)
            : probe(context, system, system->probes + k * system->size, freedom);
    *freedom /= (double)system->probe_count;
    return status;
}
