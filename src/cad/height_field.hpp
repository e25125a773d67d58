/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* The bicubic surfaces of free forms: heights over a plane, an axis or a centre. */
#ifndef CREASE_CAD_HEIGHT_FIELD_HPP
#define CREASE_CAD_HEIGHT_FIELD_HPP

#include <Geom_BSplineSurface.hxx>
#include <TColStd_Array2OfReal.hxx>

namespace crease_cad
{

/* The bicubic surface through distances from the z axis: row i at the angle (i - 1) / rows of a
 * turn, the columns evenly from low to high along the axis. Closed, but not periodic; its
 * parameters are the angle, 0 to a whole turn, and z. Throws Failure. */
Handle(Geom_BSplineSurface)
    tube_through(const TColStd_Array2OfReal &distances, double low, double high);

/* The bicubic surface through distances from the origin over an even grid of a stereographic
 * projection (see primitive/base.h), its parameters. Throws Failure. */
Handle(Geom_BSplineSurface)
    ball_through(const TColStd_Array2OfReal &distances, const double low[2], const double high[2]);

/* A bicubic surface through heights over a grid, whose parameters are x and y, from low to high.
 * Throws Failure. */
Handle(Geom_BSplineSurface)
    surface_through(const TColStd_Array2OfReal &heights, const double low[2], const double high[2]);

} // namespace crease_cad

#endif
