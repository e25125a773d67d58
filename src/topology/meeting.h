/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Corners in which three regions meet smoothly, of which no surface tells where they are: the
 * borders between their points do. */
#ifndef CREASE_TOPOLOGY_MEETING_H
#define CREASE_TOPOLOGY_MEETING_H

#include "topology/links.h"

/* Where the points of three regions come together. Returns how far from each other their links are
 * there: INFINITY where they do not, or have a vertex already. */
double crease_meeting_find(const crease_graph *graph, const crease_links *links,
    const uint32_t regions[3], double place[3]);
/* Where the points leave a hole around the corner: the place beside three vertices, of which an
 * edge leads there each, that is nearest to all three surfaces. False when the vertices are far
 * from each other, or the surfaces from the place. */
bool crease_meeting_in_hole(const crease_graph *graph, const int32_t vertices[3],
    const uint32_t regions[3], double place[3]);
/* Where the surfaces of three regions cut each other, looked for from a vertex. Returns how far
 * that is: INFINITY where they do not, or have a vertex already, or it is farther than `reach`. */
double crease_meeting_in_shadow(const crease_graph *graph, int32_t vertex,
    const uint32_t regions[3], double reach, double place[3]);

#endif
