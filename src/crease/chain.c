/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "crease/chain.h"

#include "base/memory.h"
#include "base/vector.h"

#include <stdlib.h>
#include <string.h>

crease_chain crease_chain_between(uint32_t first, uint32_t second)
{
    return (crease_chain){
        .regions = {first, second}, .corners = {CREASE_NO_CORNER, CREASE_NO_CORNER}};
}

static crease_status widen(crease_context *context, crease_chain *chain)
{
    const size_t capacity = 2 * chain->capacity + 32;
    double *const points =
        crease_reallocate(context, chain->points, capacity, 3 * sizeof *chain->points);
    if (!points)
        return CREASE_ERROR_NO_MEMORY;
    chain->points = points;
    double *const bends = crease_reallocate(context, chain->bends, capacity, sizeof *chain->bends);
    if (!bends)
        return CREASE_ERROR_NO_MEMORY;
    chain->bends = bends;
    chain->capacity = capacity;
    return CREASE_OK;
}

crease_status crease_chain_append(
    crease_context *context, crease_chain *chain, const double point[3], double bend)
{
    if (chain->count == chain->capacity) {
        const crease_status status = widen(context, chain);
        if (status != CREASE_OK)
            return status;
    }
    memcpy(chain->points + 3 * chain->count, point, 3 * sizeof *point);
    chain->bends[chain->count++] = bend;
    return CREASE_OK;
}

static void exchange(double *a, double *b)
{
    const double kept = *a;
    *a = *b;
    *b = kept;
}

void crease_chain_reverse(crease_chain *chain)
{
    for (size_t i = 0; 2 * i + 1 < chain->count; i++) {
        const size_t j = chain->count - 1 - i;
        for (size_t c = 0; c < 3; c++)
            exchange(&chain->points[3 * i + c], &chain->points[3 * j + c]);
        exchange(&chain->bends[i], &chain->bends[j]);
    }
    const int32_t first = chain->corners[0];
    chain->corners[0] = chain->corners[1];
    chain->corners[1] = first;
}

double crease_chain_length(const crease_chain *chain)
{
    double sum = 0.0;
    for (size_t i = 1; i < chain->count; i++)
        sum += crease_vector_distance(chain->points + 3 * (i - 1), chain->points + 3 * i);
    return sum;
}

double crease_chain_mean_bend(const crease_chain *chain)
{
    double sum = 0.0;
    for (size_t i = 0; i < chain->count; i++)
        sum += chain->bends[i];
    return chain->count ? sum / (double)chain->count : 0.0;
}

void crease_chain_clear(crease_chain *chain)
{
    free(chain->points);
    free(chain->bends);
    *chain = crease_chain_between(chain->regions[0], chain->regions[1]);
}

crease_status crease_chains_take(
    crease_context *context, crease_chains *chains, crease_chain *chain)
{
    if (chains->count == chains->capacity) {
        const size_t capacity = 2 * chains->capacity + 16;
        crease_chain *const grown =
            crease_reallocate(context, chains->items, capacity, sizeof *grown);
        if (!grown) {
            crease_chain_clear(chain);
            return CREASE_ERROR_NO_MEMORY;
        }
        chains->items = grown;
        chains->capacity = capacity;
    }
    chains->items[chains->count++] = *chain;
    *chain = crease_chain_between(chain->regions[0], chain->regions[1]);
    return CREASE_OK;
}

void crease_chains_clear(crease_chains *chains)
{
    for (size_t i = 0; i < chains->count; i++)
        crease_chain_clear(&chains->items[i]);
    free(chains->items);
    *chains = (crease_chains){0};
}
