/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "fit/system.h"

#include "base/memory.h"
#include "base/random.h"
#include "fit/bending.h"

#include <cblas.h>
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STREAM_PROBES = 0xf17, FEW_UNKNOWNS = 128 };

/* Weight of the tension in shares of the data's: enough to determine what the data do not. */
static const double LEAST_HOLD = 1e-13;

/* Random signs, for an estimated trace; set once. */
static void set_signs(crease_system *system)
{
    for (size_t i = 0; i < system->size; i += 32)
        for (size_t k = 0; k < CREASE_PROBES; k++) {
            uint32_t bits[4];
            crease_random_block(0, STREAM_PROBES + k, i / 32, bits);
            for (size_t b = 0; b < 32 && i + b < system->size; b++)
                system->probes[k * system->size + i + b] = bits[0] >> b & 1 ? 1.0 : -1.0;
        }
}

crease_status crease_system_create(crease_context *context, const crease_height *height,
    const crease_gaps *gaps, crease_system *out)
{
    const size_t rows = height->count[0], columns = height->count[1];
    const size_t degree = (size_t)height->order - 1;
    const bool upright = columns <= rows;
    *out = (crease_system){.size = rows * columns,
        .width = degree * (upright ? columns : rows) + degree + 1,
        .stride = {upright ? columns : 1, upright ? 1 : rows}};
    const size_t bytes = out->width * sizeof(double);
    out->normal = crease_allocate(context, out->size, bytes);
    out->bending = crease_allocate(context, out->size, bytes);
    if (gaps->empty)
        out->tension = crease_allocate(context, out->size, bytes);
    out->factor = crease_allocate(context, out->size, bytes);
    out->right = crease_allocate(context, out->size, sizeof(double));
    out->solution = crease_allocate(context, out->size, sizeof(double));
    out->probes = crease_allocate(context, out->size, 2 * CREASE_PROBES * sizeof(double));
    crease_status status = out->normal && out->bending && (out->tension || !gaps->empty) &&
            out->factor && out->right && out->solution && out->probes
        ? crease_bending_fill(context, height, gaps, out)
        : CREASE_ERROR_NO_MEMORY;
    if (status != CREASE_OK)
        crease_system_free(out);
    else if (out->size > FEW_UNKNOWNS)
        set_signs(out);
    return status;
}

void crease_system_free(crease_system *system)
{
    free(system->normal);
    free(system->bending);
    free(system->tension);
    free(system->factor);
    free(system->right);
    free(system->solution);
    free(system->probes);
    *system = (crease_system){0};
}

size_t crease_system_index(const crease_system *system, size_t i, size_t j)
{
    return system->stride[0] * i + system->stride[1] * j;
}

static double trace(const crease_system *system, const double *matrix)
{
    double sum = 0.0;
    for (size_t i = 0; i < system->size; i++)
        sum += matrix[i * system->width];
    return sum;
}

bool crease_system_factor(crease_system *system, double lambda)
{
    const size_t entries = system->size * system->width;
    const double whole = trace(system, system->normal);
    const double share = lambda * whole / trace(system, system->bending);
    for (size_t i = 0; i < entries; i++)
        system->factor[i] = system->normal[i] + share * system->bending[i];
    if (system->tension) {
        const double hold = fmax(system->hold, LEAST_HOLD * whole / trace(system, system->tension));
        for (size_t i = 0; i < entries; i++)
            system->factor[i] += hold * system->tension[i];
    }
    system->lambda = lambda;
    return LAPACKE_dpbtrf_work(LAPACK_COL_MAJOR, 'L', (lapack_int)system->size,
               (lapack_int)system->width - 1, system->factor, (lapack_int)system->width) == 0;
}

void crease_system_solve_many(const crease_system *system, double *sides, size_t count)
{
    LAPACKE_dpbtrs_work(LAPACK_COL_MAJOR, 'L', (lapack_int)system->size,
        (lapack_int)system->width - 1, (lapack_int)count, system->factor, (lapack_int)system->width,
        sides, (lapack_int)system->size);
}

void crease_system_solve(crease_system *system, crease_height *height)
{
    memcpy(system->solution, system->right, system->size * sizeof *system->right);
    crease_system_solve_many(system, system->solution, 1);
    for (size_t i = 0; i < height->count[0]; i++)
        for (size_t j = 0; j < height->count[1]; j++)
            height->coefficients[i * height->count[1] + j] =
                system->solution[crease_system_index(system, i, j)];
}

static void multiply_normal(const crease_system *system, const double *x, double *y)
{
    cblas_dsbmv(CblasColMajor, CblasLower, (int)system->size, (int)system->width - 1, 1.0,
        system->normal, (int)system->width, x, 1, 0.0, y, 1);
}

/* Unit vectors number begin .. end - 1, for an exact trace. */
static void set_units(crease_system *system, size_t begin, size_t end)
{
    memset(system->probes, 0, (end - begin) * system->size * sizeof *system->probes);
    for (size_t k = begin; k < end; k++)
        system->probes[(k - begin) * system->size + k] = 1.0;
}

/* Sum over `count` probes z of z^T factor^-1 normal z. */
static double probe(crease_system *system, size_t count)
{
    const size_t n = system->size;
    double *const images = system->probes + CREASE_PROBES * n, sum = 0.0;
    for (size_t k = 0; k < count; k++)
        multiply_normal(system, system->probes + k * n, images + k * n);
    crease_system_solve_many(system, images, count);
    for (size_t k = 0; k < count * n; k++)
        sum += system->probes[k] * images[k];
    return sum;
}

double crease_system_freedom(crease_system *system)
{
    if (system->size > FEW_UNKNOWNS)
        return probe(system, CREASE_PROBES) / CREASE_PROBES;
    double sum = 0.0;
    for (size_t begin = 0; begin < system->size; begin += CREASE_PROBES) {
        const size_t end =
            begin + CREASE_PROBES < system->size ? begin + CREASE_PROBES : system->size;
        set_units(system, begin, end);
        sum += probe(system, end - begin);
    }
    return sum;
}
