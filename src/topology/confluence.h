/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Confluences: vertices to which smooth edges only come, as at the corner of a box whose edges are
 * all rounded. No crease tells where they are; that loose links of three pairs of regions come
 * together does, and the lines along which the surfaces touch cross there. */
#ifndef CREASE_TOPOLOGY_CONFLUENCE_H
#define CREASE_TOPOLOGY_CONFLUENCE_H

#include "topology/links.h"

enum { CREASE_CONFLUENCE_PAIRS = 8 };

/* A vertex and the pairs of regions whose smooth edges come to it. */
typedef struct crease_confluence {
    int32_t vertex;
    size_t pair_count;
    uint32_t pairs[CREASE_CONFLUENCE_PAIRS][2]; /* ascending */
} crease_confluence;

typedef struct crease_confluences {
    size_t count, room;
    crease_confluence *items;
} crease_confluences;

/* Adds the vertices to the graph, those that its edges know left out. */
crease_status crease_confluences_find(
    crease_graph *graph, const crease_links *links, crease_confluences *out);
/* The confluence at a vertex; NULL when there is none. */
const crease_confluence *crease_confluence_at(
    const crease_confluences *confluences, int32_t vertex);
/* Whether the smooth edge of two regions, ascending, is still missing at a confluence. */
bool crease_confluence_awaits(
    const crease_graph *graph, const crease_confluence *confluence, const uint32_t regions[2]);
void crease_confluences_clear(crease_confluences *confluences);

#endif
