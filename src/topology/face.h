/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Faces: which loops of a region go around it, which around its holes. */
#ifndef CREASE_TOPOLOGY_FACE_H
#define CREASE_TOPOLOGY_FACE_H

#include "topology/graph.h"

/* Adds the faces of all regions to the topology, and marks those as open whose edges do not make
 * the border of a face. seams: from crease_turns_cut. */
crease_status crease_faces_make(crease_graph *graph, const int32_t *seams);

#endif
