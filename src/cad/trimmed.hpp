/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* A trimmed sheet as a shape. */
#ifndef CREASE_CAD_TRIMMED_HPP
#define CREASE_CAD_TRIMMED_HPP

#include "crease/crease_trim.h"

#include <TopoDS_Shape.hxx>

namespace crease_cad
{

/* Faces in the order of the sheet's: a shell, or a compound of several. Edges on knot lines and
 * sides are these curves themselves; others are cubics through places of the surface. Throws
 * Failure where OpenCASCADE finds fault. */
TopoDS_Shape shape_of(const crease_trim *trim);

} // namespace crease_cad

#endif
