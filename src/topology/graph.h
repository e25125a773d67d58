/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A topology in the making: its edges and vertices, and the regions that they belong to. */
#ifndef CREASE_TOPOLOGY_GRAPH_H
#define CREASE_TOPOLOGY_GRAPH_H

#include "crease/chain.h"
#include "crease/junction.h"
#include "crease/survey.h"
#include "topology/topology.h"

typedef struct crease_graph {
    crease_context *context;
    const crease_survey *survey;
    crease_topology *topology;
} crease_graph;

/* Adds a vertex; its number goes to *out. */
crease_status crease_graph_vertex(crease_graph *graph, const double place[3], int32_t *out);
/* Moves an edge to the end of the list; it is cleared when there is no room. */
crease_status crease_graph_take(crease_graph *graph, crease_edge *edge);
/* Chains and their corners as edges and vertices. Closed edges, and ends without a corner, have no
 * vertex. */
crease_status crease_graph_begin(
    crease_graph *graph, const crease_chains *chains, const crease_junctions *corners);
/* Removes the edges that have no points. */
void crease_graph_drop_empty(crease_graph *graph);

/* An edge without points between two regions. */
crease_edge crease_edge_between(uint32_t first, uint32_t second);
/* Inserts a point before number `at`. */
crease_status crease_edge_insert(
    crease_context *context, crease_edge *edge, size_t at, const double place[3]);
crease_status crease_edge_append(crease_context *context, crease_edge *edge, const double place[3]);
/* Removes the points from number `begin` up to, not including, number `end`. */
void crease_edge_erase(crease_edge *edge, size_t begin, size_t end);
/* Turns the direction of the edge, its vertices with it. */
void crease_edge_reverse(crease_edge *edge);
bool crease_edge_has(const crease_edge *edge, uint32_t region);
/* Of the regions of two edges: the one that both have, then the other of a, then that of b. False
 * unless it is exactly one. */
bool crease_edge_common(const uint32_t a[2], const uint32_t b[2], uint32_t out[3]);
/* Distance of a place from the edge. */
double crease_edge_distance(const crease_edge *edge, const double place[3]);
/* Whether the edge turns more from step to step than the common curve of two surfaces that cut each
 * other does: they wave around each other. Its ends may be beside that. */
bool crease_edge_is_wild(const crease_edge *edge);

/* Ends of edges of a region at a vertex; of all regions when region is negative. */
size_t crease_graph_ends(const crease_graph *graph, int32_t vertex, int64_t region);
/* Whether their number is odd: then an edge of the region is missing at the vertex. */
bool crease_graph_odd(const crease_graph *graph, int32_t vertex, uint32_t region);
/* Signed distance from the surface of a region. */
double crease_graph_distance(
    const crease_graph *graph, uint32_t region, const double place[3], double gradient[3]);
/* crease_intersection_project for two regions. */
bool crease_graph_project(
    const crease_graph *graph, const uint32_t regions[2], double reach, double place[3]);
/* The same for an edge, also a smooth one; `along` is roughly its direction. Loose edges stay. */
bool crease_graph_onto(
    const crease_graph *graph, const crease_edge *edge, const double along[3], double place[3]);

#endif
