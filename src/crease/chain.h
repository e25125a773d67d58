/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Points one after the other along the crease between two regions. */
#ifndef CREASE_CREASE_CHAIN_H
#define CREASE_CREASE_CHAIN_H

#include "base/context.h"

enum { CREASE_NO_CORNER = -1 };

typedef struct crease_chain {
    uint32_t regions[2];
    size_t count, capacity;
    double *points;     /* x 3, each on the models of both regions */
    double *bends;      /* how far the surface turns at each point: 0 smooth, pi folded back */
    bool closed;        /* the first point follows the last */
    int32_t corners[2]; /* at which the two ends lie, or CREASE_NO_CORNER */
} crease_chain;

/* An empty chain between two regions. */
crease_chain crease_chain_between(uint32_t first, uint32_t second);
/* Adds a point at the end. */
crease_status crease_chain_append(
    crease_context *context, crease_chain *chain, const double point[3], double bend);
/* Turns the order of the points; the corners stay with their ends. */
void crease_chain_reverse(crease_chain *chain);
/* Length of the open polyline through the points. */
double crease_chain_length(const crease_chain *chain);
double crease_chain_mean_bend(const crease_chain *chain);
/* Frees what the chain owns, not the chain. */
void crease_chain_clear(crease_chain *chain);

typedef struct crease_chains {
    size_t count, capacity;
    crease_chain *items;
} crease_chains;

/* Moves a chain to the end of the list; it is cleared when there is no room. */
crease_status crease_chains_take(
    crease_context *context, crease_chains *chains, crease_chain *chain);
void crease_chains_clear(crease_chains *chains);

#endif
