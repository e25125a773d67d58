/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "net/level.h"

#include "base/memory.h"
#include "spline/knots.h"

#include <stdlib.h>
#include <string.h>

/* A direction whose spans are longer than those of the other by this waits for it. */
static const double LONGER = 1.5;

static crease_status fill(crease_context *context, const crease_gaps *gaps, crease_level *level)
{
    const crease_height *const h = &level->height;
    level->count[0] = h->count[0];
    level->count[1] = h->count[1];
    level->size = h->count[0] * h->count[1];
    double **const vectors[] = {
        &level->b, &level->x, &level->r, &level->z, &level->p, &level->half};
    crease_status status = CREASE_OK;
    for (size_t i = 0; i < sizeof vectors / sizeof vectors[0] && status == CREASE_OK; i++) {
        *vectors[i] = crease_allocate(context, level->size, sizeof(double));
        status = *vectors[i] ? CREASE_OK : CREASE_ERROR_NO_MEMORY;
    }
    if (status == CREASE_OK)
        status = crease_bending_create(context, h, gaps, &level->energy);
    if (status == CREASE_OK)
        status =
            crease_relaxation_create(context, &level->energy, level->count, &level->relaxation);
    if (status == CREASE_OK)
        status = crease_stencil_create(context, h->order, h->count, &level->whole);
    return status;
}

crease_status crease_level_create(crease_context *context, const crease_height *height,
    const crease_gaps *gaps, crease_level *out)
{
    *out = (crease_level){
        .height = {.order = height->order, .count = {height->count[0], height->count[1]}}};
    for (int d = 0; d < 2; d++) {
        out->height.knots[d] = crease_duplicate(
            context, height->knots[d], height->count[d] + (size_t)height->order, sizeof(double));
        if (!out->height.knots[d])
            return CREASE_ERROR_NO_MEMORY;
    }
    return fill(context, gaps, out);
}

void crease_level_free(crease_level *level)
{
    crease_height_free(&level->height);
    crease_bending_free(&level->energy);
    crease_stencil_free(&level->own);
    crease_stencil_free(&level->whole);
    crease_relaxation_free(&level->relaxation);
    for (int d = 0; d < 2; d++) {
        free(level->first[d]);
        free(level->weights[d]);
    }
    free(level->b);
    free(level->x);
    free(level->r);
    free(level->z);
    free(level->p);
    free(level->half);
    *level = (crease_level){.size = 0};
}

/* ------------------------------------------------------------------------------------- coarser --
 */

/* Copies the knots but every other simple one of each run; returns their number. */
static size_t thin(const double *knots, size_t total, size_t order, double *out)
{
    size_t kept = 0, run = 0;
    for (size_t i = 0; i < total; i++) {
        const bool inside = i >= order && i + order < total;
        const bool simple = inside && knots[i - 1] < knots[i] && knots[i] < knots[i + 1];
        run = simple ? run + 1 : 0;
        if (!simple || run % 2 == 0)
            out[kept++] = knots[i];
    }
    return kept;
}

static double mean_span(const crease_height *h, int direction)
{
    const size_t order = (size_t)h->order, count = h->count[direction];
    const double *const knots = h->knots[direction];
    return (knots[count] - knots[order - 1]) / (double)(count + 1 - order);
}

/* Which directions have knots to lose and are to lose them. */
static void choose_directions(const crease_height *h, bool take[2])
{
    const double span[2] = {mean_span(h, 0), mean_span(h, 1)};
    for (int d = 0; d < 2; d++) {
        const size_t total = h->count[d] + (size_t)h->order;
        take[d] = false;
        for (size_t i = (size_t)h->order; i + (size_t)h->order < total; i++)
            take[d] = take[d] ||
                (h->knots[d][i - 1] < h->knots[d][i] && h->knots[d][i] < h->knots[d][i + 1]);
    }
    for (int d = 0; d < 2; d++)
        if (take[0] && take[1] && span[d] > LONGER * span[1 - d])
            take[d] = false;
}

static crease_status thin_out(
    crease_context *context, const crease_height *fine, const bool take[2], crease_height *out)
{
    *out = (crease_height){.order = fine->order};
    const size_t order = (size_t)fine->order;
    for (int d = 0; d < 2; d++) {
        const size_t total = fine->count[d] + order;
        out->knots[d] = crease_duplicate(context, fine->knots[d], total, sizeof(double));
        if (!out->knots[d])
            return CREASE_ERROR_NO_MEMORY;
        out->count[d] =
            (take[d] ? thin(fine->knots[d], total, order, out->knots[d]) : total) - order;
    }
    return CREASE_OK;
}

crease_status crease_level_coarser(crease_context *context, crease_level *level,
    const crease_gaps *gaps, crease_level *out, bool *coarser)
{
    bool take[2];
    choose_directions(&level->height, take);
    *coarser = take[0] || take[1];
    if (!*coarser)
        return CREASE_OK;
    *out = (crease_level){.size = 0};
    crease_status status = thin_out(context, &level->height, take, &out->height);
    const size_t order = (size_t)level->height.order;
    for (int d = 0; d < 2 && status == CREASE_OK; d++) {
        level->first[d] = crease_allocate(context, level->count[d], sizeof *level->first[d]);
        level->weights[d] =
            crease_allocate(context, level->count[d], order * sizeof *level->weights[d]);
        if (!level->first[d] || !level->weights[d])
            return CREASE_ERROR_NO_MEMORY;
        crease_knots_prolong(level->height.order, out->height.knots[d], out->height.count[d],
            level->height.knots[d], level->count[d], level->first[d], level->weights[d]);
    }
    if (status == CREASE_OK)
        status = fill(context, gaps, out);
    if (status == CREASE_OK)
        status = crease_stencil_create(context, out->height.order, out->count, &out->own);
    return status;
}

crease_status crease_level_carry(
    crease_context *context, const crease_level *fine, crease_level *coarse)
{
    const size_t *const first[2] = {fine->first[0], fine->first[1]};
    const double *const weights[2] = {fine->weights[0], fine->weights[1]};
    coarse->normal = &coarse->own;
    crease_stencil_clear(&coarse->own);
    return crease_stencil_coarsen(context, fine->normal, first, weights, &coarse->own);
}

crease_status crease_level_weigh(
    crease_context *context, crease_level *level, double weight, double tension)
{
    crease_stencil_copy(level->normal, &level->whole);
    const crease_status status =
        crease_bending_add(context, &level->energy, weight, tension, &level->whole);
    crease_relaxation_set(&level->relaxation, &level->whole);
    return status;
}

/* ----------------------------------------------------------------------------------- transfers --
 */

void crease_level_restrict(const crease_level *fine, crease_level *coarse, const double *vector)
{
    const size_t order = (size_t)fine->height.order, n = fine->count[1], m = coarse->count[1];
    double *const half = fine->half; /* coarse rows, fine columns */
    memset(half, 0, coarse->count[0] * n * sizeof *half);
    for (size_t i = 0; i < fine->count[0]; i++)
        for (size_t r = 0; r < order; r++) {
            const double weight = fine->weights[0][i * order + r];
            double *const row = half + (fine->first[0][i] + r) * n;
            for (size_t j = 0; j < n && weight != 0.0; j++)
                row[j] += weight * vector[i * n + j];
        }
    memset(coarse->b, 0, coarse->size * sizeof *coarse->b);
    for (size_t i = 0; i < coarse->count[0]; i++)
        for (size_t j = 0; j < n; j++) {
            double *const at = coarse->b + i * m + fine->first[1][j];
            for (size_t r = 0; r < order; r++)
                at[r] += fine->weights[1][j * order + r] * half[i * n + j];
        }
}

void crease_level_prolong(const crease_level *fine, const crease_level *coarse, double *vector)
{
    const size_t order = (size_t)fine->height.order, n = fine->count[1], m = coarse->count[1];
    double *const half = fine->half;
    for (size_t i = 0; i < coarse->count[0]; i++)
        for (size_t j = 0; j < n; j++) {
            const double *const at = coarse->x + i * m + fine->first[1][j];
            double sum = 0.0;
            for (size_t r = 0; r < order; r++)
                sum += fine->weights[1][j * order + r] * at[r];
            half[i * n + j] = sum;
        }
    memset(vector, 0, fine->size * sizeof *vector);
    for (size_t i = 0; i < fine->count[0]; i++)
        for (size_t r = 0; r < order; r++) {
            const double weight = fine->weights[0][i * order + r];
            const double *const row = half + (fine->first[0][i] + r) * n;
            for (size_t j = 0; j < n && weight != 0.0; j++)
                vector[i * n + j] += weight * row[j];
        }
}
