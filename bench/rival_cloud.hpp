/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* What the detectors of others read and write: coordinates, and one score for each point, all as
 * plain doubles. */
#ifndef CREASE_BENCH_RIVAL_CLOUD_HPP
#define CREASE_BENCH_RIVAL_CLOUD_HPP

#include <array>
#include <cstddef>
#include <fstream>
#include <vector>

namespace rival
{

using Point = std::array<double, 3>;

inline std::vector<Point> read_points(const char *path)
{
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    std::vector<Point> points(file ? (size_t)file.tellg() / sizeof(Point) : 0);
    file.seekg(0);
    file.read((char *)points.data(), (std::streamsize)(points.size() * sizeof(Point)));
    return points;
}

inline bool write_scores(const char *path, const std::vector<double> &scores)
{
    std::ofstream file(path, std::ios::binary);
    file.write((const char *)scores.data(), (std::streamsize)(scores.size() * sizeof(double)));
    return (bool)file.flush();
}

} // namespace rival

#endif
