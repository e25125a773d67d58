/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* ALGLIB's bicubic least-squares spline: POINTS (doubles x y z) NET VALUES. Writes the heights of
 * the spline over the points. */
#include <libalglib/interpolation.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <vector>

int main(int count, char **arguments)
{
    if (count != 4)
        return 2;
    std::ifstream in(arguments[1], std::ios::binary | std::ios::ate);
    const std::size_t points = static_cast<std::size_t>(in.tellg()) / (3 * sizeof(double));
    std::vector<double> values(3 * points);
    in.seekg(0);
    in.read(reinterpret_cast<char *>(values.data()), static_cast<std::streamsize>(24 * points));
    alglib::real_2d_array xy;
    xy.setcontent(static_cast<alglib::ae_int_t>(points), 3, values.data());
    const auto net = static_cast<alglib::ae_int_t>(std::atoi(arguments[2]));
    alglib::spline2dbuilder builder;
    alglib::spline2dinterpolant spline;
    alglib::spline2dfitreport report;
    alglib::spline2dbuildercreate(1, builder);
    alglib::spline2dbuildersetpoints(builder, xy, static_cast<alglib::ae_int_t>(points));
    alglib::spline2dbuildersetgrid(builder, net, net);
    alglib::spline2dbuildersetalgoblocklls(builder, 1e-9);
    alglib::spline2dfit(builder, spline, report);
    std::ofstream out(arguments[3], std::ios::binary);
    for (std::size_t i = 0; i < points; i++) {
        const double z = alglib::spline2dcalc(spline, values[3 * i], values[3 * i + 1]);
        out.write(reinterpret_cast<const char *>(&z), sizeof z);
    }
    return out ? 0 : 1;
}
