/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

#include "cad/occt.hpp"

#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>

namespace crease_cad
{

/* Equal knots are one knot with a multiplicity. */
struct Knots {
    TColStd_Array1OfReal values;
    TColStd_Array1OfInteger times;

    explicit Knots(const std::vector<double> &knots)
        : values(1, distinct(knots)), times(1, values.Upper())
    {
        int n = 0;
        for (size_t i = 0; i < knots.size(); i++) {
            if (i == 0 || knots[i] != knots[i - 1]) {
                values(++n) = knots[i];
                times(n) = 0;
            }
            times(n)++;
        }
    }

    static int distinct(const std::vector<double> &knots)
    {
        int n = 1;
        for (size_t i = 1; i < knots.size(); i++)
            n += knots[i] != knots[i - 1];
        return n;
    }
};

Handle(Geom_BSplineCurve)
    curve_of(int degree, const std::vector<double> &knots, const std::vector<gp_XYZ> &points)
{
    const Knots folded(knots);
    TColgp_Array1OfPnt poles(1, (int)points.size());
    for (int i = 1; i <= poles.Upper(); i++)
        poles(i) = gp_Pnt(points[(size_t)i - 1]);
    return new Geom_BSplineCurve(poles, folded.values, folded.times, degree);
}

Handle(Geom_BSplineSurface) surface_of(const Net &net)
{
    const Knots u(net.knots[0]), v(net.knots[1]);
    TColgp_Array2OfPnt poles(1, (int)net.count[0], 1, (int)net.count[1]);
    for (int i = 1; i <= poles.UpperRow(); i++)
        for (int j = 1; j <= poles.UpperCol(); j++)
            poles(i, j) = gp_Pnt(net.at((size_t)i - 1, (size_t)j - 1));
    return new Geom_BSplineSurface(
        poles, u.values, v.values, u.times, v.times, net.degree[0], net.degree[1]);
}

} // namespace crease_cad
