/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Surfaces that join smoothly, fitted so that they touch: each was fitted to its own points, so
 * beside the seam they leave a gap or overlap by a part of the noise. */
#ifndef CREASE_TOPOLOGY_TANGENCY_H
#define CREASE_TOPOLOGY_TANGENCY_H

#include "topology/links.h"

/* Fits primitives again so that they are tangent to larger regions that they join smoothly, where
 * the points do not speak against it. models: those of the graph's regions, as it sees them. */
crease_status crease_tangency_impose(
    const crease_graph *graph, const crease_links *links, crease_model *models, bool *changed);

#endif
