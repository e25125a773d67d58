/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Fillets between planes. They touch their neighbours without crossing them, so they have no place
 * in an arrangement: the part is built with a sharp edge, and a ball is rolled along it. */
#ifndef CREASE_CAD_ROUNDING_HPP
#define CREASE_CAD_ROUNDING_HPP

#include "cad/job.hpp"

namespace crease_cad
{

/* A cylinder that is tangent to two planes. */
struct Fillet {
    const Carrier *round, *planes[2];
};

/* Recognised by their places alone: within the noise. */
std::vector<Fillet> find_fillets(const Job &job);

/* The solid with its sharp edges rounded as far as it stays sound; *left: fillets not made. */
TopoDS_Shape rounded(
    const Job &job, const TopoDS_Shape &solid, const std::vector<Fillet> &fillets, size_t *left);

} // namespace crease_cad

#endif
