// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/room.h"

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

namespace pcl6d::benchmarks {

using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;

/** In which order the points of a scan come. */
enum class Order { kScanner, kRandom };

inline std::string
nameOf(Order order)
{
  return order == Order::kScanner ? "scanner_order" : "random_order";
}

/** \return a scan of the pillar room from a pose, in its own frame, dense near the
 * scanner and sparse far away. \param[in] count wanted points; the scan has about as
 * many */
inline Cloud::Ptr
roomCloud(std::size_t count,
          const Eigen::Isometry3d& T_world_scan,
          std::uint64_t seed,
          Order order = Order::kScanner)
{
  const double field = 2 * 0.87 * 2 * M_PI; // [rad^2] that PillarRoom::scan() covers
  Random random(seed);
  auto cloud = pcl::make_shared<Cloud>();
  for (const auto& p : test::PillarRoom().scan(
           T_world_scan, random, std::sqrt(field / static_cast<double>(count))))
    cloud->push_back(Point(p.x(), p.y(), p.z()));
  if (order == Order::kRandom)
    std::shuffle(cloud->begin(), cloud->end(), std::mt19937_64(seed));
  return cloud;
}

} // namespace pcl6d::benchmarks
