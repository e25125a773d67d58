/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#ifndef CREASE_CAD_BICUBIC_HPP
#define CREASE_CAD_BICUBIC_HPP

#include <TopoDS_Shape.hxx>

namespace crease_cad
{

/* The same shape with every face on a bicubic B-spline surface, rational where it must be; nothing
 * is approximated. Surfaces that are of higher degree keep it. */
TopoDS_Shape bicubic(const TopoDS_Shape &shape);

} // namespace crease_cad

#endif
