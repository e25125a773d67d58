/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Ways of building a part from its carriers, see Way. What each makes is judged by others. */
#ifndef CREASE_CAD_WAYS_HPP
#define CREASE_CAD_WAYS_HPP

#include "cad/job.hpp"

namespace crease_cad
{

/* A solid, or shells: the faces, edges and vertices that the points show, put together. Takes no
 * margin. */
Attempt follow_topology(const Job &job, double margin);

/* A solid: the carriers' faces, a margin larger than their points, are intersected all at once, and
 * the cells that the points say are inside are united. */
Attempt arrange_solid(const Job &job, double margin);

/* Shells: the pieces of the same faces that the points support, sharing their edges. */
Attempt arrange_shells(const Job &job, double margin);

/* The faces that the topology closes, which share edges; of the other carriers those as far as
 * their points go, sharing nothing. */
Attempt lay_out_rest(const Job &job, double margin);

/* The carriers' faces as far as their points go, sharing nothing. */
Attempt lay_out_faces(const Job &job, double margin);

} // namespace crease_cad

#endif
