// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/room.h"

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cmath>
#include <cstdint>

namespace pcl6d::benchmarks {

using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;

/** \return a scan of the pillar room from a pose, in its own frame and in the order of
 * the scanner, dense near the scanner and sparse far away. \param[in] count wanted
 * points; the scan has about as many */
inline Cloud::Ptr
roomCloud(std::size_t count, const Eigen::Isometry3d& T_world_scan, std::uint64_t seed)
{
  const double field = 2 * 0.87 * 2 * M_PI; // [rad^2] that PillarRoom::scan() covers
  Random random(seed);
  auto cloud = pcl::make_shared<Cloud>();
  for (const auto& p : test::PillarRoom().scan(
           T_world_scan, random, std::sqrt(field / static_cast<double>(count))))
    cloud->push_back(Point(p.x(), p.y(), p.z()));
  return cloud;
}

} // namespace pcl6d::benchmarks
