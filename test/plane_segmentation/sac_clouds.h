// SPDX-License-Identifier: BSD-3-Clause
// What the tests of PlaneSACSegmentation share.
#pragma once

#include "plane_scenes.h"

#include <pcl/ModelCoefficients.h>
#include <pcl/PointIndices.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/sample_consensus/method_types.h>

namespace pcl6d::test {

constexpr double kSacLimit = 0.03; // [m]

template <typename PointT = pcl::PointXYZ>
typename pcl::PointCloud<PointT>::Ptr
sacCloud(const Points& points)
{
  auto cloud = pcl::make_shared<pcl::PointCloud<PointT>>();
  for (const auto& p : points) {
    PointT point;
    point.getVector3fMap() = p;
    cloud->push_back(point);
  }
  return cloud;
}

/** A table (z = 0.5), a wall (x = 2) with fewer points, and clutter. */
inline Points
table(std::size_t on_table = 3000, std::size_t clutter = 1000, std::uint64_t seed = 1)
{
  Random random(seed);
  Points points;
  addRectangle(points, {-1, -1, 0.5}, {2, 0, 0}, {0, 2, 0}, on_table, 0.005, random);
  addRectangle(points, {2, -1, -1}, {0, 2, 0}, {0, 0, 2}, on_table / 2, 0.005, random);
  for (std::size_t i = 0; i < clutter; ++i)
    points.emplace_back(
        random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2));
  return points;
}

template <typename Segmentation>
void
choose(Segmentation& segmentation, int model, int method = pcl::SAC_RANSAC)
{
  segmentation.setModelType(model);
  segmentation.setMethodType(method);
  segmentation.setDistanceThreshold(kSacLimit);
  segmentation.setMaxIterations(500);
}

struct Found {
  pcl::PointIndices inliers;
  pcl::ModelCoefficients plane;

  double
  component(std::size_t axis) const
  {
    return axis < plane.values.size() ? static_cast<double>(plane.values[axis]) : 0.0;
  }
};

template <typename Segmentation>
Found
segmented(Segmentation& segmentation)
{
  Found found;
  segmentation.segment(found.inliers, found.plane);
  return found;
}

} // namespace pcl6d::test
