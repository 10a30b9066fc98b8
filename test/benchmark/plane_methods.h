// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/benchmarking/plane_score.h>
#include <pcl6d/common/points.h>

#include <functional>
#include <string>
#include <vector>

namespace pcl6d::benchmarks {

/** \brief What a method found in a cloud. */
struct FoundPlanes {
  double seconds = 0; ///< from the points to the planes: trees and normals included
  std::vector<Plane> planes;
  PlaneNumbers numbers; ///< of each point
};

/** \brief A way to find planes. */
struct PlaneMethodCase {
  std::string name;
  std::function<FoundPlanes(const Points&, unsigned int threads)> find;
};

/** \return region growing, RANSAC and the five Hough transforms */
std::vector<PlaneMethodCase>
ourPlaneMethods();

/** \return pcl::SACSegmentation, one plane after the other, and pcl::RegionGrowing;
 * both in the settings of PCL's tutorials, fitted to metres */
std::vector<PlaneMethodCase>
peerPlaneMethods();

} // namespace pcl6d::benchmarks
