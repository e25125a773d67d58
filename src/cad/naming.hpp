/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Which carrier a face lies on: told by the places of its triangles' corners, so that no history
 * of the operations is needed. */
#ifndef CREASE_CAD_NAMING_HPP
#define CREASE_CAD_NAMING_HPP

#include "cad/job.hpp"
#include "cad/tessellate.hpp"

namespace crease_cad
{

/* The number of the nearest carrier for each owner of triangles. */
std::vector<uint32_t> carriers_of_faces(
    const Job &job, const Triangles &triangles, size_t face_count);

} // namespace crease_cad

#endif
