/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* Our nets in OpenCASCADE's words: distinct knots with multiplicities, arrays from 1. */
#ifndef CREASE_CAD_OCCT_HPP
#define CREASE_CAD_OCCT_HPP

#include "cad/net.hpp"

#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>

namespace crease_cad
{

Handle(Geom_BSplineCurve)
    curve_of(int degree, const std::vector<double> &knots, const std::vector<gp_XYZ> &points);
Handle(Geom_BSplineSurface) surface_of(const Net &net);

} // namespace crease_cad

#endif
