/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Loops: edges of one region, one after the other and back to the first. */
#ifndef CREASE_TOPOLOGY_LOOP_H
#define CREASE_TOPOLOGY_LOOP_H

#include "topology/graph.h"

typedef struct crease_loops {
    size_t count, room;
    crease_loop *items;
} crease_loops;

/* Walks along all edges of a region; where more than two come together, round the sharpest corner,
 * so that loops may touch but do not cross themselves. *closed: whether it came back to the start
 * each time; if not, there are no loops. The loops are not measured. */
crease_status crease_loops_walk(
    const crease_graph *graph, uint32_t region, crease_loops *out, bool *closed);
/* Sets what a loop says of its u and v. */
crease_status crease_loop_measure(
    const crease_graph *graph, const crease_chart *chart, crease_loop *loop);
/* Walks and measures. */
crease_status crease_loops_of(
    const crease_graph *graph, uint32_t region, crease_loops *out, bool *closed);
/* Turns a measured loop's direction. */
void crease_loop_reverse(crease_loop *loop);
/* Lets a loop begin at a vertex; measure it again. False when it does not pass there. */
bool crease_loop_begin_at(const crease_graph *graph, crease_loop *loop, int32_t vertex);
/* Moves a measured loop by whole turns. */
void crease_loop_shift(crease_loop *loop, int direction, double by);
/* Mean of u (0) or v (1). */
double crease_loop_mean(const crease_loop *loop, int direction);
/* Vertex at which a half edge begins (0) or ends (1). */
int32_t crease_half_vertex(const crease_graph *graph, crease_half half, int end);
/* The vector whose length is the area that a loop encloses in space, across it. */
void crease_loop_area_vector(const crease_graph *graph, const crease_loop *loop, double out[3]);
void crease_loops_clear(crease_loops *loops);

#endif
