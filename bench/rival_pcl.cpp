/* SPDX-License-Identifier: Apache-2.0 */
/* SPDX-FileCopyrightText: The crease authors */

/* usage: rival-pcl K POINTS SCORES
 * Surface variation by PCL: the smallest eigenvalue of the covariance over the sum of all three.
 *
 * Based on: Pauly, Gross, Kobbelt. Efficient simplification of point-sampled surfaces. 2002. */
#include "rival_cloud.hpp"

#include <pcl/features/normal_3d.h>
#include <pcl/search/kdtree.h>

#include <cmath>
#include <cstdlib>

int main(int count, char **arguments)
{
    if (count != 4)
        return 2;
    const std::vector<rival::Point> points = rival::read_points(arguments[2]);
    const pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
    for (const rival::Point &p : points)
        cloud->push_back({(float)p[0], (float)p[1], (float)p[2]});
    pcl::PointCloud<pcl::Normal> normals;
    pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
    estimation.setInputCloud(cloud);
    estimation.setSearchMethod(
        pcl::search::KdTree<pcl::PointXYZ>::Ptr(new pcl::search::KdTree<pcl::PointXYZ>));
    estimation.setKSearch(std::atoi(arguments[1]));
    estimation.compute(normals);
    std::vector<double> scores;
    for (const pcl::Normal &normal : normals)
        scores.push_back(std::isfinite(normal.curvature) ? (double)normal.curvature : 0.0);
    return rival::write_scores(arguments[3], scores) ? 0 : 1;
}
